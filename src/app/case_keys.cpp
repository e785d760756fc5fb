#include "app/case_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <utility>

#include "app/output_fields.hpp"
#include "physics/eos.hpp"
#include "physics/hyperelastic_material.hpp"
#include "physics/material_library.hpp"
#include "solver/setup.hpp"

namespace cobasis {
namespace {

constexpr Range positive{0, infinity, false, false};
constexpr Range not_negative{0, infinity, true, false};
constexpr Range one_only{1, 1, true, true};
constexpr Range fraction{0, 1, false, false};
constexpr Range any_number{};

constexpr Range from(double low, double high) { return {low, high, true, true}; }

template <class Owner>
KeyInfo key_of(const FieldInfo<Owner>& field, bool required, std::string fallback) {
  return {.key = std::string(field.key),
          .kind = KeyKind::number,
          .unit = std::string(field.unit),
          .range = {field.low, field.high, field.low_closed, field.high_closed},
          .required = required,
          .fallback = std::move(fallback),
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

void add_regions(std::vector<KeyTable>& tables) {
  const KeyInfo from_point{
      .key = "from", .kind = KeyKind::point, .unit = "m", .required = true, .meaning = "axis begins"};
  const KeyInfo to_point{.key = "to", .kind = KeyKind::point, .unit = "m", .required = true, .meaning = "axis ends"};
  const KeyInfo radius{.key = "radius", .unit = "m", .range = positive, .required = true, .meaning = "radius"};
  const std::vector<KeyTable> shapes{
      {"[[region]] shape = everywhere", "the whole mesh", {}},
      {"[[region]] shape = half_space",
       "the side the normal points to",
       {{.key = "point", .kind = KeyKind::point, .unit = "m", .required = true, .meaning = "on the plane"},
        {.key = "normal", .kind = KeyKind::point, .unit = "-", .required = true, .meaning = "any length but zero"}}},
      {"[[region]] shape = box",
       "with 2 numbers: of any z (plane only)",
       {{.key = "low", .kind = KeyKind::point, .unit = "m", .required = true, .meaning = "smallest coordinates"},
        {.key = "high", .kind = KeyKind::point, .unit = "m", .required = true, .meaning = "largest coordinates"}}},
      {"[[region]] shape = sphere",
       "a disc in a plane; in an axisymmetric scene a ball or, off the axis, a torus",
       {{.key = "center", .kind = KeyKind::point, .unit = "m", .required = true, .meaning = "center"}, radius}},
      {"[[region]] shape = cylinder", "finite; space only", {from_point, to_point, radius}},
      {"[[region]] shape = physical_group",
       "",
       {{.key = "name",
         .kind = KeyKind::text,
         .required = true,
         .meaning = "cells of this physical group of the mesh"}}},
      {"[[region]] shape = expression",
       "where it is true",
       {{.key = "inside",
         .kind = KeyKind::expression,
         .required = true,
         .meaning = "condition in x, y, z with && || < <= > >= == !="}}}};

  KeyInfo shape{.key = "shape", .kind = KeyKind::word, .required = true, .meaning = "has the keys of its own table"};
  for (const KeyTable& table : shapes) shape.words.push_back(table.title.substr(table.title.find("= ") + 2));
  tables.push_back({"[[region]]", "painted in order, later over earlier; besides, the keys of a filling", {shape}});
  std::ranges::copy(shapes, std::back_inserter(tables));

  const KeyInfo density{.key = "density",
                        .kind = KeyKind::field,
                        .unit = "kg/m^3",
                        .range = positive,
                        .fallback = "rho0 det(cobasis) of a solid, the phase's of a fluid",
                        .meaning = "density"};
  const KeyInfo pressure{.key = "pressure",
                         .kind = KeyKind::field,
                         .unit = "Pa",
                         .range = any_number,
                         .fallback = "required",
                         .meaning = "p, not -sigma; under gravity a formula: \"1e5 + 9810*(1 - y)\""};
  const KeyInfo velocity{.key = "velocity",
                         .kind = KeyKind::vector_field,
                         .unit = "m/s",
                         .fallback = "0",
                         .meaning = "2 or 3 numbers or expressions in x, y, z"};
  tables.push_back(
      {"filling",
       "of a region or an inflow: fill or alpha, and a state of all phases that phase.NAME overrides",
       {{.key = "fill", .kind = KeyKind::text, .fallback = "alpha", .meaning = "the one phase that is there"},
        {.key = "alpha", .kind = KeyKind::table, .fallback = "fill", .meaning = "volume fractions, sum 1"},
        density,
        pressure,
        velocity,
        {.key = "phase",
         .kind = KeyKind::table,
         .fallback = "none",
         .meaning = "phase.NAME: states of single phases"}}});
  tables.push_back({"filling alpha",
                    "",
                    {{.key = "NAME", .unit = "-", .range = from(0, 1), .meaning = "volume fraction of a phase"}}});
  tables.push_back({"filling phase.NAME",
                    "",
                    {density,
                     pressure,
                     velocity,
                     {.key = "cobasis",
                      .kind = KeyKind::matrix,
                      .unit = "-",
                      .fallback = "identity scaled so that density = rho0 det(cobasis)",
                      .meaning = "of a solid; rows: x, y, z components of (e^1, e^2, e^3)"}}});
}

void add_boundaries_and_output(std::vector<KeyTable>& tables) {
  tables.push_back(
      {"[boundary]",
       "",
       {{.key = "GROUP",
         .kind = KeyKind::word_or_table,
         .words = {"wall", "no_slip", "symmetry", "axis", "transmissive", "outlet", "inflow", "periodic"},
         .meaning = "of a physical group, or of \"*\", every group not named; a word or { type = word, ... }"}}});
  const KeyInfo wall_velocity{.key = "velocity",
                              .kind = KeyKind::vector_field,
                              .unit = "m/s",
                              .fallback = "at rest",
                              .meaning = "of the wall; the mesh stays, and what a wall that moves displaces enters"};
  tables.push_back({"[boundary] type = wall", "frictionless: of a velocity the normal part counts", {wall_velocity}});
  tables.push_back({"[boundary] type = no_slip",
                    "solids are bonded to it; before fluids, which have no viscosity, a frictionless wall",
                    {wall_velocity}});
  tables.push_back({"[boundary] type = symmetry", "mirror", {}});
  tables.push_back({"[boundary] type = axis", "y = 0 of an axisymmetric scene, and nothing else", {}});
  tables.push_back({"[boundary] type = transmissive", "zero gradient", {}});
  tables.push_back({"[boundary] type = outlet",
                    "an opening; of a solid the normal stress is given and shear passes",
                    {{.key = "pressure",
                      .unit = "Pa",
                      .range = any_number,
                      .required = true,
                      .meaning = "outside; where the flow leaves supersonic, it does not count"}}});
  tables.push_back({"[boundary] type = inflow", "besides, the keys of a filling", {}});
  tables.push_back({"[boundary] type = periodic",
                    "",
                    {{.key = "with",
                      .kind = KeyKind::text,
                      .required = true,
                      .meaning = "the group that is its translated image"}}});
  tables.push_back(
      {"[output]",
       "",
       {{.key = "directory", .kind = KeyKind::text, .fallback = "the case file's name, here", .meaning = "where to"},
        {.key = "every", .unit = "s", .range = positive, .fallback = "count", .meaning = "time between outputs"},
        {.key = "count",
         .kind = KeyKind::integer,
         .range = from(1, 1e6),
         .fallback = "20",
         .meaning = "number of outputs"},
        {.key = "fields",
         .kind = KeyKind::words,
         .words = all_output_fields(),
         .fallback = "alpha, density, velocity, pressure, stress",
         .meaning = "of each phase, and of the mixture"},
        {.key = "precision",
         .kind = KeyKind::word,
         .words = {"float32", "float64"},
         .fallback = "float32",
         .meaning = "in files"},
        {.key = "only",
         .kind = KeyKind::names,
         .fallback = "all cells",
         .meaning = "phases: fields/ holds only cells in which one of them is; slices hold all"},
        {.key = "only_above",
         .unit = "-",
         .range = {0, 1, true, false},
         .fallback = "0",
         .meaning = "with only: cells with a volume fraction above this"},
        {.key = "history_every",
         .kind = KeyKind::integer,
         .range = from(1, 1e15),
         .fallback = "one row per 0.1 % of the run",
         .meaning = "steps between rows of history.csv"}}});
  const KeyInfo name{
      .key = "name", .kind = KeyKind::file_name, .required = true, .meaning = "unique; letters, digits, _ - ."};
  tables.push_back({"[[line]]",
                    "",
                    {name,
                     {.key = "from", .kind = KeyKind::point, .unit = "m", .required = true, .meaning = "first point"},
                     {.key = "to", .kind = KeyKind::point, .unit = "m", .required = true, .meaning = "last point"},
                     {.key = "points",
                      .kind = KeyKind::integer,
                      .range = from(2, 1e7),
                      .required = true,
                      .meaning = "number of points"}}});
  tables.push_back({"[[probe]]",
                    "",
                    {name, {.key = "at", .kind = KeyKind::point, .unit = "m", .required = true, .meaning = "point"}}});
  tables.push_back(
      {"[[slice]]",
       "its own series for ParaView, NAME.pvd",
       {name,
        {.key = "point", .kind = KeyKind::point, .unit = "m", .required = true, .meaning = "on the plane"},
        {.key = "normal", .kind = KeyKind::point, .unit = "-", .required = true, .meaning = "any length but zero"},
        {.key = "every", .unit = "s", .range = positive, .fallback = "as [output]", .meaning = "time between slices"},
        {.key = "count",
         .kind = KeyKind::integer,
         .range = from(1, 1e6),
         .fallback = "as [output]",
         .meaning = "number of slices"}}});
  tables.push_back({"[[integral]]",
                    "extent, quantile or mean",
                    {name,
                     {.key = "extent",
                      .kind = KeyKind::table,
                      .fallback = "quantile or mean",
                      .meaning = "farthest coordinate of a phase"},
                     {.key = "quantile",
                      .kind = KeyKind::table,
                      .fallback = "extent or mean",
                      .meaning = "coordinate that holds a fraction of it"},
                     {.key = "mean",
                      .kind = KeyKind::table,
                      .fallback = "extent or quantile",
                      .meaning = "of a field over a region, by volume; of a phase's field by the phase's volume"}}});
  const KeyInfo phase{.key = "phase", .kind = KeyKind::text, .required = true, .meaning = "name of a phase"};
  const KeyInfo axis{.key = "axis",
                     .kind = KeyKind::word,
                     .words = {"x", "y", "z", "radial"},
                     .required = true,
                     .meaning = "the coordinate"};
  tables.push_back({"extent",
                    "",
                    {phase,
                     {.key = "alpha", .unit = "-", .range = fraction, .required = true, .meaning = "volume fraction"},
                     axis,
                     {.key = "box",
                      .kind = KeyKind::table,
                      .fallback = "the whole mesh",
                      .meaning = "only what lies in it counts, as along a line of some width"}}});
  tables.push_back(
      {"quantile",
       "",
       {phase,
        {.key = "fraction", .unit = "-", .range = fraction, .required = true, .meaning = "of the phase's volume"},
        axis}});
  tables.push_back({"mean",
                    "",
                    {{.key = "field",
                      .kind = KeyKind::text,
                      .required = true,
                      .meaning = "a column as in tables: pressure.copper of a phase, stress.xx of the mixture"},
                     {.key = "box",
                      .kind = KeyKind::table,
                      .fallback = "the whole mesh",
                      .meaning = "region; cells are cut by it"}}});
  tables.push_back(
      {"box",
       "of a mean or an extent; with 2 numbers: of any z (plane only)",
       {{.key = "low", .kind = KeyKind::point, .unit = "m", .required = true, .meaning = "smallest coordinates"},
        {.key = "high", .kind = KeyKind::point, .unit = "m", .required = true, .meaning = "largest coordinates"}}});
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
