// Everything a running simulation leaves on disk: fields for ParaView, lines, probes, the history.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/atomic_file.hpp"
#include "app/integrals.hpp"
#include "app/sampler.hpp"
#include "app/together.hpp"
#include "app/vtu_writer.hpp"
#include "mesh/mesh.hpp"
#include "mesh/mpi.hpp"
#include "solver/keeper.hpp"
#include "solver/setup.hpp"
#include "solver/snapshot.hpp"

namespace cobasis {

/// In the output directory, with the case file's stem:
///   stem.pvd            ParaView's entry: times and fields/stem_0000.pvtu, each with fields/stem_0000_<rank>.vtu
///   <slice>.pvd         the same of a slice: slices/<slice>_0000.pvtu
///   <line>.csv          the latest samples; <line>.series and <line>.csv.series: all of them, lines/<line>_0000.csv
///   <probe>.csv         a row per history row: step, time, fields
///   history.csv         step, time, dt, totals, integrals
///   units.csv           unit of every column: of the fields (VTU files, lines, probes), of the history
/// All members are collective. Failures to write are SystemError on all ranks together, with path and reason.
class Output {
 public:
  enum class Disk { ready, untouched };
  /// The mesh must outlive it. Makes the disk ready: creates the directory, last of all. Throws InputError, on all
  /// ranks together, if nothing can be written there, two tables would share a name, a point lies outside the mesh or a
  /// plane beside it. Files of others stay as they are; those of an earlier run of the case are replaced.
  Output(const Setup& setup, Geometry geometry, const Mesh& mesh, const Mpi& mpi, Disk disk = Disk::ready);

  /// Fields and lines.
  void write(const Snapshot& snapshot);
  void write_slice(std::size_t slice, const Snapshot& snapshot);
  /// A row of history.csv and of each probe. The snapshot needs alpha if needs_alpha_for_history(), all fields if
  /// needs_fields_for_history(). `totals`: the same on all ranks, the same names each time.
  void history(const Snapshot& snapshot, const std::vector<Column>& totals);
  void finish();
  /// What has been written so far. Where it is read, tables go on behind their rows, and what an interrupted run has
  /// written after it is taken away. Throws InputError, on all ranks together, where that is no longer there.
  void keep(Keeper& keeper);
  bool has_written(double time) const { return !fields_.files.empty() && fields_.files.back().first == time; }
  /// Of the latest fields: the path of the .pvtu.
  std::string latest_fields() const { return path(fields_.files.back().second); }

  bool needs_alpha_for_history() const { return !setup_.integrals.empty() || !setup_.probes.empty(); }
  bool needs_fields_for_history() const;
  /// The latest value of an [[integral]], in its unit.
  double integral(const std::string& name) const;
  /// The latest values of the [[integral]]s and, on rank 0, of the [[probe]]s: `gauge.pressure.copper`.
  const std::vector<Column>& latest() const { return latest_; }

 private:
  struct Table {
    std::string name;
    Sampler sampler;
    std::vector<std::pair<double, std::string>> files;  ///< of a line: time, path
    std::optional<RowFile> rows;                        ///< of a probe, rank 0
  };
  using Units = std::vector<std::pair<std::string, std::string>>;  ///< column, unit
  struct Samples {
    std::vector<std::string> columns, units;
    std::vector<double> rows;  ///< on rank 0, points in order
  };

  /// Files for ParaView: name.pvd, folder/name_0000.pvtu, folder/name_0000_<rank>.vtu.
  struct Series {
    std::string name, folder;
    std::vector<std::pair<double, std::string>> files = {};  ///< time, path of the .pvtu
  };
  struct Slice {
    Series series;
    std::vector<std::int32_t> cells;
    std::unique_ptr<VtuWriter> vtu;
  };

  std::string path(const std::string& name) const { return setup_.output.directory + "/" + name; }
  Samples sample(const Table& table, const Snapshot& snapshot) const;
  /// The snapshot holds the cells that the writer draws, in order.
  void write_series(Series& series, const VtuWriter& vtu, const Snapshot& snapshot);
  void write_line(Table& line, const Snapshot& snapshot, const std::string& number);
  void write_list_of(const Table& line) const;
  /// Once per place, of: fields (VTU files, lines, probes), history.
  void add_units(const std::string& where, const Units& units);
  /// Of another run from this number on; and pieces of the first output from this rank on.
  void remove_files_from(const Series& series, std::size_t number, int rank_of_first) const;
  void remove_files_from(const Table& line, std::size_t number) const;
  std::string written() const;
  void go_on_after(const std::string& written);
  void together(const std::function<void()>& action) const { do_together(mpi_, action); }

  Setup setup_;
  const Mesh& mesh_;
  const Mpi& mpi_;
  Series fields_;
  std::unique_ptr<VtuWriter> vtu_;  ///< of all cells
  std::vector<Slice> slices_;
  Integrals integrals_;
  std::vector<double> latest_integrals_;
  std::vector<Column> latest_;
  std::vector<Table> lines_, probes_;
  std::optional<RowFile> history_;            ///< rank 0
  std::map<std::string, std::string> units_;  ///< rows of units.csv by place
};

}  // namespace cobasis
