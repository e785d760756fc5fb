// What a VTU file shows of a rank's mesh: all of its cells, some of them, or where a plane cuts them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.hpp"

namespace cobasis {

/// Cells as they lie in a file. `corners` are points in Gmsh's (= VTK's) order; what a plane cuts is a line or a
/// polygon.
struct DrawnCells {
  std::vector<Point> points;
  std::vector<std::int32_t> begin{0};  ///< of the corners of each cell, and their number
  std::vector<std::int32_t> corners;
  std::vector<std::int32_t> cell;  ///< the mesh's, whose values each shows
  std::vector<CellType> type;      ///< empty: cut by a plane
};

DrawnCells draw(const Mesh& mesh, std::span<const std::int32_t> cells);
DrawnCells draw(const Mesh& mesh);  ///< all owned cells

/// The owned cells cut by the plane: each with a corner below and one on or above it, so that a plane along faces shows
/// one layer of cells, and the same one for any number of ranks.
DrawnCells draw_cut(const Mesh& mesh, const Point& point, const Point& normal);

}  // namespace cobasis
