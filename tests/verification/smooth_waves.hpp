// Exact smooth solutions: plane waves of small amplitude in a moving, prestressed solid; a wave of density and a simple
// wave of finite amplitude in a gas.
#pragma once

#include <array>
#include <functional>
#include <optional>

#include "physics/eos.hpp"
#include "physics/hyperelastic_material.hpp"
#include "solver/setup.hpp"

namespace cobasis::test {

using Matrix = std::array<std::array<double, 3>, 3>;  ///< of a cobasis: rows x, y, z, columns e^1, e^2, e^3

struct SmoothState {
  double density = 0, pressure = 0;
  Point velocity;
  std::optional<Matrix> cobasis;
  std::array<double, 6> stress{};  ///< xx yy zz xy yz xz [Pa]

  PhaseState as_phase() const;
};

struct SmoothWave {
  std::function<SmoothState(const Point& x, double time)> at;
  double speed;   ///< relative to the material [m/s]
  double period;  ///< wavelength over speed [s]
};

/// What a plane wave runs through, and its wave vector [1/m].
struct SolidMedium {
  HyperelasticMaterial solid;
  StiffenedGas eos;
  Matrix cobasis;
  double pressure;
  Point velocity;
};
enum class Polarisation { longitudinal, transverse };

/// Displacement gradients of size `strain`. Exact up to its square. The polarisation is that of the fastest wave, or of
/// the fastest of those across it; in the plane if cobasis and wave vector are.
SmoothWave solid_wave(const SolidMedium& medium, const Point& wave_vector, Polarisation polarisation, double strain);

struct GasMedium {
  double gamma, density, pressure;
  Point velocity;
};
/// Density 1 + amplitude sin, carried along; `period`: a wavelength of travel with the gas.
SmoothWave density_wave(const GasMedium& medium, const Point& wave_vector, double amplitude);
/// All of it on one family of characteristics; velocity `amplitude` sound speeds. Holds until it breaks, after
/// 1 / (pi (gamma + 1) amplitude) periods.
SmoothWave simple_wave(const GasMedium& medium, const Point& wave_vector, double amplitude);

}  // namespace cobasis::test
