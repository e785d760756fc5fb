#include "mesh/global_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <tuple>

#include "math/errors.hpp"
#include "mesh/cell_shape.hpp"
#include "mesh/geometry.hpp"
#include "mesh/gmsh_reader.hpp"
#include "mesh/hanging_faces.hpp"
#include "mesh/ordering.hpp"
#include "mesh/periodic.hpp"
#include "mesh/topology.hpp"

namespace cobasis {
namespace {

std::vector<Point> corners_of(const RawMesh& raw, std::int32_t cell) {
  std::vector<Point> corners;
  for (std::int32_t i = raw.cell_node_begin[cell]; i < raw.cell_node_begin[cell + 1]; ++i)
    corners.push_back(raw.nodes[raw.cell_nodes[i]]);
  return corners;
}

double diameter(const std::vector<Point>& corners) {
  double largest = 0;
  for (const Point& a : corners)
    for (const Point& b : corners) largest = std::max(largest, length(a - b));
  return largest;
}

void flatten(RawMesh& raw) {
  double extent = 0;
  for (const Point& p : raw.nodes) extent = std::max({extent, std::abs(p.x), std::abs(p.y)});
  for (Point& p : raw.nodes) {
    if (std::abs(p.z) > 1e-10 * extent)
      throw InputError(fmt::format("a two-dimensional mesh lies in z = 0, but a node is at ({:.6g}, {:.6g}, {:.6g})",
                                   p.x, p.y, p.z));
    p.z = 0;
  }
}

/// The upper half of a meridian plane; nodes on the axis are put exactly there.
void put_on_axis(RawMesh& raw) {
  double extent = 0;
  for (const Point& p : raw.nodes) extent = std::max({extent, std::abs(p.x), std::abs(p.y)});
  for (Point& p : raw.nodes) {
    if (p.y < -1e-10 * extent)
      throw InputError(
          fmt::format("the mesh of an axisymmetric scene lies at y >= 0, the distance from the axis, but a "
                      "node is at ({:.6g}, {:.6g})",
                      p.x, p.y));
    if (p.y < 1e-10 * extent) p.y = 0;
  }
}

/// Volume and centroid of every cell; turns plane cells counter-clockwise.
void measure(RawMesh& raw, std::vector<double>& volume, std::vector<Point>& centroid) {
  volume.clear();
  centroid.clear();
  for (std::int32_t cell = 0; cell < raw.n_cells(); ++cell) {
    std::vector<Point> corners = corners_of(raw, cell);
    CellGeometry geometry = cell_geometry(raw.cell_type[cell], corners);
    if (raw.dimension == 2 && geometry.volume < 0) {
      std::reverse(raw.cell_nodes.begin() + raw.cell_node_begin[cell] + 1,
                   raw.cell_nodes.begin() + raw.cell_node_begin[cell + 1]);
      corners = corners_of(raw, cell);
      geometry = cell_geometry(raw.cell_type[cell], corners);
    }
    const double smallest = 1e-15 * std::pow(diameter(corners), raw.dimension);
    if (!(geometry.volume > smallest))
      throw InputError(fmt::format("element {} ({}) at ({:.6g}, {:.6g}, {:.6g}) has {} {}", raw.cell_tag[cell],
                                   shape_of(raw.cell_type[cell]).name, corners[0].x, corners[0].y, corners[0].z,
                                   geometry.volume < -smallest ? "a negative" : "no",
                                   raw.dimension == 2 ? "area" : "volume"));
    volume.push_back(geometry.volume);
    centroid.push_back(geometry.centroid);
  }
}

/// Boundary groups become those that have boundary faces left; faces are sorted and counted.
void settle(GlobalMesh& mesh) {
  std::set<std::int32_t> groups;
  for (const FaceLink& face : mesh.faces)
    if (face.right < 0) groups.insert(face.group);
  std::vector<std::int32_t> number(mesh.raw.group_names.size(), -1);
  for (const std::int32_t group : groups) {
    number[group] = static_cast<std::int32_t>(mesh.boundary_names.size());
    mesh.boundary_names.push_back(mesh.raw.group_names[group]);
  }
  for (FaceLink& face : mesh.faces)
    if (face.right < 0) face.group = number[face.group];
  std::sort(mesh.faces.begin(), mesh.faces.end(), [](const FaceLink& a, const FaceLink& b) {
    return std::tie(a.group, a.left, a.right, a.left_local) < std::tie(b.group, b.left, b.right, b.left_local);
  });
  mesh.n_inner_faces =
      std::partition_point(mesh.faces.begin(), mesh.faces.end(), [](const FaceLink& face) { return face.right >= 0; }) -
      mesh.faces.begin();
}

void measure_faces(GlobalMesh& mesh) {
  for (const FaceLink& face : mesh.faces) {
    std::array<std::int32_t, 4> nodes{};
    std::array<Point, 4> corners;
    const int n = face_nodes(mesh.raw, face.left, face.left_local, nodes.data());
    double longest = 0;
    for (int i = 0; i < n; ++i) corners[i] = mesh.raw.nodes[nodes[i]];
    for (int i = 0; i < n; ++i) longest = std::max(longest, length(corners[(i + 1) % n] - corners[i]));
    const FaceGeometry geometry = face_geometry({corners.data(), static_cast<std::size_t>(n)});
    if (!(length(geometry.area) > 1e-15 * std::pow(longest, mesh.raw.dimension - 1)))
      throw InputError(fmt::format("a face of element {} at ({:.6g}, {:.6g}, {:.6g}) has no area",
                                   mesh.raw.cell_tag[face.left], corners[0].x, corners[0].y, corners[0].z));
    mesh.face_area.push_back(geometry.area);
    mesh.face_centroid.push_back(geometry.centroid);
  }
}

void check_shifts(const GlobalMesh& mesh, const std::vector<std::pair<std::string, std::string>>& periodic) {
  for (std::size_t i = 0; i < mesh.shifts.size(); ++i)
    if (std::abs(mesh.shifts[i].y) > 1e-10 * std::abs(mesh.shifts[i].x))
      throw InputError(
          fmt::format("periodic groups '{}' and '{}' lie at different distances from the axis; allowed in "
                      "an axisymmetric scene: a translation along x",
                      periodic[i].first, periodic[i].second));
}

/// From plane cells and faces to the rings that they sweep.
void turn_about_axis(GlobalMesh& mesh) {
  mesh.section = mesh.volume;
  mesh.section_centroid = mesh.centroid;
  for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell) {
    const std::vector<Point> corners = corners_of(mesh.raw, cell);
    const RingGeometry ring = ring_of_cell({mesh.volume[cell], mesh.centroid[cell]}, corners);
    if (!(ring.circumference > 0))  // two sides that cross may put the centroid anywhere
      throw InputError(fmt::format("element {} ({}) at ({:.6g}, {:.6g}) has no volume around the axis",
                                   mesh.raw.cell_tag[cell], shape_of(mesh.raw.cell_type[cell]).name, corners[0].x,
                                   corners[0].y));
    mesh.volume[cell] *= ring.circumference;
    mesh.centroid[cell] = ring.centroid;
  }
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    std::array<std::int32_t, 4> nodes{};
    face_nodes(mesh.raw, mesh.faces[f].left, mesh.faces[f].left_local, nodes.data());
    const std::array<Point, 2> ends{mesh.raw.nodes[nodes[0]], mesh.raw.nodes[nodes[1]]};
    const RingGeometry ring = ring_of_face(ends);
    mesh.face_circumference.push_back(ring.circumference);
    mesh.face_centroid[f] = ring.centroid;
  }
}

