// The state of a run in the order of the whole mesh, whoever owns what: from all ranks into a checkpoint on rank 0, and
// from there to all ranks.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/checkpoint_file.hpp"
#include "mesh/mesh.hpp"
#include "mesh/mpi.hpp"
#include "solver/keeper.hpp"

namespace cobasis {

/// Which boundary face of the whole mesh each of a rank's is: ordered by group, owner's global id, place in that cell.
class BoundaryOrder {
 public:
  BoundaryOrder(const Mesh& mesh, const Mpi& mpi);  ///< collective

  std::vector<std::int64_t> of_gathered;  ///< rank 0: of the faces of all ranks, rank by rank
  std::vector<std::int64_t> own;
};

/// Whether these are rows of so many columns: the global id of a cell, then values from least to most.
bool are_rows(std::span<const double> numbers, std::size_t columns, double n_cells, double least, double most);

/// What fails on rank 0 is told by finish().
class StateWriter : public Keeper {
 public:
  /// Collective.
  StateWriter(const std::string& path, const Mesh& mesh, const Mpi& mpi);

  bool reads() const override { return false; }
  void number(const std::string& name, double& value) override;
  void counter(const std::string& name, std::int64_t& value) override;
  void cells(const std::string& name, std::span<double> values) override;
  void boundary_faces(const std::string& name, std::span<double> values) override;
  void some_cells(const std::string& name, CellRows& rows) override;
  void text(const std::string& name, std::string& value) override;
  /// Throws SystemError on all ranks together.
  void finish();

 private:
  template <class Action>
  void on_root(const Action& action);  ///< unless something has failed before

  const Mesh& mesh_;
  const Mpi& mpi_;
  std::optional<CheckpointFileWriter> file_;  ///< rank 0
  std::string error_;
  std::vector<std::int64_t> ids_;  ///< rank 0: of the cells of all ranks, rank by rank
  BoundaryOrder boundary_;
};

/// Of a file that is whole. Throws SystemError on all ranks together.
class StateReader : public Keeper {
 public:
  /// Collective.
  StateReader(const std::string& path, const Mesh& mesh, const Mpi& mpi);

  bool reads() const override { return true; }
  void number(const std::string& name, double& value) override;
  void counter(const std::string& name, std::int64_t& value) override;
  void cells(const std::string& name, std::span<double> values) override;
  void boundary_faces(const std::string& name, std::span<double> values) override;
  void some_cells(const std::string& name, CellRows& rows) override;
  void text(const std::string& name, std::string& value) override;

 private:
  std::vector<double> read(const std::string& name, std::size_t size);

  const Mesh& mesh_;
  const Mpi& mpi_;
  std::string path_;
  std::optional<CheckpointFileReader> file_;  ///< rank 0
  BoundaryOrder boundary_;
};

}  // namespace cobasis
