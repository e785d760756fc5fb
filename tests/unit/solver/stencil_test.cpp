#include "solver/stencil.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "mesh/read_mesh.hpp"
#include "small_scene.hpp"

using namespace cobasis;

namespace {

/// A scalar and a vector: value + gradient · x.
struct LinearField {
  double value[4];
  Point gradient[4];

  double at(int v, const Point& x) const { return value[v] + dot(gradient[v], x); }
};

const LinearField any_field{{3, -1, 2, 0.5}, {{1, -2, 0.5}, {0.3, 1.1, -0.7}, {-0.8, 0.4, 1.9}, {0.2, -1.3, 0.6}}};
/// Unchanged by the mirror y = 0.
const LinearField mirrored_field{{3, -1, 0, 0.5}, {{1, 0, 0.5}, {0.3, 0, -0.7}, {0, 1.4, 0}, {0.2, 0, 0.6}}};

/// Gradients by the stencil: entries of faces are given the field beyond them, which mirrors make from the cell itself.
std::array<Point, 4> gradients(const Mesh& mesh, const Faces& faces, const Stencil& stencil, std::int32_t cell,
                               const LinearField& field) {
  std::array<Point, 4> sum{};
  double own[4];
  for (int v = 0; v < 4; ++v) own[v] = field.at(v, mesh.centroid[cell]);
  for (int j = 0; j < stencil.size; ++j) {
    const std::size_t at = static_cast<std::size_t>(j) * stencil.stride + cell;
    const std::int32_t entry = faces.cell_faces[at], face = entry >> 1, neighbour = stencil.cell[at];
    double beyond[4];
    for (int v = 0; v < 4; ++v) {
      beyond[v] = own[v];
      if (neighbour >= mesh.n_cells()) beyond[v] += dot(field.gradient[v], mesh.face_delta[face]);
      // beyond a periodic side the field goes on, as seen from here
      else if (neighbour != cell)
        beyond[v] += (entry & 1 ? -1 : 1) * dot(field.gradient[v], mesh.face_delta[face]);
    }
    const Point n{faces.nx[face], faces.ny[face], faces.nz[face]};
    const double turned = stencil.mirror[at] * (beyond[1] * n.x + beyond[2] * n.y + beyond[3] * n.z);
    beyond[1] -= turned * n.x, beyond[2] -= turned * n.y, beyond[3] -= turned * n.z;
    for (int v = 0; v < 4; ++v)
      sum[v] =
          sum[v] + (beyond[v] - own[v]) * Point{stencil.weight[0][at], stencil.weight[1][at], stencil.weight[2][at]};
  }
  return sum;
}

double largest_error(const Mesh& mesh, const std::vector<Boundary>& boundaries, const LinearField& field) {
  const Faces faces = make_faces(mesh);
  const Stencil stencil = make_stencil(mesh, faces, boundaries, PhaseCount::several, one_rank());
  double worst = 0;
  for (std::int32_t cell = 0; cell < mesh.n_owned; ++cell) {
    const auto found = gradients(mesh, faces, stencil, cell, field);
    for (int v = 0; v < 4; ++v) {
      Point error = found[v] - field.gradient[v];
      if (mesh.dimension == 2) error.z = 0;
      worst = std::max(worst, std::sqrt(dot(error, error)));
    }
  }
  return worst;
}

/// The same boundary for all groups but those with another.
std::vector<Boundary> boundaries_of(const Mesh& mesh, const Boundary& all,
                                    const std::map<std::string, Boundary>& others = {}) {
  std::vector<Boundary> boundaries;
  for (const BoundaryGroup& group : mesh.boundary_groups)
    boundaries.push_back(others.contains(group.name) ? others.at(group.name) : all);
  return boundaries;
}

struct MeshFile {
  const char* name;
  const char* file;
  std::map<std::string, double> parameters;
};
const std::vector<MeshFile> boxes = {{"triangles", "box.geo", {{"n", 12}, {"element", 3}}},
                                     {"quadrilaterals", "box.geo", {{"n", 9}, {"height", 0.7}}},
                                     {"tetrahedra", "box_space.geo", {{"n", 6}, {"element", 4}}},
                                     {"hexahedra", "box_space.geo", {{"n", 5}, {"width", 0.6}}},
                                     {"all types of cells", "box_space.geo", {{"n", 9}, {"element", 0}}}};

Mesh mesh_of(const MeshFile& box, std::vector<std::pair<std::string, std::string>> periodic = {},
             bool axisymmetric = false) {
  MeshRequest request;
  request.axisymmetric = axisymmetric;
  request.file = std::string(SOURCE_DIR "/meshes/") + box.file;
  request.parameters = box.parameters;
  request.periodic = std::move(periodic);
  return read_mesh(request, one_rank());
}

}  // namespace

