#include "app/drawn_cells.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "mesh/geometry.hpp"
#include "output_scene.hpp"

namespace cobasis::test {
namespace {

/// Two unit cubes along x, then a tetrahedron, a prism and a pyramid beside them.
Mesh bodies() {
  Mesh mesh;
  mesh.dimension = 3;
  mesh.cell_node_begin = {0};
  const auto add = [&](CellType type, const std::vector<Point>& corners) {
    mesh.cell_type.push_back(type);
    for (const Point& x : corners) {
      mesh.cell_nodes.push_back(static_cast<std::int32_t>(mesh.nodes.size()));
      mesh.nodes.push_back(x);
    }
    mesh.cell_node_begin.push_back(static_cast<std::int32_t>(mesh.cell_nodes.size()));
    ++mesh.n_owned;
  };
  for (const double x : {0.0, 1.0})
    add(CellType::hexahedron,
        {{x, 0, 0}, {x + 1, 0, 0}, {x + 1, 1, 0}, {x, 1, 0}, {x, 0, 1}, {x + 1, 0, 1}, {x + 1, 1, 1}, {x, 1, 1}});
  add(CellType::tetrahedron, {{3, 0, 0}, {4, 0, 0}, {3, 1, 0}, {3, 0, 1}});
  add(CellType::prism, {{5, 0, 0}, {6, 0, 0}, {5, 1, 0}, {5, 0, 1}, {6, 0, 1}, {5, 1, 1}});
  add(CellType::pyramid, {{7, 0, 0}, {8, 0, 0}, {8, 1, 0}, {7, 1, 0}, {7, 0, 1}});
  return mesh;
}

/// Of a cell that a plane cut, by its corners in order.
Point area_vector(const DrawnCells& drawn, std::size_t i) {
  Point sum;
  const Point& first = drawn.points[drawn.corners[drawn.begin[i]]];
  for (std::int32_t j = drawn.begin[i] + 1; j + 1 < drawn.begin[i + 1]; ++j)
    sum = sum + 0.5 * cross(drawn.points[drawn.corners[j]] - first, drawn.points[drawn.corners[j + 1]] - first);
  return sum;
}

TEST_CASE("a plane cuts every type of cell in a polygon of the right area, seen from where the normal points to") {
  const Mesh mesh = bodies();
  const DrawnCells drawn = draw_cut(mesh, {0, 0, 0.25}, {0, 0, 3});
  REQUIRE(drawn.cell == std::vector<std::int32_t>{0, 1, 2, 3, 4});
  const double areas[] = {1, 1, 0.5 * 0.75 * 0.75, 0.5, 0.75 * 0.75};
  for (std::size_t i = 0; i < 5; ++i) {
    CAPTURE(i);
    const Point area = area_vector(drawn, i);
    CHECK(area.z == Approx(areas[i]).epsilon(1e-14));
    CHECK(std::hypot(area.x, area.y) < 1e-15);
    for (std::int32_t j = drawn.begin[i]; j < drawn.begin[i + 1]; ++j)
      CHECK(drawn.points[drawn.corners[j]].z == Approx(0.25).epsilon(1e-15));
  }
  const DrawnCells oblique = draw_cut(mesh, {0.5, 0.5, 0.5}, {1, 1, 1});
  REQUIRE(oblique.cell.front() == 0);
  CHECK(oblique.begin[1] == 6);  // a regular hexagon
  CHECK(length(area_vector(oblique, 0)) == Approx(3 * std::sqrt(3.0) / 4).epsilon(1e-14));
}

TEST_CASE("a plane along faces shows the layer below it, and of cells that it only touches none") {
  const Mesh mesh = bodies();
  CHECK(draw_cut(mesh, {1, 0, 0}, {1, 0, 0}).cell == std::vector<std::int32_t>{0});
  CHECK(draw_cut(mesh, {1, 0, 0}, {-1, 0, 0}).cell == std::vector<std::int32_t>{1});
  CHECK(draw_cut(mesh, {0, 0, 1}, {0, 0, 1}).cell == std::vector<std::int32_t>{0, 1, 3});
  CHECK(draw_cut(mesh, {0, 0, 2}, {0, 0, 1}).cell.empty());
  CHECK(draw_cut(mesh, {2, 1, 1}, {1, 1, 1}).cell == std::vector<std::int32_t>{2});  // its face; the cube's corner
}

TEST_CASE("a plane along faces whose corners are off it by round-off shows one layer all the same") {
  Mesh mesh = squares(8, 4, 0.125);
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) mesh.nodes[i].y += (static_cast<int>(i % 3) - 1) * 1e-16;
  CHECK(draw_cut(mesh, {0, 0.25, 0}, {0, 1, 0}).cell == std::vector<std::int32_t>{8, 9, 10, 11, 12, 13, 14, 15});
}

TEST_CASE("in a plane a slice is lines from face to face") {
  const Mesh mesh = squares(4, 2, 0.5);
  const DrawnCells drawn = draw_cut(mesh, {0, 0.75, 0}, {0, 1, 0});
  REQUIRE(drawn.cell == std::vector<std::int32_t>{4, 5, 6, 7});
  for (std::size_t i = 0; i < 4; ++i) {
    REQUIRE(drawn.begin[i + 1] - drawn.begin[i] == 2);
    const Point a = drawn.points[drawn.corners[drawn.begin[i]]], b = drawn.points[drawn.corners[drawn.begin[i] + 1]];
    CHECK(length(a - b) == 0.5);
    CHECK(0.5 * (a.x + b.x) == mesh.centroid[drawn.cell[i]].x);
  }
}

TEST_CASE("some cells are drawn with their own nodes alone") {
  const DrawnCells drawn = draw(squares(4, 2, 0.5), std::vector<std::int32_t>{1, 2});
  CHECK(drawn.points.size() == 6);
  CHECK(drawn.cell == std::vector<std::int32_t>{1, 2});
  CHECK(drawn.corners.size() == 8);
}

}  // namespace
}  // namespace cobasis::test
