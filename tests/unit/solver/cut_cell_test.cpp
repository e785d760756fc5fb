#include "solver/cut_cell.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

#include "sample_cells.hpp"

using namespace cobasis;

namespace {

constexpr double pi = std::numbers::pi;

const std::vector<std::pair<CellType, const char*>> plane_types{{CellType::triangle, "triangles"},
                                                                {CellType::quadrilateral, "quadrilaterals"}};
const std::vector<std::pair<CellType, const char*>> space_types{{CellType::tetrahedron, "tetrahedra"},
                                                                {CellType::hexahedron, "hexahedra"},
                                                                {CellType::prism, "prisms"},
                                                                {CellType::pyramid, "pyramids"}};

auto all_types() {
  auto all = plane_types;
  all.insert(all.end(), space_types.begin(), space_types.end());
  return all;
}

double volume_inside(const Shape& shape, const Mesh& mesh) {
  double sum = 0;
  for (int cell = 0; cell < mesh.n_owned; ++cell) {
    const double f = inside_fraction(shape, mesh, cell);
    CHECK((f >= 0 && f <= 1));
    sum += f * mesh.volume[cell];
  }
  return sum;
}

int cut_cells(const Shape& shape, const Mesh& mesh) {
  int n = 0;
  for (int cell = 0; cell < mesh.n_owned; ++cell) {
    const double f = inside_fraction(shape, mesh, cell);
    n += f != 0 && f != 1;
  }
  return n;
}

}  // namespace

TEST_CASE("the volume of an oblique half-space is exact on every cell type, warped faces included") {
  // The line at 30 degrees through the middle halves the square; in space so does any plane.
  const double angle = pi / 6;
  for (const auto& [type, name] : all_types()) {
    INFO(name);
    const Mesh mesh = sample_cells(type, 7, 0.2);
    const Point normal = mesh.dimension == 2 ? Point{std::cos(angle), std::sin(angle), 0} : Point{3, 2, 1};
    const Point middle{0.5, 0.5, mesh.dimension == 2 ? 0 : 0.5};
    CHECK(volume_inside(HalfSpace{middle, normal}, mesh) == Approx(0.5).epsilon(1e-13).margin(0));
    // A corner of known volume: x + y (+ z) < 0.7.
    const HalfSpace corner{{0.7, 0, 0}, {-1, -1, -1}};
    const double exact = mesh.dimension == 2 ? 0.7 * 0.7 / 2 : 0.7 * 0.7 * 0.7 / 6;
    CHECK(volume_inside(corner, mesh) == Approx(exact).epsilon(1e-13).margin(0));
    CHECK(cut_cells(corner, mesh) > 5);
  }
}

TEST_CASE("a half-space and its complement fill each cell") {
  for (const auto& [type, name] : all_types()) {
    INFO(name);
    const Mesh mesh = sample_cells(type, 5, 0.2);
    const Point point{0.43, 0.52, 0}, normal{1, 0.3, mesh.dimension == 2 ? 0 : -0.4};
    for (int cell = 0; cell < mesh.n_owned; ++cell) {
      const double f = inside_fraction(HalfSpace{point, normal}, mesh, cell);
      const double g = inside_fraction(HalfSpace{point, -1.0 * normal}, mesh, cell);
      CHECK(f + g == Approx(1).epsilon(1e-13));
    }
  }
}

TEST_CASE("the volume of a box is exact, also when it is smaller than a cell") {
  for (const auto& [type, name] : all_types()) {
    INFO(name);
    const Mesh mesh = sample_cells(type, 6, 0.2);
    const double depth = mesh.dimension == 2 ? 1 : 0.37;
    const Box box{{0.13, 0.21, 0.3}, {0.71, 0.83, 0.67}};
    CHECK(volume_inside(box, mesh) == Approx(0.58 * 0.62 * depth).epsilon(1e-12).margin(0));
    const double small_depth = mesh.dimension == 2 ? 1 : 0.02;
    const Box small{{0.54, 0.55, 0.56}, {0.56, 0.58, 0.58}};
    CHECK(volume_inside(small, mesh) == Approx(0.02 * 0.03 * small_depth).epsilon(1e-10).margin(0));
  }
}

TEST_CASE("a shape fitted to the mesh leaves every cell exactly full or empty") {
  for (const auto& [type, name] : all_types()) {
    INFO(name);
    const Mesh mesh = sample_cells(type, 10);
    CHECK(cut_cells(HalfSpace{{0.3, 0, 0}, {-2, 0, 0}}, mesh) == 0);
    CHECK(cut_cells(Box{{0.1, 0.3, 0.6}, {0.7, 0.9, 0.8}}, mesh) == 0);
    CHECK(volume_inside(HalfSpace{{0.3, 0, 0}, {-2, 0, 0}}, mesh) == Approx(0.3));
  }
}

