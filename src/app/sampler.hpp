// Which cells the points of a line lie in, and what the fields are there.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"
#include "mesh/mpi.hpp"
#include "solver/snapshot.hpp"

namespace cobasis {

/// `n` points from one end to the other, both ends exact.
std::vector<Point> points_on_line(const Point& from, const Point& to, int n);

/// The cell of each of some points on a straight line: the one the point lies deepest in; on a face, up to round-off,
/// the one with the smallest global id. The answer does not depend on the number of ranks.
class Sampler {
 public:
  /// Collective. `points` as from points_on_line; `what` names them in messages. Throws InputError on all ranks for a
  /// point outside the mesh.
  Sampler(const Mesh& mesh, const Mpi& mpi, std::vector<Point> points, const std::string& what);

  const std::vector<Point>& points() const { return points_; }
  /// This rank's cells that hold points, one entry per point.
  std::span<const std::int32_t> cells() const { return cells_; }
  /// Collective. `values`: this rank's cells() rows of equal length; on rank 0 the rows of all points in their order.
  std::vector<double> in_order(const Mpi& mpi, std::span<const double> values) const;

 private:
  std::vector<Point> points_;
  std::vector<std::int32_t> cells_;
  std::vector<std::int64_t> point_of_row_;  ///< rank 0: rows as they come from the ranks
};

/// The state of some of the snapshot's cells.
Snapshot extract(const Snapshot& snapshot, std::span<const std::int32_t> cells);

}  // namespace cobasis
