#include "app/case_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <utility>

#include "app/case_key_tables.hpp"
#include "physics/eos.hpp"
#include "physics/hyperelastic_material.hpp"
#include "physics/material_library.hpp"
#include "solver/setup.hpp"

namespace cobasis {
namespace {

template <class Owner>
KeyInfo key_of(const FieldInfo<Owner>& field, bool required, const std::string& fallback) {
  return {.key = std::string(field.key),
          .kind = KeyKind::number,
          .unit = std::string(field.unit),
          .range = {field.low, field.high, field.low_closed, field.high_closed},
          .required = required,
          .fallback = fallback,
          .meaning = std::string(field.meaning)};
}

template <class Equation>
KeyTable keys_of_eos() {
  KeyTable table{fmt::format("eos type = {}", Equation::name), "equation of state", {}};
  for (const auto& field : Equation::fields()) table.keys.push_back(key_of(field, true, "the material's"));
  return table;
}

template <class... Equation>
void add_eos(std::vector<KeyTable>& tables, std::vector<std::string>& names, const std::variant<Equation...>*) {
  (names.emplace_back(Equation::name), ...);
  (tables.push_back(keys_of_eos<Equation>()), ...);
}

KeyTable keys_of_elastic() {
  KeyTable table{"elastic", "stored energy of a solid; without it the phase is a fluid", {}};
  for (const auto& field : HyperelasticMaterial::fields()) {
    const bool has_default = field.member == &HyperelasticMaterial::a;
    table.keys.push_back(key_of(
        field, !has_default,
        has_default ? fmt::format("{}, or the material's", HyperelasticMaterial{}.a) : std::string("the material's")));
  }
  return table;
}

std::vector<std::string> material_names() {
  std::vector<std::string> names;
  for (const Material& material : material_library()) names.emplace_back(material.name);
  return names;
}

std::vector<KeyTable> top_level() {
  const Setup defaults;
  std::vector<KeyTable> tables;
  tables.push_back(
      {"the case",
       "numbers in SI units, paths relative to the case file",
       {{.key = "schema",
         .kind = KeyKind::integer,
         .range = one_only,
         .required = true,
         .meaning = "version of this format"},
        {.key = "title", .kind = KeyKind::text, .fallback = "none", .meaning = "what the case is"},
        {.key = "mesh",
         .kind = KeyKind::text,
         .required = true,
         .meaning = "mesh file: .geo (meshed through Gmsh) or .msh"},
        {.key = "mesh_parameters", .kind = KeyKind::table, .fallback = "the .geo's", .meaning = "numbers for a .geo"},
        {.key = "scene",
         .kind = KeyKind::word,
         .words = {"plane", "axisymmetric", "space"},
         .fallback = "space for a mesh with volume cells, else plane",
         .meaning = "axisymmetric: x is along the axis, y >= 0 the distance from it, stress.zz that of the hoop, "
                    "totals are the whole body's"},
        {.key = "end_time", .unit = "s", .range = positive, .required = true, .meaning = "the run ends here"},
        {.key = "cfl",
         .unit = "-",
         .range = {0, 2, false, true},
         .fallback = fmt::format("{}", defaults.cfl),
         .meaning = "time step = cfl min 2V / sum A lambda; 1 is half a cell of squares per step"},
        {.key = "gravity",
         .kind = KeyKind::point,
         .unit = "m/s^2",
         .fallback = "none",
         .meaning = "acceleration of all phases; along the axis of an axisymmetric scene"},
        {.key = "alpha_min",
         .unit = "-",
         .range = {1e-12, 0.1, true, true, true},
         .fallback = fmt::format("{}", defaults.alpha_min),
         .meaning = "0: a phase is absent where it is not; else traces of every phase everywhere, of diffuse "
                    "interfaces only"},
        {.key = "max_steps",
         .kind = KeyKind::integer,
         .range = from(1, 1e15),
         .fallback = "no limit",
         .meaning = "the run ends after so many steps"},
        {.key = "checkpoint_every",
         .kind = KeyKind::integer_or_table,
         .unit = "steps",
         .range = from(1, 1e15),
         .fallback = fmt::format("{{ minutes = {} }}", CheckpointEvery{}.minutes),
         .meaning = "checkpoints for --restart, and one at the end if this is given"},
        {.key = "scheme", .kind = KeyKind::table, .fallback = "see there", .meaning = "numerical method"},
        {.key = "phase",
         .kind = KeyKind::table,
         .required = true,
         .meaning = "the phases; their order is that of the output"},
        {.key = "contact",
         .kind = KeyKind::table,
         .fallback = "sliding",
         .meaning = "contact between different phases"},
        {.key = "relaxation",
         .kind = KeyKind::table,
         .fallback = "none",
         .meaning = "of velocities and pressures of phases that are mixed"},
        {.key = "region", .kind = KeyKind::tables, .required = true, .meaning = "initial state, later over earlier"},
        {.key = "boundary",
         .kind = KeyKind::table,
         .required = true,
         .meaning = "boundary conditions by physical group"},
        {.key = "output", .kind = KeyKind::table, .fallback = "see there", .meaning = "what is written"},
        {.key = "line", .kind = KeyKind::tables, .fallback = "none", .meaning = "fields along lines at every output"},
        {.key = "probe", .kind = KeyKind::tables, .fallback = "none", .meaning = "fields at points over time"},
        {.key = "slice", .kind = KeyKind::tables, .fallback = "none", .meaning = "fields where planes cut the mesh"},
        {.key = "integral", .kind = KeyKind::tables, .fallback = "none", .meaning = "columns of history.csv"}}});
  tables.push_back({"checkpoint_every",
                    "one of",
                    {{.key = "steps",
                      .kind = KeyKind::integer,
                      .range = from(1, 1e15),
                      .fallback = "minutes",
                      .meaning = "after so many"},
                     {.key = "minutes",
                      .unit = "min",
                      .range = positive,
                      .fallback = fmt::format("{}", CheckpointEvery{}.minutes),
                      .meaning = "of the wall clock, since the last one"}}});
  tables.push_back(
      {"[mesh_parameters]", "", {{.key = "NAME", .meaning = "a number the .geo names in DefineConstant"}}});
  tables.push_back(
      {"[scheme]",
       "",
       {{.key = "accuracy",
         .kind = KeyKind::word,
         .words = {"fast", "balanced", "accurate"},
         .fallback = "balanced",
         .meaning = "fast: order 1, diffuse; balanced: the defaults below; accurate: order 2, sharp. The keys "
                    "below replace single choices"},
        {.key = "order",
         .kind = KeyKind::integer,
         .range = {1, 2, true, true},
         .fallback = fmt::format("{}", defaults.scheme.order),
         .meaning = "order in space and time"},
        {.key = "interface",
         .kind = KeyKind::word,
         .words = {"sharp", "compressed", "diffuse"},
         .fallback = "sharp between two phases at order 2 without [relaxation], else diffuse",
         .meaning = "sharp: a plane in every cell that an interface crosses, bodies slide on any mesh; "
                    "compressed: thin, for films and splashes; diffuse: mixtures, as in the paper"},
        {.key = "limiter",
         .kind = KeyKind::word,
         .words = {"monotone", "none"},
         .fallback = "monotone",
         .meaning = "of order 2"},
        {.key = "low_mach",
         .kind = KeyKind::word,
         .words = {"on", "off"},
         .fallback = defaults.scheme.low_mach ? "on" : "off",
         .meaning = "less acoustic dissipation where the flow is slow and the pressure smooth"}}});
  return tables;
}

void add_phases(std::vector<KeyTable>& tables) {
  std::vector<KeyTable> eos_tables;
  std::vector<std::string> eos_names;
  add_eos(eos_tables, eos_names, static_cast<const Eos*>(nullptr));

  tables.push_back(
      {"[phase.NAME]",
       "a material and / or its own eos, or else a void; NAME: letters, digits, _ and -",
       {{.key = "material",
         .kind = KeyKind::word,
         .words = material_names(),
         .fallback = "none",
         .meaning = "from the library; other keys override it"},
        {.key = "eos", .kind = KeyKind::table, .fallback = "the material's", .meaning = "equation of state"},
        {.key = "elastic", .kind = KeyKind::table, .fallback = "the material's", .meaning = "makes it a solid"},
        {.key = "density",
         .unit = "kg/m^3",
         .range = positive,
         .fallback = "the material's",
         .meaning = "initial density of a fluid where a region gives none (a solid has elastic.rho0)"},
        {.key = "void",
         .kind = KeyKind::table,
         .fallback = "none",
         .meaning = "no state of its own: a free surface"}}});
  tables.push_back({"eos",
                    "",
                    {{.key = "type",
                      .kind = KeyKind::word,
                      .words = eos_names,
                      .required = true,
                      .fallback = "the material's",
                      .meaning = "which equation of state"}}});
  std::ranges::move(eos_tables, std::back_inserter(tables));
  tables.push_back(keys_of_elastic());
  tables.push_back(
      {"void",
       "",
       {{.key = "pressure", .unit = "Pa", .range = not_negative, .required = true, .meaning = "on the free surface"}}});
  const std::vector<std::string> contacts{"sliding", "adherence", "friction"};
  tables.push_back({"[contact]",
                    "",
                    {{.key = "default",
                      .kind = KeyKind::word_or_table,
                      .words = contacts,
                      .fallback = "sliding",
                      .meaning = "of every pair; only solids can do other than slide"},
                     {.key = "A-B",
                      .kind = KeyKind::word_or_table,
                      .words = contacts,
                      .fallback = "default",
                      .meaning = "of phases A and B; a word or { type = word, ... }"}}});
  tables.push_back({"[contact] type = sliding", "no shear stress", {}});
  tables.push_back({"[contact] type = adherence", "solids are bonded", {}});
  tables.push_back({"[contact] type = friction",
                    "solids are bonded, or slip under Coulomb's shear stress; its heat stays half on either side",
                    {{.key = "coefficient",
                      .unit = "-",
                      .range = {0, infinity, true, false},
                      .required = true,
                      .meaning = "largest shear stress over the pressure -sigma_nn of the contact"}}});
  tables.push_back(
      {"[relaxation]",
       "in cells that two phases share, so with diffuse interfaces only; mass of each, momentum and energy "
       "of both stay",
       {{.key = "A-B",
         .kind = KeyKind::table,
         .fallback = "none",
         .meaning = "between phases A and B: { velocity = ..., pressure = ... }"}}});
  tables.push_back(
      {"relaxation A-B",
       "stiff: at once, common velocity or pressure after every step",
       {{.key = "velocity",
         .kind = KeyKind::number_or_word,
         .unit = "kg/(m^3 s)",
         .range = not_negative,
         .words = {"stiff"},
         .fallback = "0",
         .meaning = "drag, per difference of velocities and alpha_A alpha_B; each phase keeps as heat what "
                    "it loses of its kinetic energy as seen from the common velocity"},
        {.key = "pressure",
         .kind = KeyKind::number_or_word,
         .unit = "1/(Pa s)",
         .range = not_negative,
         .words = {"stiff"},
         .fallback = "0",
         .meaning = "d alpha_A / dt, per difference of pressures and alpha_A alpha_B; work is done by the "
                    "pressure at which both come to rest; a solid keeps its shape; nothing, where a phase would "
                    "grow tenfold in a step"}}});
}

}  // namespace

std::span<const KeyTable> case_keys() {
  static const std::vector<KeyTable> tables = [] {
    std::vector<KeyTable> all = top_level();
    add_phases(all);
    add_regions(all);
    add_boundaries_and_output(all);
    return all;
  }();
  return tables;
}

const KeyTable& keys_of(std::string_view title) {
  const auto found = std::ranges::find(case_keys(), title, &KeyTable::title);
  assert(found != case_keys().end());
  return *found;
}

}  // namespace cobasis
