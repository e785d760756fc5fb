// The state of a rank's owned cells at one instant, in plain arrays, for whoever writes, samples or integrates it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace cobasis {

/// Arrays are empty where a phase has no such field (a void: all but alpha; a fluid: cobasis). Size n_owned each.
/// Where a phase has no volume, or a fragment no state, the other fields hold 0.
struct PhaseSnapshot {
  std::string name;
  bool is_void = false;
  bool is_solid = false;
  double rho0 = 0;  ///< of a solid
  std::vector<double> alpha;
  std::vector<double> density;         ///< [kg/m^3]
  std::vector<double> velocity[3];     ///< [m/s]
  std::vector<double> pressure;        ///< [Pa]
  std::vector<double> stress[6];       ///< sigma = S - p I: xx yy zz xy yz xz [Pa]
  std::vector<double> cobasis[9];      ///< e^1_x e^1_y e^1_z e^2_x … e^3_z
  std::vector<double> energy;          ///< total, E [J/kg]
  std::vector<double> elastic_energy;  ///< e^e [J/kg]
};

struct Snapshot {
  std::int64_t step = 0;
  double time = 0;  ///< [s]
  double dt = 0;    ///< of the last step [s]
  std::vector<PhaseSnapshot> phases;
};

/// A number of a history row: a conserved total, for example.
struct Column {
  std::string name;
  std::string unit;
  double value;
};

}  // namespace cobasis
