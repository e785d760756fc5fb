// Materials known by name, with where their numbers come from.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "physics/eos.hpp"
#include "physics/hyperelastic_material.hpp"

namespace cobasis {

struct Material {
  std::string_view name;
  Eos eos;
  std::optional<HyperelasticMaterial> elastic;  ///< absent: a fluid
  double rho0;                                  ///< density at rest [kg/m^3]
  std::string_view source;
};

std::span<const Material> material_library();

/// nullptr: no material of this name.
const Material* find_material(std::string_view name);

}  // namespace cobasis
