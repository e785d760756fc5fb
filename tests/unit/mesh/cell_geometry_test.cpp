#include <numeric>
#include <set>

#include "mesh/geometry.hpp"
#include "mesh_files.hpp"
#include "mixed_mesh.hpp"

using namespace cobasis;

namespace {

const std::vector<std::pair<CellType, double>> unit_cells = {
    {CellType::triangle, 0.5},   {CellType::quadrilateral, 1.0}, {CellType::tetrahedron, 1.0 / 6},
    {CellType::hexahedron, 1.0}, {CellType::prism, 0.5},         {CellType::pyramid, 1.0 / 3},
};

std::vector<Point> unit_corners(CellType type) {
  const Point a{0, 0, 0}, b{1, 0, 0}, c{1, 1, 0}, d{0, 1, 0}, e{0, 0, 1}, f{1, 0, 1}, g{1, 1, 1}, h{0, 1, 1};
  switch (type) {
    case CellType::triangle:
      return {a, b, d};
    case CellType::quadrilateral:
      return {a, b, c, d};
    case CellType::tetrahedron:
      return {a, b, d, e};
    case CellType::hexahedron:
      return {a, b, c, d, e, f, g, h};
    case CellType::prism:
      return {a, b, d, e, f, h};
    case CellType::pyramid:
      return {a, b, c, d, e};
  }
  return {};
}

/// Moves every corner by a different small amount: quadrilaterals of space cells are no longer plane.
std::vector<Point> distorted(std::vector<Point> corners, int dimension) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double s = 0.1 * std::sin(3.0 * static_cast<double>(i) + 1), t = 0.1 * std::cos(5.0 * static_cast<double>(i));
    corners[i] = corners[i] + Point{s, t, dimension == 3 ? s * t + 0.5 * t : 0};
  }
  return corners;
}

Point sum_of_areas(CellType type, const std::vector<Point>& corners) {
  Point sum;
  for (int f = 0; f < shape_of(type).n_faces; ++f) {
    const FaceCorners& face = shape_of(type).faces[f];
    std::vector<Point> points;
    for (int i = 0; i < face.size; ++i) points.push_back(corners[face.corner[i]]);
    sum = sum + face_geometry(points).area;
  }
  return sum;
}

}  // namespace

TEST_CASE("every type of cell has the textbook volume") {
  for (const auto& [type, volume] : unit_cells) {
    INFO(shape_of(type).name);
    CHECK(cell_geometry(type, unit_corners(type)).volume == Approx(volume).epsilon(1e-15));
  }
}

TEST_CASE("every type of cell is closed, distorted too") {
  for (const auto& [type, volume] : unit_cells) {
    INFO(shape_of(type).name);
    const std::vector<Point> corners = unit_corners(type);
    CHECK(length(sum_of_areas(type, corners)) < 1e-16);
    CHECK(length(sum_of_areas(type, distorted(corners, shape_of(type).dimension))) < 1e-15);
  }
}

TEST_CASE("volume and centroid move with the cell, also far from the origin") {
  for (const auto& [type, volume] : unit_cells) {
    INFO(shape_of(type).name);
    const std::vector<Point> corners = distorted(unit_corners(type), shape_of(type).dimension);
    const Point shift{1024, -2048, shape_of(type).dimension == 3 ? 512.0 : 0.0};
    std::vector<Point> moved = corners;
    for (Point& p : moved) p = p + shift;
    const CellGeometry here = cell_geometry(type, corners), there = cell_geometry(type, moved);
    CHECK(there.volume == Approx(here.volume).epsilon(1e-11));  // corners round to 2^-42 there
    CHECK(length(there.centroid - here.centroid - shift) < 1e-11);
  }
}