TEST_CASE("gradients are exact for linear fields on any mesh") {
  for (const CellType type :
       {CellType::triangle, CellType::quadrilateral, CellType::tetrahedron, CellType::hexahedron}) {
    CAPTURE(shape_of(type).name);
    const Mesh warped = small_mesh(type, 6);
    CHECK(largest_error(warped, boundaries_of(warped, Inflow{}), any_field) < 1e-12);
  }
  for (const MeshFile& box : boxes) {
    CAPTURE(box.name);
    const Mesh mesh = mesh_of(box);
    CHECK(largest_error(mesh, boundaries_of(mesh, Inflow{}), any_field) < 1e-12);
  }
}

TEST_CASE("gradients are exact across periodic sides") {
  for (const MeshFile& box : boxes) {
    if (box.parameters.contains("element") && std::string(box.file) == "box_space.geo") continue;
    CAPTURE(box.name);
    const Mesh mesh = mesh_of(box, {{"left", "right"}, {"bottom", "top"}});
    CHECK(largest_error(mesh, boundaries_of(mesh, Inflow{}), any_field) < 1e-12);
  }
}

TEST_CASE("gradients at a wall are exact for linear fields that the wall mirrors into themselves") {
  for (const MeshFile& box : boxes) {
    CAPTURE(box.name);
    const Mesh mesh = mesh_of(box);
    for (const Boundary& mirror : {Boundary(Wall{}), Boundary(Symmetry{})})
      CHECK(largest_error(mesh, boundaries_of(mesh, Inflow{}, {{"bottom", mirror}}), mirrored_field) < 1e-12);
    CHECK(largest_error(mesh, boundaries_of(mesh, Inflow{}, {{"bottom", Wall{}}}), any_field) > 0.1);
  }
}

TEST_CASE("gradients of an axisymmetric scene are exact for linear fields, also at its axis") {
  for (const MeshFile& box : boxes) {
    if (std::string(box.file) != "box.geo") continue;
    CAPTURE(box.name);
    const Mesh mesh = mesh_of(box, {}, true);
    CHECK(largest_error(mesh, boundaries_of(mesh, Inflow{}), any_field) < 1e-12);
    CHECK(largest_error(mesh, boundaries_of(mesh, Inflow{}, {{"bottom", AxisOfSymmetry{}}}), mirrored_field) < 1e-12);
  }
}

TEST_CASE("a neighbour in the stencil is the cell beyond the face, and the way to the face leads to its centroid") {
  for (const MeshFile& box : boxes) {
    CAPTURE(box.name);
    const Mesh mesh = mesh_of(box);
    const Faces faces = make_faces(mesh);
    const Stencil stencil =
        make_stencil(mesh, faces, boundaries_of(mesh, Transmissive{}), PhaseCount::several, one_rank());
    double away = 0, unclosed = 0;
    for (std::int32_t cell = 0; cell < mesh.n_owned; ++cell) {
      double flux_of_x = 0;  // the divergence of x is the dimension
      for (int j = 0; j < mesh.max_cell_faces; ++j) {
        const std::size_t at = static_cast<std::size_t>(j) * stencil.stride + cell;
        const std::int32_t entry = mesh.cell_faces[static_cast<std::size_t>(j) * mesh.cell_stride + cell];
        if (entry < 0) continue;
        const std::int32_t face = entry >> 1, other = entry & 1 ? mesh.left[face] : mesh.right[face];
        CHECK(stencil.cell[at] == (other < mesh.n_owned ? other : cell));
        const Point way{stencil.to_face[0][at], stencil.to_face[1][at], stencil.to_face[2][at]};
        const Point off = mesh.centroid[cell] + way - mesh.face_centroid[face];
        away = std::max(away, std::sqrt(dot(off, off)));
        flux_of_x +=
            (entry & 1 ? -1 : 1) * mesh.area[face] * dot(way, Point{mesh.nx[face], mesh.ny[face], mesh.nz[face]});
      }
      unclosed = std::max(unclosed, std::fabs(flux_of_x / (mesh.dimension * mesh.volume[cell]) - 1));
    }
    CHECK(away < 1e-14);
    CHECK(unclosed < 1e-11);
  }
}

TEST_CASE("gradients are averaged over neighbours only where cells have few faces") {
  for (const MeshFile& box : boxes) {
    CAPTURE(box.name);
    const Mesh mesh = mesh_of(box);
    const Stencil stencil =
        make_stencil(mesh, make_faces(mesh), boundaries_of(mesh, Transmissive{}), PhaseCount::several, one_rank());
    bool averages = false;
    for (std::int32_t cell = 0; cell < mesh.n_owned; ++cell) {
      double sum = 0;
      for (int j = 0; j < stencil.size; ++j) {
        const std::size_t at = static_cast<std::size_t>(j) * stencil.stride + cell;
        CHECK(stencil.average[at] >= 0);
        if (stencil.average[at] > 0) CHECK(stencil.cell[at] != cell);
        sum += stencil.average[at];
      }
      CHECK(sum <= 1 + 1e-15);
      const CellType type = mesh.cell_type[cell];
      if (type == CellType::quadrilateral || type == CellType::hexahedron)
        CHECK(sum == 0);
      else
        CHECK(sum > 0.3);
      averages = averages || sum > 0;
    }
    CHECK(stencil.averages == averages);
  }
}