TEST_CASE("the volume of a sphere or disc has a relative error below 1e-6") {
  for (const auto& [type, name] : all_types()) {
    for (const double radius : {0.4, 0.05}) {  // four cells per radius, half a cell
      INFO(name << " radius " << radius);
      const Mesh mesh = sample_cells(type, 10, 0.2);
      const double exact = mesh.dimension == 2 ? pi * radius * radius : 4 * pi / 3 * std::pow(radius, 3);
      const double error = volume_inside(Sphere{{0.47, 0.52, 0.49}, radius}, mesh) / exact - 1;
      CHECK(std::abs(error) < 1e-6);
    }
  }
}

TEST_CASE("the volume of an oblique finite cylinder has a relative error below 1e-6") {
  for (const auto& [type, name] : space_types) {
    INFO(name);
    const Mesh mesh = sample_cells(type, 8, 0.2);
    const Cylinder cylinder{{0.35, 0.3, 0.4}, {0.6, 0.7, 0.65}, 0.2};
    const Point axis = cylinder.to - cylinder.from;
    const double exact = pi * 0.04 * std::sqrt(dot(axis, axis));
    CHECK(std::abs(volume_inside(cylinder, mesh) / exact - 1) < 1e-6);
  }
}

TEST_CASE("a condition in x, y, z fills cut cells to about 1e-3") {
  const Inside ball{Expression("(x-0.47)^2 + (y-0.52)^2 + (z-0.49)^2 < 0.16")};
  const Inside disc{Expression("(x-0.47)^2 + (y-0.52)^2 < 0.16")};
  for (const auto& [type, name] : all_types()) {
    INFO(name);
    const Mesh mesh = sample_cells(type, 10, 0.2);
    const Shape condition = mesh.dimension == 2 ? disc : ball;
    const Shape exact = Sphere{{0.47, 0.52, 0.49}, 0.4};
    double worst = 0;
    for (int cell = 0; cell < mesh.n_owned; ++cell) {
      const double difference = inside_fraction(condition, mesh, cell) - inside_fraction(exact, mesh, cell);
      worst = std::max(worst, std::abs(difference));
    }
    CHECK(worst < 4e-3);
    CHECK(worst > 0);
  }
}

TEST_CASE("far from a shape's surface a cell is full or empty at the cost of one distance") {
  const Mesh mesh = sample_cells(CellType::hexahedron, 1);
  CHECK(inside_fraction(Everywhere{}, mesh, 0) == 1);
  CHECK(inside_fraction(Sphere{{0.5, 0.5, 0.5}, 100}, mesh, 0) == 1);
  CHECK(inside_fraction(Sphere{{200, 0.5, 0.5}, 100}, mesh, 0) == 0);
  CHECK(inside_fraction(HalfSpace{{1e6, 0, 0}, {-1, 0, 0}}, mesh, 0) == 1);
  CHECK(inside_fraction(Cylinder{{0.5, 0.5, -9}, {0.5, 0.5, -1}, 5}, mesh, 0) == 0);
}

TEST_CASE("a physical group takes its cells whole") {
  Mesh mesh = sample_cells(CellType::quadrilateral, 2);
  mesh.region_names = {"body", "rest"};
  mesh.cell_region = {0, 1, -1, 0};
  for (int cell = 0; cell < 4; ++cell) {
    CHECK(inside_fraction(PhysicalGroup{"body"}, mesh, cell) == (mesh.cell_region[cell] == 0 ? 1 : 0));
  }
}

TEST_CASE("a body far thinner than a cell is next to nothing, and costs next to nothing") {
  for (const CellType type :
       {CellType::triangle, CellType::quadrilateral, CellType::tetrahedron, CellType::hexahedron}) {
    const Mesh mesh = sample_cells(type, 2, 0.2);
    const double z = mesh.dimension == 2 ? 0 : 0.3;
    for (const double radius : {1e-9, 1e-30, 5e-324}) {
      CHECK(volume_inside(Sphere{{0.3, 0.3, z}, radius}, mesh) < 1e-9);
      if (mesh.dimension == 3) CHECK(volume_inside(Cylinder{{0.3, 0.3, z}, {0.8, 0.7, 0.6}, radius}, mesh) < 1e-9);
    }
  }
}

TEST_CASE("a sphere of a three-hundredth of a cell still has its volume") {
  const Mesh mesh = sample_cells(CellType::hexahedron, 1);
  const double radius = 1.0 / 300;
  CHECK(volume_inside(Sphere{{0.4, 0.45, 0.52}, radius}, mesh) ==
        Approx(4 * pi / 3 * radius * radius * radius).epsilon(1e-6).margin(0));
}
