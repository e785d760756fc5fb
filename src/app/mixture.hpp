// The mixture of a cell's phases, section 5.2 of the paper.
#pragma once

#include <span>
#include <vector>

#include "solver/setup.hpp"
#include "solver/snapshot.hpp"

namespace cobasis {

struct Mixture {
  std::vector<double> density;      ///< [kg/m^3]
  std::vector<double> velocity[3];  ///< mass-weighted [m/s]; 0 where there is no mass
  std::vector<double> stress[6];    ///< xx yy zz xy yz xz [Pa]
  std::vector<double> pressure;     ///< [Pa]
};

/// `phases` in the order of the snapshot's; a void contributes its pressure and no mass.
Mixture mix(const Snapshot& snapshot, std::span<const PhaseSetup> phases);

}  // namespace cobasis