TEST_CASE("centroids of a pyramid and of a trapezoid are those of calculus") {
  const Point p = cell_geometry(CellType::pyramid, unit_corners(CellType::pyramid)).centroid;
  CHECK(length(p - Point{0.375, 0.375, 0.25}) < 1e-15);
  const std::vector<Point> trapezoid{{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const Point q = cell_geometry(CellType::quadrilateral, trapezoid).centroid;
  CHECK(length(q - Point{7.0 / 9, 4.0 / 9, 0}) < 1e-15);
  CHECK(length(face_geometry(trapezoid).centroid - Point{7.0 / 9, 4.0 / 9, 0}) < 1e-15);
}

TEST_CASE("frames are orthonormal and turn over with their normal") {
  for (const Point& area : {Point{1, 2, 3}, Point{0, 0, 2}, Point{0, 0, -2}, Point{-1, 0, 0}, Point{0.1, 0.2, 9}}) {
    const FaceFrame frame = face_frame(area), back = face_frame(-1.0 * area);
    CHECK(dot(frame.n, frame.n) == Approx(1).epsilon(1e-15));
    CHECK(dot(frame.t1, frame.t1) == Approx(1).epsilon(1e-15));
    CHECK(std::abs(dot(frame.n, frame.t1)) < 1e-16);
    CHECK(length(frame.t1 + back.t1) == 0);
  }
}

TEST_CASE("tangents in a plane are the normals turned by a right angle, exactly") {
  const Mesh mesh = read_text("a.geo", strip_geo(5, 3, false));
  REQUIRE(mesh.n_faces() > 0);
  for (std::int32_t f = 0; f < mesh.n_faces(); ++f) {
    CHECK(mesh.tx[f] == -mesh.ny[f]);
    CHECK(mesh.ty[f] == mesh.nx[f]);
    CHECK(mesh.tz[f] == 0);
    CHECK(mesh.nz[f] == 0);
  }
}

TEST_CASE("all types of cells, with warped faces between them, fill their box") {
  const Mesh mesh = read_text("mixed.msh", mixed_mesh(0.2).text());
  REQUIRE(mesh.n_owned == 11);
  CHECK(total_volume(mesh) == Approx(3).epsilon(1e-13));
  CHECK(worst_gap(mesh) < 1e-15);
  CHECK(mesh.n_interior_faces == 17);
  std::set<CellType> types(mesh.cell_type.begin(), mesh.cell_type.end());
  CHECK(types.size() == 4);
}

TEST_CASE("faces point from the smaller to the larger number and away from the left cell") {
  const Mesh mesh = read_text("mixed.msh", mixed_mesh(0.1).text());
  for (std::int32_t f = 0; f < mesh.n_faces(); ++f) {
    const Point n{mesh.nx[f], mesh.ny[f], mesh.nz[f]};
    CHECK(dot(n, mesh.face_centroid[f] - mesh.centroid[mesh.left[f]]) > 0);
    CHECK(dot(n, mesh.face_delta[f]) > 0);
    if (f < mesh.n_interior_faces) {
      CHECK(mesh.left[f] < mesh.right[f]);
      const Point direct = mesh.centroid[mesh.right[f]] - mesh.centroid[mesh.left[f]];
      CHECK(length(mesh.face_delta[f] - direct) == 0);
    } else {
      CHECK(mesh.right[f] == mesh.ghost_of(f));
    }
  }
}

TEST_CASE("each face is listed once by each of its cells") {
  const Mesh mesh = read_text("mixed.msh", mixed_mesh(0.1).text());
  std::vector<int> seen(2 * mesh.n_faces(), 0);
  CHECK(mesh.cell_stride % 16 == 0);
  for (std::int32_t j = 0; j < mesh.max_cell_faces; ++j)
    for (std::int32_t i = 0; i < mesh.cell_stride; ++i) {
      const std::int32_t entry = mesh.cell_faces[j * mesh.cell_stride + i];
      const bool exists = i < mesh.n_owned && j < shape_of(mesh.cell_type[i]).n_faces;
      CHECK((entry >= 0) == exists);
      if (entry >= 0) ++seen[entry];
    }
  for (std::int32_t f = 0; f < mesh.n_faces(); ++f) {
    CHECK(seen[2 * f] == 1);
    CHECK(seen[2 * f + 1] == (f < mesh.n_interior_faces ? 1 : 0));
  }
}

TEST_CASE("a tetrahedral mesh of the unit cube has its volume and surface") {
  const Mesh mesh = read_text("a.geo", tetrahedra_geo(0.25));
  REQUIRE(mesh.n_owned > 100);
  CHECK(total_volume(mesh) == Approx(1).epsilon(1e-13));
  CHECK(worst_gap(mesh) < 1e-15);
  REQUIRE(mesh.boundary_groups.size() == 1);
  CHECK(std::accumulate(mesh.area.begin() + mesh.first_boundary_face(), mesh.area.end(), 0.0) ==
        Approx(6).epsilon(1e-13));
}
