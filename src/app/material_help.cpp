#include "app/material_help.hpp"

#include <fmt/format.h>

#include <cmath>

#include "physics/material_library.hpp"

namespace cobasis {
namespace {

/// "gamma = 3.4, p_inf = 2.15e+10 Pa"
template <class Owner>
std::string numbers_of(const Owner& owner) {
  std::string text;
  for (const auto& field : Owner::fields())
    text += fmt::format("{}{} = {:g}{}", text.empty() ? "" : ", ", field.key, owner.*field.member,
                        field.unit == "-" ? "" : fmt::format(" {}", field.unit));
  return text;
}

}  // namespace

std::string describe_materials() {
  std::string text =
      "Materials of the library: [phase.NAME] material = \"copper\"; keys of eos and elastic override single numbers.\n"
      "Their meaning: cobasis help case. Speeds are those of long and shear waves at rest and 101325 Pa.\n";
  constexpr double atmosphere = 101325;
  for (const Material& material : material_library()) {
    const double rho = material.rho0;
    const double sound =
        std::visit([&](const auto& eos) { return eos.sound_speed_squared(rho, atmosphere); }, material.eos);
    const double mu = material.elastic ? material.elastic->mu : 0;
    text += fmt::format("\n{}: a {}, {:g} kg/m^3 at rest, {:.4g} m/s", material.name,
                        material.elastic ? "solid" : "fluid", rho, std::sqrt(sound + 4 * mu / (3 * rho)));
    if (material.elastic) text += fmt::format(", {:.4g} m/s", std::sqrt(mu / rho));
    text += fmt::format("\n  eos = {{ type = \"{}\" }}: {}\n",
                        std::visit([](const auto& eos) { return eos.name; }, material.eos),
                        std::visit([](const auto& eos) { return numbers_of(eos); }, material.eos));
    if (material.elastic) text += fmt::format("  elastic: {}\n", numbers_of(*material.elastic));
    text += fmt::format("  source: {}\n", material.source);
  }
  return text;
}

}  // namespace cobasis
