#include "physics/material_library.hpp"

#include <algorithm>
#include <array>

namespace cobasis {
namespace {

constexpr std::string_view table_3 = "Hank, Favrie, Massoni 2017, Table 3";
constexpr std::string_view perfect_gas = "perfect gas at 20 C and 101325 Pa";

constexpr std::array<Material, 8> library{{
    {"aluminium", StiffenedGas{3.4, 21.5e9}, HyperelasticMaterial{26e9, 2700, 0.5}, 2700, table_3},
    {"copper", StiffenedGas{4.2, 34.2e9}, HyperelasticMaterial{92e9, 8900, 0.5}, 8900, table_3},
    {"carbopol", StiffenedGas{2.2, 1e6}, HyperelasticMaterial{85, 1020, 0}, 1020, table_3},
    {"air", IdealGas{1.4}, std::nullopt, 1.19, table_3},
    {"water", StiffenedGas{4.4, 6e8}, std::nullopt, 1000, "Saurel, Abgrall 1999"},
    {"nitrogen", IdealGas{1.4}, std::nullopt, 1.165, perfect_gas},
    {"argon", IdealGas{5.0 / 3.0}, std::nullopt, 1.661, perfect_gas},
    {"helium", IdealGas{5.0 / 3.0}, std::nullopt, 0.1664, perfect_gas},
}};

}  // namespace

std::span<const Material> material_library() { return library; }

const Material* find_material(std::string_view name) {
  const auto found = std::ranges::find(library, name, &Material::name);
  return found == library.end() ? nullptr : &*found;
}

}  // namespace cobasis
