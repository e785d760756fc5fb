#include "app/output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <filesystem>
#include <limits>
#include <set>

#include "app/mixture.hpp"
#include "app/output_fields.hpp"
#include "app/tables.hpp"
#include "math/errors.hpp"

namespace cobasis {
namespace {

void check_table_names(const Setup& setup) {
  std::set<std::string> taken = {"history", "units"};
  const auto check = [&](const char* kind, const std::string& name) {
    const std::string what = fmt::format("{}: [[{}]] name '{}'", setup.case_file, kind, name);
    if (name.empty() || name.find('/') != std::string::npos) throw InputError(what + " is no file name");
    if (!taken.insert(name).second) throw InputError(what + " is already the name of another table");
  };
  for (const LineSetup& line : setup.lines) check("line", line.name);
  for (const ProbeSetup& probe : setup.probes) check("probe", probe.name);
}

}  // namespace

Output::Output(const Setup& setup, Geometry geometry, const Mesh& mesh, const Mpi& mpi, Disk disk)
    : setup_(setup),
      mesh_(mesh),
      mpi_(mpi),
      fields_{std::filesystem::path(setup.case_file).stem().string(), "fields"},
      integrals_(setup.integrals, geometry, mesh, mpi, setup.phases),
      latest_integrals_(setup.integrals.size(), std::numeric_limits<double>::quiet_NaN()) {
  check_table_names(setup);
  if (setup.output.only.empty()) vtu_ = std::make_unique<VtuWriter>(draw(mesh), setup.output.float64);
  for (const SliceSetup& slice : setup.slices) {
    const DrawnCells drawn = draw_cut(mesh, slice.point, slice.normal);
    if (mpi.sum(static_cast<std::int64_t>(drawn.cell.size())) == 0)
      throw InputError(fmt::format("{}: the plane of [[slice]] '{}' cuts no cell; allowed: one through the mesh",
                                   slice.where, slice.name));
    slices_.push_back({{slice.name, "slices"}, drawn.cell, std::make_unique<VtuWriter>(drawn, setup.output.float64)});
  }
  for (const LineSetup& line : setup.lines) {
    const std::string what = fmt::format("{}: [[line]] '{}'", setup.case_file, line.name);
    lines_.push_back({line.name, {mesh, mpi, points_on_line(line.from, line.to, line.points), what}, {}, {}});
  }
  for (const ProbeSetup& probe : setup.probes) {
    const std::string what = fmt::format("{}: [[probe]] '{}'", setup.case_file, probe.name);
    probes_.push_back({probe.name, {mesh, mpi, {probe.at}, what}, {}, {}});
  }
  if (disk == Disk::untouched) return;
  try {
    together([&] {
      const std::string probe = fmt::format(".writable.{}", mpi.rank());
      make_writable_directory(setup_.output.directory, probe);
      for (const char* folder : {"/fields", "/lines"}) make_writable_folder(setup_.output.directory + folder, probe);
      if (!setup_.slices.empty()) make_writable_folder(setup_.output.directory + "/slices", probe);
    });
  } catch (const SystemError& error) {
    throw InputError(
        fmt::format("{}: {}; allowed: a directory that can be made and written to", setup.output.where, error.what()));
  }
}

void Output::write(const Snapshot& snapshot) {
  const std::string number = fmt::format("{:04}", fields_.files.size());
  if (vtu_) {
    write_series(fields_, *vtu_, snapshot);
  } else {
    std::vector<std::int32_t> cells;
    for (std::int32_t cell = 0; cell < mesh_.n_owned; ++cell)
      if (std::ranges::any_of(setup_.output.only, [&](int k) {
            const auto& alpha = snapshot.phases[k].alpha;
            return (alpha.empty() ? 1 : alpha[cell]) > setup_.output.only_above;
          }))
        cells.push_back(cell);
    write_series(fields_, VtuWriter(draw(mesh_, cells), setup_.output.float64), extract(snapshot, cells));
  }
  for (Table& line : lines_) write_line(line, snapshot, number);
}

void Output::write_slice(std::size_t slice, const Snapshot& snapshot) {
  Slice& it = slices_[slice];
  write_series(it.series, *it.vtu, extract(snapshot, it.cells));
}

void Output::write_series(Series& series, const VtuWriter& vtu, const Snapshot& snapshot) {
  const std::string number = fmt::format("{:04}", series.files.size());
  const Mixture mixture = mix(snapshot, setup_.phases);
  const auto fields = output_fields(setup_.output.fields, snapshot, mixture);
  const auto piece = [&](int rank) { return fmt::format("{}_{}_{}.vtu", series.name, number, rank); };
  together([&] {
    write_atomically(path(series.folder + "/" + piece(mpi_.rank())), vtu.vtu(fields, snapshot.time, snapshot.step));
  });
  series.files.emplace_back(snapshot.time, fmt::format("{}/{}_{}.pvtu", series.folder, series.name, number));
  together([&] {
    if (!mpi_.root()) return;
    std::vector<std::string> pieces;
    for (int rank = 0; rank < mpi_.size(); ++rank) pieces.push_back(piece(rank));
    write_atomically(path(series.files.back().second), pvtu(fields, pieces, setup_.output.float64));
    write_atomically(path(series.name + ".pvd"), pvd(series.files));
    if (series.files.size() == 1) remove_files_from(series, 1, mpi_.size());
    Units units;
    for (const OutputField& field : fields) {
      for (std::size_t c = 0; c < field.values.size(); ++c) units.emplace_back(field.column(c), field.unit);
    }
    add_units("fields", units);
  });
}

void Output::write_line(Table& line, const Snapshot& snapshot, const std::string& number) {
  const Samples samples = sample(line, snapshot);
  if (line.files.empty() && mpi_.root()) remove_files_from(line, 0);
  line.files.emplace_back(snapshot.time, fmt::format("lines/{}_{}.csv", line.name, number));
  together([&] {
    if (!mpi_.root()) return;
    std::vector<std::string> header = {"x", "y", "z"};
    header.insert(header.end(), samples.columns.begin(), samples.columns.end());
    std::string text = csv_row(header);
    const std::vector<Point>& points = line.sampler.points();
    const std::size_t length = samples.columns.size();
    for (std::size_t p = 0; p < points.size(); ++p) {
      std::vector<double> row = {points[p].x, points[p].y, points[p].z};
      const double* values = samples.rows.data() + p * length;
      row.insert(row.end(), values, values + length);
      text += csv_row(row);
    }
    write_atomically(path(line.files.back().second), text);
    write_atomically(path(line.name + ".csv"), text);
    write_list_of(line);
  });
}

/// ParaView takes the reader from the second last extension; the short name is for people and programs.
void Output::write_list_of(const Table& line) const {
  for (const char* extension : {".series", ".csv.series"})
    write_atomically(path(line.name + extension), file_series(line.files));
}

bool Output::needs_fields_for_history() const {
  const auto is_mean = [](const IntegralSetup& integral) { return std::holds_alternative<Mean>(integral.what); };
  return !setup_.probes.empty() || std::any_of(setup_.integrals.begin(), setup_.integrals.end(), is_mean);
}

void Output::history(const Snapshot& snapshot, const std::vector<Column>& totals) {
  if (!setup_.integrals.empty()) latest_integrals_ = integrals_.evaluate(snapshot);
  std::vector<Samples> samples;
  for (const Table& probe : probes_) samples.push_back(sample(probe, snapshot));
  latest_.clear();
  for (std::size_t i = 0; i < setup_.integrals.size(); ++i)
    latest_.push_back({setup_.integrals[i].name, setup_.integrals[i].unit, latest_integrals_[i]});
  for (std::size_t p = 0; p < probes_.size() && mpi_.root(); ++p)
    for (std::size_t c = 0; c < samples[p].columns.size(); ++c)
      latest_.push_back({probes_[p].name + "." + samples[p].columns[c], samples[p].units[c], samples[p].rows[c]});
  together([&] {
    if (!mpi_.root()) return;
    Units columns = {{"step", "1"}, {"time", "s"}, {"dt", "s"}};
    std::vector<double> row = {static_cast<double>(snapshot.step), snapshot.time, snapshot.dt};
    for (const Column& total : totals) {
      columns.emplace_back(total.name, total.unit);
      row.push_back(total.value);
    }
    for (const IntegralSetup& integral : setup_.integrals) columns.emplace_back(integral.name, integral.unit);
    row.insert(row.end(), latest_integrals_.begin(), latest_integrals_.end());
    add_units("history", columns);
    if (!history_) {
      std::vector<std::string> header;
      for (const auto& [name, unit] : columns) header.push_back(name);
      history_.emplace(path("history.csv"), csv_row(header));
    }
    history_->append(csv_row(row));

    for (std::size_t p = 0; p < probes_.size(); ++p) {
      if (!probes_[p].rows) {
        std::vector<std::string> header = {"step", "time"};
        header.insert(header.end(), samples[p].columns.begin(), samples[p].columns.end());
        probes_[p].rows.emplace(path(probes_[p].name + ".csv"), csv_row(header));
      }
      std::vector<double> values = {static_cast<double>(snapshot.step), snapshot.time};
      values.insert(values.end(), samples[p].rows.begin(), samples[p].rows.end());
      probes_[p].rows->append(csv_row(values));
    }
  });
}

void Output::finish() {
  together([&] {
    if (history_) history_->close();
    for (Table& probe : probes_) {
      if (probe.rows) probe.rows->close();
    }
  });
}

double Output::integral(const std::string& name) const {
  const auto found = std::find_if(setup_.integrals.begin(), setup_.integrals.end(),
                                  [&](const IntegralSetup& integral) { return integral.name == name; });
  assert(found != setup_.integrals.end());
  return latest_integrals_[static_cast<std::size_t>(found - setup_.integrals.begin())];
}

Output::Samples Output::sample(const Table& table, const Snapshot& snapshot) const {
  const Snapshot here = extract(snapshot, table.sampler.cells());
  const Mixture mixture = mix(here, setup_.phases);
  const auto fields = output_fields(setup_.output.fields, here, mixture);
  return {columns_of(fields), units_of(fields), table.sampler.in_order(mpi_, rows_of(fields))};
}

void Output::add_units(const std::string& where, const Units& units) {
  std::string& rows = units_[where];
  if (!rows.empty()) return;
  for (const auto& [column, unit] : units) rows += csv_row(std::vector{where, column, unit});
  std::string text = "where,column,unit\n";
  for (const auto& [name, some_rows] : units_) text += some_rows;
  write_atomically(path("units.csv"), text);
}

}  // namespace cobasis
