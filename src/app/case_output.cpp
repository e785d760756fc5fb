// [output], [[line]], [[probe]], [[integral]].
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "app/case_parts.hpp"
#include "app/output_fields.hpp"
#include "math/suggestion.hpp"

namespace cobasis {
namespace {

constexpr int default_count = 20;

/// Unique among the names that share a file or a directory, and none of those that are taken there.
class Names {
 public:
  Names(std::set<std::string> taken, std::string where) : taken_(std::move(taken)), where_(std::move(where)) {}

  std::string read(const CaseTable& table) {
    const auto name = table.text("name");
    if (++count_ == most)
      table.mistakes().add(table.where(), fmt::format("{} tables of this kind; allowed: fewer in {}", most, where_));
    if (name && !taken_.insert(*name).second)
      table.mistakes().add(table.where("name"),
                           fmt::format("name = \"{}\" is taken in {}; allowed: a name of its own", *name, where_));
    return name.value_or("");
  }

 private:
  static constexpr int most = 1000;  // each costs memory
  int count_ = 0;
  std::set<std::string> taken_;
  std::string where_;
};

Axis axis_of(const CaseTable& table) {
  const std::string axis = table.text("axis").value_or("x");
  return axis == "x" ? Axis::x : axis == "y" ? Axis::y : axis == "z" ? Axis::z : Axis::radial;
}

int phase_of(const CaseTable& table, CaseReading& reading) {
  const auto name = table.text("phase");
  return name ? reading.phase(*name, table.where("phase")).value_or(0) : 0;
}

/// Columns that tables of this case can have, and their units.
std::vector<std::pair<std::string, std::string>> columns_of(const std::vector<PhaseSetup>& phases) {
  Snapshot empty;
  for (const PhaseSetup& phase : phases) {
    empty.phases.emplace_back();
    empty.phases.back().name = phase.name;
    empty.phases.back().is_void = phase.is_void();
    empty.phases.back().is_solid = phase.is_solid();
  }
  const Mixture mixture;
  std::vector<std::pair<std::string, std::string>> columns;
  for (const OutputField& field : output_fields(all_output_fields(), empty, mixture))
    for (std::size_t c = 0; c < field.values.size(); ++c) columns.emplace_back(field.column(c), field.unit);
  return columns;
}

std::optional<Box> read_box(const CaseTable& table, CaseReading& reading) {
  const auto box = table.table("box", keys_of("box"));
  if (!box) return std::nullopt;
  const auto low = box->point("low"), high = box->point("high");
  if (!low || !high) return std::nullopt;
  if (!(low->x < high->x && low->y < high->y && low->z <= high->z))
    reading.mistakes.add(box->where("high"), "box with high not above low; allowed: low < high in every coordinate");
  return Box{*low, *high};
}

IntegralSetup read_mean(const CaseTable& table, const std::string& name, CaseReading& reading) {
  IntegralSetup integral{name, Mean{table.text("field").value_or(""), Everywhere{}, {}}, {}};
  Mean& mean = std::get<Mean>(integral.what);
  mean.where = reading.mistakes.where(table.where());
  const auto columns = columns_of(reading.setup.phases);
  const auto found = std::ranges::find(columns, mean.field, &std::pair<std::string, std::string>::first);
  if (found != columns.end()) {
    integral.unit = found->second;
  } else if (table.text("field")) {
    std::vector<std::string> names;
    for (const auto& [column, unit] : columns) names.push_back(column);
    reading.mistakes.add(table.where("field"),
                         fmt::format("field = \"{}\"; {}", mean.field, allowed_names(mean.field, names)));
  }
  if (const auto box = read_box(table, reading)) mean.region = *box;
  return integral;
}

IntegralSetup read_integral(CaseTable& table, const std::string& name, CaseReading& reading) {
  table.at_most_one({"extent", "quantile", "mean"});
  if (const auto extent = table.table("extent", keys_of("extent")))
    return {name, Extent{phase_of(*extent, reading), extent->number("alpha").value_or(0), axis_of(*extent),
                         read_box(*extent, reading), reading.mistakes.where(extent->where())}};
  if (const auto quantile = table.table("quantile", keys_of("quantile")))
    return {name, Quantile{phase_of(*quantile, reading), quantile->number("fraction").value_or(0), axis_of(*quantile)}};
  if (const auto mean = table.table("mean", keys_of("mean"))) return read_mean(*mean, name, reading);
  if (!table.has("extent") && !table.has("quantile") && !table.has("mean"))
    reading.mistakes.add(table.where(), "neither extent nor quantile nor mean; allowed: one of them");
  return {name, Extent{}};
}

std::string directory_of(const std::optional<std::string>& given, const std::string& case_file) {
  const std::filesystem::path file(case_file);
  return given ? (file.parent_path() / *given).lexically_normal().string() : file.stem().string();
}

constexpr double most_outputs = 1e6;

/// Time between outputs, of which there are not more than a run can write.
std::optional<double> read_every(const CaseTable& table, CaseReading& reading) {
  const auto every = table.number("every");
  if (every && reading.setup.end_time / *every > most_outputs)
    reading.mistakes.add(table.where("every"),
                         fmt::format("every = {} with end_time = {}; allowed: at most {:g} outputs", *every,
                                     reading.setup.end_time, most_outputs));
  return every;
}

void read_output_table(CaseTable& table, CaseReading& reading) {
  OutputSetup& output = reading.setup.output;
  table.at_most_one({"every", "count"});
  const auto directory = table.text("directory");
  if (directory && directory->empty())
    reading.mistakes.add(table.where("directory"), "directory = \"\"; allowed: a path relative to the case file");
  output.directory = directory_of(directory, reading.setup.case_file);
  output.where = reading.mistakes.where(directory ? table.where("directory") : table.where());
  output.every = read_every(table, reading);
  if (const auto count = table.integer("count")) output.count = static_cast<int>(*count);
  if (const auto fields = table.words("fields")) output.fields = *fields;
  output.float64 = table.text("precision") == "float64";
  for (const std::string& name : table.names("only"))
    if (const auto k = reading.phase(name, table.where("only"))) output.only.push_back(*k);
  output.only_above = table.number("only_above").value_or(0);
  if (table.has("only_above") && !table.has("only"))
    reading.mistakes.add(table.where("only_above"), "only_above without only; allowed: with only = \"PHASE\"");
  reading.setup.history_every = table.integer("history_every");
}

SliceSetup read_slice(CaseTable& table, const std::string& name, CaseReading& reading) {
  table.at_most_one({"every", "count"});
  SliceSetup slice{name, table.point("point").value_or(Point{}), table.point("normal").value_or(Point{}), {},
                   {},   reading.mistakes.where(table.where())};
  if (table.point("normal") && slice.normal.x == 0 && slice.normal.y == 0 && slice.normal.z == 0)
    reading.mistakes.add(table.where("normal"), "normal of length 0; allowed: any other length");
  slice.every = read_every(table, reading);
  if (const auto count = table.integer("count")) slice.count = static_cast<int>(*count);
  if (!slice.every && !slice.count) {
    slice.every = reading.setup.output.every;
    slice.count = reading.setup.output.count;
  }
  return slice;
}

}  // namespace

void read_output(const CaseTable& top, CaseReading& reading) {
  Setup& setup = reading.setup;
  setup.output.directory = directory_of(std::nullopt, setup.case_file);
  setup.output.where = setup.case_file;
  setup.output.fields = {"alpha", "density", "velocity", "pressure", "stress"};
  if (auto table = top.table("output", keys_of("[output]"))) read_output_table(*table, reading);
  if (!setup.output.every && !setup.output.count) setup.output.count = default_count;

  constexpr std::int64_t most_points = 10'000'000;
  std::int64_t points = 0;
  Names files({"history", "units"}, "the output directory");
  for (const CaseTable& table : top.tables("line", keys_of("[[line]]"))) {
    const Point from = table.point("from").value_or(Point{}), to = table.point("to").value_or(Point{});
    setup.lines.push_back({files.read(table), from, to, static_cast<int>(table.integer("points").value_or(2))});
    if ((points += setup.lines.back().points) > most_points)
      table.mistakes().add(table.where("points"),
                           fmt::format("{} points on all lines together; allowed: at most {}", points, most_points));
  }
  for (const CaseTable& table : top.tables("probe", keys_of("[[probe]]")))
    setup.probes.push_back({files.read(table), table.point("at").value_or(Point{})});
  Names series({std::filesystem::path(setup.case_file).stem().string()}, "the output directory");
  for (CaseTable& table : top.tables("slice", keys_of("[[slice]]"))) {
    const std::string name = series.read(table);
    setup.slices.push_back(read_slice(table, name, reading));
  }
  Names columns({"step", "time", "dt"}, "history.csv");
  for (CaseTable& table : top.tables("integral", keys_of("[[integral]]"))) {
    const std::string name = columns.read(table);
    setup.integrals.push_back(read_integral(table, name, reading));
  }
}

}  // namespace cobasis
