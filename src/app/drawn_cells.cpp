#include "app/drawn_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "mesh/cell_shape.hpp"
#include "mesh/geometry.hpp"

namespace cobasis {
namespace {

bool same(const Point& a, const Point& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

/// Where the plane crosses the edges of a cell, each point once. `height`: of every node above it.
std::vector<Point> crossings(const Mesh& mesh, std::int32_t cell, std::span<const double> height) {
  const std::int32_t* const nodes = &mesh.cell_nodes[mesh.cell_node_begin[cell]];
  const CellShape& shape = shape_of(mesh.cell_type[cell]);
  std::array<double, 8> z{};
  for (int i = 0; i < shape.n_corners; ++i) z[i] = height[nodes[i]];
  const auto [low, high] = std::minmax_element(z.begin(), z.begin() + shape.n_corners);
  const double round_off = 1e-8 * (*high - *low);  // of coordinates: a plane along faces finds their corners on it
  for (double& x : z)
    if (std::fabs(x) < round_off) x = 0;
  std::vector<Point> found;
  for (int f = 0; f < shape.n_faces; ++f) {
    const FaceCorners& face = shape.faces[f];
    for (int i = 0; i < (shape.dimension == 2 ? 1 : face.size); ++i) {
      int a = face.corner[i], b = face.corner[(i + 1) % face.size];
      if ((z[a] < 0) == (z[b] < 0)) continue;
      if (z[b] < 0) std::swap(a, b);  // from below, so that all cells of an edge find the same bits
      const double t = z[a] / (z[a] - z[b]);
      const Point &below = mesh.nodes[nodes[a]], &above = mesh.nodes[nodes[b]];
      const Point x = z[b] == 0 ? above : (1 - t) * below + t * above;
      if (std::ranges::none_of(found, [&](const Point& y) { return same(x, y); })) found.push_back(x);
    }
  }
  return found;
}

/// Around their centre, counter-clockwise seen from where the normal points to.
void sort_around(std::vector<Point>& points, const Point& normal) {
  Point centre;
  for (const Point& x : points) centre = centre + (1.0 / static_cast<double>(points.size())) * x;
  const Point first = points[0] - centre, second = cross(normal, first);
  std::vector<std::pair<double, Point>> by_angle;
  for (const Point& x : points)
    by_angle.emplace_back(std::atan2(dot(x - centre, second) / length(normal), dot(x - centre, first)), x);
  std::ranges::stable_sort(by_angle, {}, [](const auto& entry) { return entry.first; });
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = by_angle[i].second;
}

}  // namespace

DrawnCells draw(const Mesh& mesh, std::span<const std::int32_t> cells) {
  DrawnCells drawn;
  std::vector<std::int32_t> point_of_node(mesh.nodes.size(), -1);  // nodes of other cells are not drawn
  for (const std::int32_t cell : cells) {
    for (std::int32_t j = mesh.cell_node_begin[cell]; j < mesh.cell_node_begin[cell + 1]; ++j) {
      std::int32_t& point = point_of_node[mesh.cell_nodes[j]];
      if (point < 0) {
        point = static_cast<std::int32_t>(drawn.points.size());
        drawn.points.push_back(mesh.nodes[mesh.cell_nodes[j]]);
      }
      drawn.corners.push_back(point);
    }
    drawn.begin.push_back(static_cast<std::int32_t>(drawn.corners.size()));
    drawn.cell.push_back(cell);
    drawn.type.push_back(mesh.cell_type[cell]);
  }
  return drawn;
}

DrawnCells draw(const Mesh& mesh) {
  std::vector<std::int32_t> all(static_cast<std::size_t>(mesh.n_owned));
  std::iota(all.begin(), all.end(), 0);
  return draw(mesh, all);
}

DrawnCells draw_cut(const Mesh& mesh, const Point& point, const Point& normal) {
  std::vector<double> height;
  for (const Point& x : mesh.nodes) height.push_back(dot(x - point, normal));
  DrawnCells drawn;
  for (std::int32_t cell = 0; cell < mesh.n_owned; ++cell) {
    std::vector<Point> corners = crossings(mesh, cell, height);
    if (corners.size() < static_cast<std::size_t>(mesh.dimension)) continue;  // the plane touches a corner or an edge
    if (mesh.dimension == 3) sort_around(corners, normal);
    for (const Point& x : corners) {
      drawn.corners.push_back(static_cast<std::int32_t>(drawn.points.size()));
      drawn.points.push_back(x);
    }
    drawn.begin.push_back(static_cast<std::int32_t>(drawn.corners.size()));
    drawn.cell.push_back(cell);
  }
  return drawn;
}

}  // namespace cobasis
