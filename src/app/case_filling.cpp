// What fills a region or enters through an inflow.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/case_parts.hpp"

namespace cobasis {
namespace {

/// Of all phases; nothing where it is wrong or missing.
std::optional<std::vector<double>> read_alpha(const CaseTable& table, CaseReading& reading) {
  const Setup& setup = reading.setup;
  const std::size_t n_phases = setup.phases.size();
  if (const auto fill = table.text("fill")) {
    const auto k = reading.phase(*fill, table.where("fill"));
    if (!k) return std::nullopt;
    std::vector<double> alpha(n_phases, setup.alpha_min);
    alpha[*k] = 1 - static_cast<double>(n_phases - 1) * setup.alpha_min;
    return alpha;
  }
  const TomlEntry* fractions = table.table("alpha");
  if (!fractions) {
    if (!table.has("fill") && !table.has("alpha"))
      reading.mistakes.add(table.where(),
                           "neither fill nor alpha; allowed: fill = \"PHASE\" or alpha = { PHASE = ... }");
    return std::nullopt;
  }
  bool right = true;
  std::vector<double> alpha(n_phases, 0);
  KeyInfo info = keys_of("filling alpha").keys.front();
  if (setup.alpha_min > 0) info.range.low = setup.alpha_min;
  for (const TomlEntry& entry : std::get<TomlTable>(fractions->value.data)) {
    info.key = "alpha." + entry.key;
    const auto k = reading.phase(entry.key, entry.where);
    right = check_value(info, info.key, entry.value, reading.mistakes) && k && right;
    if (right) alpha[*k] = number_of(entry.value);
  }
  if (!right) return std::nullopt;
  double sum = 0;
  for (const double x : alpha) sum += x;
  if (std::abs(sum - 1) > 1e-12) {
    reading.mistakes.add(fractions->where, fmt::format("alpha sums to {}; allowed: 1", sum));
    return std::nullopt;
  }
  for (std::size_t k = 0; k < n_phases; ++k) {
    if (alpha[k] >= setup.alpha_min) continue;
    reading.mistakes.add(fractions->where,
                         fmt::format("alpha of \"{}\" is missing; allowed: every phase at least alpha_min = {}",
                                     setup.phases[k].name, setup.alpha_min));
    return std::nullopt;
  }
  return alpha;
}

double determinant(const Matrix& m) {
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/// Where a state was read from: what is there but wrong has its mistake already and is not missing.
struct Sources {
  Place state, pressure;
  bool has_pressure, has_density;
  bool pressure_is_right;
};

/// A phase that is there has a pressure its equation of state can hold, and a density. Formulas the solver looks at,
/// cell by cell.
void check_state(const PhaseSetup& phase, const PhaseState& state, const Sources& from, Mistakes& mistakes) {
  const double lowest = std::visit([](const auto& eos) { return eos.lowest_pressure(); }, phase.eos);
  if (!from.has_pressure)
    mistakes.add(from.state, fmt::format("missing key \"pressure\" for phase \"{0}\"; allowed: pressure = ... [Pa], or "
                                         "phase.{0}.pressure",
                                         phase.name));
  else if (from.pressure_is_right && state.pressure.is_constant() && !(state.pressure.constant() > lowest))
    mistakes.add(from.pressure, fmt::format("pressure = {} of phase \"{}\"; allowed: {} < pressure [Pa]",
                                            state.pressure.constant(), phase.name, lowest));
  const double densest = std::visit([](const auto& eos) { return eos.densest(); }, phase.eos);
  double density = phase.density.value_or(0);
  if (state.density && state.density->is_constant()) density = state.density->constant();
  if (!state.density && state.cobasis) density = phase.elastic->rho0 * determinant(*state.cobasis);
  if (!(state.density && !state.density->is_constant()) && !(density < densest))
    mistakes.add(from.state, fmt::format("density {} of phase \"{}\"; allowed: below {} [kg/m^3], by its eos", density,
                                         phase.name, densest));
  if (!phase.is_solid() && !from.has_density && !phase.density)
    mistakes.add(from.state, fmt::format("no density of the fluid \"{0}\"; allowed: density or phase.{0}.density here, "
                                         "density or material in [phase.{0}]",
                                         phase.name));
}

void read_cobasis(const CaseTable& own, const PhaseSetup& phase, PhaseState& state) {
  const auto cobasis = own.matrix("cobasis");
  if (!cobasis) return;
  if (!phase.is_solid())
    own.mistakes().add(own.where("cobasis"),
                       fmt::format("cobasis of the fluid \"{}\"; allowed: of a solid", phase.name));
  else if (!(determinant(*cobasis) > 0))
    own.mistakes().add(own.where("cobasis"),
                       fmt::format("cobasis with determinant {}; allowed: 0 < det(cobasis)", determinant(*cobasis)));
  else
    state.cobasis = cobasis;
}

/// A pure void takes no state, but may repeat that its pressure is its pressure and that it rests.
void check_void_filling(const CaseTable& table, const PhaseSetup& phase, Mistakes& mistakes) {
  const auto pressure = table.expression("pressure");
  if (pressure && !(pressure->is_constant() && pressure->constant() == *phase.void_pressure))
    mistakes.add(
        table.where("pressure"),
        fmt::format("pressure = {} of the void \"{}\"; allowed: none, or {} as in [phase.{}]",
                    description(table.entry("pressure")->value), phase.name, *phase.void_pressure, phase.name));
  const auto rests = [](const Expression& u) { return u.is_constant() && u.constant() == 0; };
  const auto velocity = table.vector_field("velocity");
  if (velocity && !std::ranges::all_of(*velocity, rests))
    mistakes.add(table.where("velocity"),
                 fmt::format("velocity of the void \"{}\", which has no state; allowed: none, or 0", phase.name));
  if (table.has("density"))
    mistakes.add(table.where("density"),
                 fmt::format("density of the void \"{}\", which has no state; allowed: none", phase.name));
}

}  // namespace

std::optional<Filling> read_filling(CaseTable& table, CaseReading& reading) {
  table.at_most_one({"fill", "alpha"});
  const auto alpha = read_alpha(table, reading);
  const std::size_t n_phases = reading.setup.phases.size();
  const std::optional<Expression> pressure = table.expression("pressure"), density = table.expression("density");
  const auto velocity = table.vector_field("velocity");

  std::vector<const TomlEntry*> own(n_phases, nullptr);
  if (const TomlEntry* phases = table.table("phase")) {
    for (const TomlEntry& entry : std::get<TomlTable>(phases->value.data)) {
      const auto k = reading.phase(entry.key, entry.where);
      if (!k) continue;
      if (reading.setup.phases[*k].is_void())
        reading.mistakes.add(entry.where, fmt::format("state of the void \"{}\"; allowed: of other phases", entry.key));
      else if (!std::holds_alternative<TomlTable>(entry.value.data))
        reading.mistakes.add(entry.where, fmt::format("phase.{} = {}; allowed: a table with the keys of a state",
                                                      entry.key, description(entry.value)));
      else
        own[*k] = &entry;
    }
  }

  Filling filling;
  for (std::size_t k = 0; k < n_phases; ++k) {
    const PhaseSetup& phase = reading.setup.phases[k];
    PhaseState& state = filling.states.emplace_back();
    const bool named = alpha && (*alpha)[k] > reading.setup.alpha_min;
    const bool there = alpha && (*alpha)[k] > 0;
    if (phase.is_void()) {
      if (there && (*alpha)[k] == 1) check_void_filling(table, phase, reading.mistakes);
      continue;
    }
    state.pressure = pressure.value_or(0);
    if (velocity) state.velocity = *velocity;
    if (named) state.density = density;  // a trace has its phase's own density, not that of what fills the region
    Sources from{table.where(), table.where("pressure"), table.has("pressure"), named && table.has("density"),
                 pressure.has_value()};
    if (own[k]) {
      const CaseTable its(std::get<TomlTable>(own[k]->value.data), own[k]->where, keys_of("filling phase.NAME"),
                          reading.mistakes);
      const auto own_pressure = its.expression("pressure");
      if (its.has("pressure"))
        from = {its.where(), its.where("pressure"), true, from.has_density, own_pressure.has_value()};
      from.has_density = from.has_density || its.has("density");
      state.pressure = own_pressure.value_or(state.pressure);
      if (const auto x = its.expression("density")) state.density = x;
      state.velocity = its.vector_field("velocity").value_or(state.velocity);
      read_cobasis(its, phase, state);
    }
    if (there && reading.phase_is_right[k]) check_state(phase, state, from, reading.mistakes);
  }
  if (!alpha) return std::nullopt;
  filling.alpha = *alpha;
  return filling;
}

}  // namespace cobasis