void list_faces_of_cells(GlobalMesh& mesh) {
  mesh.cell_face_begin.assign(1, 0);
  for (const CellType type : mesh.raw.cell_type)
    mesh.cell_face_begin.push_back(mesh.cell_face_begin.back() + shape_of(type).n_faces);
  mesh.cell_faces.resize(mesh.cell_face_begin.back());
  for (std::int64_t f = 0; f < std::ssize(mesh.faces); ++f) {
    const FaceLink& face = mesh.faces[f];
    mesh.cell_faces[mesh.cell_face_begin[face.left] + face.left_local] = 2 * f;
    if (face.right >= 0) mesh.cell_faces[mesh.cell_face_begin[face.right] + face.right_local] = 2 * f + 1;
  }
}

}  // namespace

std::span<const std::int32_t> GlobalMesh::nodes_of(std::int32_t cell) const {
  return std::span(raw.cell_nodes)
      .subspan(raw.cell_node_begin[cell], raw.cell_node_begin[cell + 1] - raw.cell_node_begin[cell]);
}

Point GlobalMesh::delta(std::int64_t face) const {
  const FaceLink& link = faces[face];
  if (link.right < 0) {
    const Point n = face_frame(face_area[face]).n;
    return 2 * dot(face_centroid[face] - centroid[link.left], n) * n;
  }
  const Point direct = centroid[link.right] - centroid[link.left];
  if (link.image == 0) return direct;
  return link.image > 0 ? direct + shifts[link.image - 1] : direct - shifts[-link.image - 1];
}

GlobalMesh build_global_mesh(RawMesh raw, const std::vector<std::pair<std::string, std::string>>& periodic,
                             bool axisymmetric) {
  GlobalMesh mesh;
  mesh.axisymmetric = axisymmetric;
  if (raw.dimension == 2) flatten(raw);
  if (axisymmetric) put_on_axis(raw);
  measure(raw, mesh.volume, mesh.centroid);
  mesh.raw = renumber(raw, morton_order(mesh.centroid, raw.dimension));
  raw = {};

  std::vector<FaceLink> faces = connect(mesh.raw);
  check_all_grouped(mesh.raw, faces);
  PeriodicFaces joined = join_periodic(mesh.raw, std::move(faces), periodic);
  mesh.faces = std::move(joined.faces);
  mesh.shifts = std::move(joined.shifts);
  settle(mesh);
  if (axisymmetric) {
    check_shifts(mesh, periodic);
    put_on_axis(mesh.raw);
  }
  measure(mesh.raw, mesh.volume, mesh.centroid);  // in the new order, periodic nodes moved
  measure_faces(mesh);
  if (axisymmetric) turn_about_axis(mesh);
  list_faces_of_cells(mesh);
  return mesh;
}

GlobalMesh read_global_mesh(const MeshRequest& request) {
  RawMesh raw = read_gmsh(request);
  try {
    return build_global_mesh(std::move(raw), request.periodic, request.axisymmetric);
  } catch (const InputError& error) {
    throw InputError(request.file + ": " + error.what());
  }
}

}  // namespace cobasis
