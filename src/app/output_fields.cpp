#include "app/output_fields.hpp"

#include <algorithm>
#include <utility>

namespace cobasis {
namespace {

const std::vector<std::string> vector_components = {"x", "y", "z"};
const std::vector<std::string> stress_components = {"xx", "yy", "zz", "xy", "yz", "xz"};
const std::vector<std::string> cobasis_components = {"e1.x", "e1.y", "e1.z", "e2.x", "e2.y",
                                                     "e2.z", "e3.x", "e3.y", "e3.z"};

OutputField field(const char* name, const char* unit, const std::vector<std::string>& components,
                  std::span<const std::vector<double>> values) {
  return {name, unit, components, {values.begin(), values.end()}, {}};
}

OutputField field(const char* name, const char* unit, const std::vector<double>& values) {
  return field(name, unit, {}, {&values, 1});
}

}  // namespace

const std::vector<std::string>& all_output_fields() {
  static const std::vector<std::string> names = {"alpha",  "density", "velocity", "pressure",
                                                 "stress", "cobasis", "energy"};
  return names;
}

std::vector<OutputField> output_fields(const std::vector<std::string>& chosen, const Snapshot& snapshot,
                                       const Mixture& mixture) {
  const auto wanted = [&](const char* name) { return std::find(chosen.begin(), chosen.end(), name) != chosen.end(); };
  std::vector<OutputField> fields;
  for (const PhaseSnapshot& phase : snapshot.phases) {
    const auto add = [&](OutputField field) {
      field.name += "." + phase.name;
      fields.push_back(std::move(field));
    };
    if (wanted("alpha") && snapshot.phases.size() > 1) add(field("alpha", "1", phase.alpha));
    if (phase.is_void) continue;
    const std::size_t first_of_state = fields.size();
    if (wanted("density")) add(field("density", "kg/m^3", phase.density));
    if (wanted("velocity")) add(field("velocity", "m/s", vector_components, phase.velocity));
    if (wanted("pressure")) add(field("pressure", "Pa", phase.pressure));
    if (wanted("stress")) add(field("stress", "Pa", stress_components, phase.stress));
    if (wanted("cobasis") && phase.is_solid) add(field("cobasis", "1", cobasis_components, phase.cobasis));
    if (wanted("energy")) add(field("energy", "J/kg", phase.energy));
    if (wanted("energy") && phase.is_solid) add(field("elastic_energy", "J/kg", phase.elastic_energy));
    for (std::size_t f = first_of_state; f < fields.size(); ++f) fields[f].presence = phase.alpha;
  }
  if (wanted("density")) fields.push_back(field("density", "kg/m^3", mixture.density));
  if (wanted("velocity")) fields.push_back(field("velocity", "m/s", vector_components, mixture.velocity));
  if (wanted("pressure")) fields.push_back(field("pressure", "Pa", mixture.pressure));
  if (wanted("stress")) fields.push_back(field("stress", "Pa", stress_components, mixture.stress));
  return fields;
}

}  // namespace cobasis
