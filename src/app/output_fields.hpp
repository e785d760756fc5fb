// What is written of a snapshot: names, units and components, the same for VTU files and CSV tables.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/mixture.hpp"
#include "solver/setup.hpp"
#include "solver/snapshot.hpp"

namespace cobasis {

/// A named quantity of the cells; the values stay with the snapshot or the mixture it was made from.
struct OutputField {
  std::string name;  ///< `velocity.copper`; of the mixture: `velocity`
  std::string unit;
  std::vector<std::string> components;          ///< suffixes of columns (`x`, `xx`, `e1.x`); empty for a scalar
  std::vector<std::span<const double>> values;  ///< per component, [cell]
  std::span<const double> presence;  ///< alpha of its phase [cell]: no value where 0; empty: a value everywhere

  std::string column(std::size_t component) const {
    return components.empty() ? name : name + "." + components[component];
  }
};

/// Every field that can be chosen.
const std::vector<std::string>& all_output_fields();

/// The chosen fields (of: alpha density velocity pressure stress cobasis energy), phases in order, then the mixture's.
/// alpha is left out of a scene of one phase; what a phase does not have is left out. The same list on every rank.
std::vector<OutputField> output_fields(const std::vector<std::string>& chosen, const Snapshot& snapshot,
                                       const Mixture& mixture);

}  // namespace cobasis
