#include "app/case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "app/case_parts.hpp"
#include "math/errors.hpp"
#include "math/suggestion.hpp"

namespace cobasis {
namespace {

TomlTable changed_document(const std::string& file, const CaseOverrides& overrides) {
  TomlTable document = read_toml(file);
  for (const auto& [key, value] : overrides.set) set_value(document, key, value);
  return document;
}

/// Numbers as such, so that 1 and 1.0 are the same.
void list_keys(const TomlValue& value, const std::string& name, std::map<std::string, std::string>& keys) {
  if (const auto* table = std::get_if<TomlTable>(&value.data)) {
    for (const TomlEntry& entry : *table)
      list_keys(entry.value, name.empty() ? entry.key : name + "." + entry.key, keys);
  } else if (const auto* array = std::get_if<TomlArray>(&value.data)) {
    for (std::size_t i = 0; i < array->size(); ++i) list_keys((*array)[i], fmt::format("{}.{}", name, i), keys);
  } else if (std::holds_alternative<std::int64_t>(value.data) || std::holds_alternative<double>(value.data)) {
    keys[name] = fmt::format("{}", number_of(value));
  } else {
    keys[name] = description(value);
  }
}

void read_mesh_keys(const CaseTable& top, CaseReading& reading) {
  Setup& setup = reading.setup;
  const auto mesh = top.text("mesh");
  std::filesystem::path path;
  if (mesh) {
    path = (std::filesystem::path(setup.case_file).parent_path() / *mesh).lexically_normal();
    setup.mesh_file = path.string();
    std::error_code none;
    if (path.extension() != ".geo" && path.extension() != ".msh")
      reading.mistakes.add(top.where("mesh"), fmt::format("mesh = \"{}\"; allowed: a .geo or .msh file", *mesh));
    else if (!std::filesystem::is_regular_file(path, none))
      reading.mistakes.add(top.where("mesh"), fmt::format("mesh = \"{}\": there is no file {}; allowed: an existing "
                                                          ".geo or .msh, relative to the case file",
                                                          *mesh, setup.mesh_file));
  }
  const TomlEntry* parameters = top.table("mesh_parameters");
  if (!parameters) return;
  const auto& numbers = std::get<TomlTable>(parameters->value.data);
  if (!numbers.empty() && path.extension() == ".msh")
    reading.mistakes.add(parameters->where, "mesh_parameters of a .msh, which is a finished mesh; allowed: of a .geo");
  for (const TomlEntry& entry : numbers)
    if (check_value(keys_of("[mesh_parameters]").keys.front(), "mesh_parameters." + entry.key, entry.value,
                    reading.mistakes))
      setup.mesh_parameters[entry.key] = number_of(entry.value);
}

void read_top_level(const CaseTable& top, CaseReading& reading) {
  Setup& setup = reading.setup;
  setup.title = top.text("title").value_or("");
  if (const auto scene = top.text("scene"))
    setup.scene = *scene == "plane"          ? Geometry::plane
                  : *scene == "axisymmetric" ? Geometry::axisymmetric
                                             : Geometry::space;
  setup.end_time = top.number("end_time").value_or(0);
  if (const double least = 1e-100; top.entry("end_time") && setup.end_time < least)  // its thousandth must not be 0
    reading.mistakes.add(top.where("end_time"),
                         fmt::format("end_time = {}; allowed: at least {} s", setup.end_time, least));
  setup.cfl = top.number("cfl").value_or(setup.cfl);
  setup.gravity = top.point("gravity").value_or(setup.gravity);
  setup.alpha_min = top.number("alpha_min").value_or(setup.alpha_min);
  setup.max_steps = top.integer("max_steps");
  if (auto every = top.table("checkpoint_every", keys_of("checkpoint_every"))) {
    every->at_most_one({"steps", "minutes"});
    if (!every->has("steps") && !every->has("minutes"))
      every->mistakes().add(every->where(), "neither steps nor minutes; allowed: one of them");
    setup.checkpoint_every.emplace();
    setup.checkpoint_every->steps = every->integer("steps");
    setup.checkpoint_every->minutes = every->number("minutes").value_or(setup.checkpoint_every->minutes);
  } else if (const TomlEntry* steps = top.entry("checkpoint_every")) {
    setup.checkpoint_every = {static_cast<std::int64_t>(number_of(steps->value)), {}};
  }
}

/// What `accuracy` stands for: choices on the measured front of error against time, see cases/README.md.
Scheme scheme_for(std::string_view accuracy) {
  if (accuracy == "fast") return {.order = 1, .interface = InterfaceTreatment::diffuse};
  if (accuracy == "accurate") return {.order = 2, .interface = InterfaceTreatment::sharp};
  return {};
}

/// After the phases: a surface between two of them is kept sharp; where three may meet, mixtures bear more.
void read_scheme(const CaseTable& top, CaseReading& reading) {
  Scheme& scheme = reading.setup.scheme;
  bool chosen = false;
  if (const auto table = top.table("scheme", keys_of("[scheme]"))) {
    if (const auto accuracy = table->text("accuracy")) {
      scheme = scheme_for(*accuracy);
      chosen = *accuracy != "balanced";
    }
    scheme.order = static_cast<int>(table->integer("order").value_or(scheme.order));
    if (const auto name = table->text("interface")) {
      chosen = true;
      scheme.interface = *name == "sharp"        ? InterfaceTreatment::sharp
                         : *name == "compressed" ? InterfaceTreatment::compressed
                                                 : InterfaceTreatment::diffuse;
    }
    if (const auto name = table->text("limiter")) scheme.limited = *name != "none";
    if (const auto name = table->text("low_mach")) scheme.low_mach = *name == "on";
  }
  const bool mixed = reading.setup.alpha_min > 0 || top.has("relaxation");
  if (!chosen && scheme.order == 2 && reading.setup.phases.size() == 2 && !mixed)
    scheme.interface = InterfaceTreatment::sharp;
  if (reading.setup.alpha_min > 0 && scheme.interface != InterfaceTreatment::diffuse)
    reading.mistakes.add(
        top.where("alpha_min"),
        fmt::format("alpha_min = {} with sharp or compressed interfaces; allowed: 0, or interface = \"diffuse\" in "
                    "[scheme]",
                    reading.setup.alpha_min));
  if (top.has("relaxation") && scheme.interface != InterfaceTreatment::diffuse)
    reading.mistakes.add(
        top.where("relaxation"),
        "[relaxation] with sharp or compressed interfaces, where phases that share a cell are bodies on "
        "either side of a surface and no mixture; allowed: interface = \"diffuse\" in [scheme]");
}

/// `--set phase.coper.material=copper` makes a phase "coper", which nobody asked for if nothing is filled with it.
void check_phases_of_command_line(const CaseTable& top, CaseReading& reading) {
  const TomlEntry *phases = top.table("phase"), *regions = top.entry("region");
  const Setup& setup = reading.setup;
  if (!phases || !regions || std::get<TomlArray>(regions->value.data).size() != setup.regions.size()) return;
  for (std::size_t k = 0; k < setup.phases.size(); ++k) {
    const std::string& name = setup.phases[k].name;
    const auto fills = [&](const Filling& filling) { return filling.alpha[k] > setup.alpha_min; };
    const auto enters = [&](const BoundarySetup& boundary) {
      const auto* inflow = std::get_if<Inflow>(&boundary.boundary);
      return inflow && fills(inflow->filling);
    };
    const TomlEntry& entry = std::get<TomlTable>(phases->value.data)[k];
    if (!entry.value.where.from_command_line() || std::ranges::any_of(setup.boundaries, enters) ||
        std::ranges::any_of(setup.regions, [&](const RegionSetup& region) { return fills(region.filling); }))
      continue;
    std::vector<std::string> others;
    for (const PhaseSetup& phase : setup.phases)
      if (phase.name != name) others.push_back(phase.name);
    reading.mistakes.add(entry.value.where,
                         fmt::format("phase \"{}\" fills no region; {}", name, allowed_names(name, others)));
  }
}

}  // namespace

Setup read_case(const std::string& file, const CaseOverrides& overrides) {
  const TomlTable document = changed_document(file, overrides);
  CaseReading reading{{}, Mistakes(file), {}};
  reading.setup.case_file = file;
  list_keys({document, {}}, "", reading.setup.keys);
  const CaseTable top(document, Place{1, {}}, keys_of("the case"), reading.mistakes);
  read_top_level(top, reading);
  read_mesh_keys(top, reading);
  read_phases(top, reading);
  read_scheme(top, reading);
  read_contacts(top, reading);
  read_relaxations(top, reading);
  read_regions(top, reading);
  read_boundaries(top, reading);
  check_phases_of_command_line(top, reading);
  read_output(top, reading);
  if (!overrides.output.empty()) {
    reading.setup.output.directory = overrides.output;
    reading.setup.output.where = "--output";
  }
  if (reading.setup.scene)
    for (const std::string& mistake : mistakes_in_geometry(reading.setup, *reading.setup.scene))
      reading.mistakes.add(mistake);
  reading.mistakes.throw_if_any();
  return std::move(reading.setup);
}

std::vector<std::pair<std::string, std::string>> periodic_pairs(const Setup& setup) {
  std::vector<std::pair<std::string, std::string>> pairs;
  for (const BoundarySetup& boundary : setup.boundaries)
    if (const auto* periodic = std::get_if<Periodic>(&boundary.boundary))
      if (std::ranges::find(pairs, std::pair(periodic->with, boundary.group)) == pairs.end())
        pairs.emplace_back(boundary.group, periodic->with);
  return pairs;
}

}  // namespace cobasis
