// What the energy of a phase in a cell consists of, cell by cell; and a change of its volume.
#pragma once

#include "solver/field.hpp"

namespace cobasis {

/// e^e [J/kg]: 0 of a fluid; infinite where the cobasis of a solid is no deformation.
double stored_energy(const Fields& fields, const Phase& phase, std::int32_t cell);

/// rho E [J/m^3] of density, velocity, pressure and cobasis, as Primitives numbers them; not a number where the cobasis
/// is no deformation.
double total_energy(const Fields& fields, const Phase& phase, const double* primitives);

/// e - u^2 / 2 [J/kg]
double internal_energy(const Fields& fields, const Phase& phase, std::int32_t cell);

/// The phase fills `alpha` of the cell from now on: its cobasis is stretched alike in all directions, so that what
/// rho / (rho0 det e) was it stays. Mass, momentum and energy are left alone, and so are other phases.
void resize(const Fields& fields, Phase& phase, std::int32_t cell, double alpha);

}  // namespace cobasis
