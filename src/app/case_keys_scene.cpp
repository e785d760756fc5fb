// Keys of what a scene looks like at first, what surrounds it, and what it leaves.
#include "app/case_key_tables.hpp"
#include "app/output_fields.hpp"

namespace cobasis {

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
  const KeyInfo wall_velocity{
      .key = "velocity",
      .kind = KeyKind::vector_field,
      .unit = "m/s",
      .fallback = "at rest",
      .meaning = "of the wall; the mesh stays: along its normal, material enters or leaves there"};
  tables.push_back({"[boundary] type = wall", "frictionless: of a velocity the normal part counts", {wall_velocity}});
  tables.push_back({"[boundary] type = no_slip",
                    "solids are bonded to it; before fluids, which have no viscosity, a frictionless wall",
                    {wall_velocity}});
  tables.push_back({"[boundary] type = symmetry",
                    "mirror; bodies and interfaces go on beyond, which before a wall they do not",
                    {}});
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

}  // namespace cobasis
