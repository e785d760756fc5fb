// What has torn off before a void, and what is left of its state no EOS can bear: its mass, momentum and energy stay,
// its volume becomes that at which its pressure is the void's.
#pragma once

#include "solver/field.hpp"

namespace cobasis {

/// Splinters are volume fractions below this, of inadmissible states; below `largest_dust` also of states far from the
/// void's pressure: what an update leaves of a phase in so little volume may be any density.
inline constexpr double largest_splinter = 0.5, largest_dust = 1e-3;

/// Gives phase k of a cell the volume v' m at which p(1 / v', e') = p0, e' = e^h - p0 (v' - v): the work is done by the
/// void, whose volume fraction makes room, so that E - p0 V of the void stays. The cobasis is stretched alike in all
/// directions to det e = rho / rho0; where it is no deformation (det e <= 0), or its energy is more than there is, it
/// becomes undeformed and its energy heat. Returns whether that made an admissible state; else, and where the volume
/// would change by less than the part `tolerance`, nothing is changed.
bool relax_to_void(Fields& fields, int k, int void_phase, std::int32_t cell, double tolerance = 0);

}  // namespace cobasis
