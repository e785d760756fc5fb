// Axisymmetric meshes: what a meridian section sweeps around the x axis.
#include <cmath>
#include <numbers>
#include <numeric>

#include "mesh/geometry.hpp"
#include "mesh_files.hpp"

using namespace cobasis;
using Catch::Contains;

namespace {

constexpr double pi = std::numbers::pi;

MeshRequest request_of(const std::string& file, std::vector<std::pair<std::string, std::string>> periodic = {}) {
  MeshRequest request;
  request.file = file;
  request.axisymmetric = true;
  request.periodic = std::move(periodic);
  return request;
}

/// x and y in [0, 1], oblique triangles or quadrilaterals.
Mesh cylinder(int element) {
  MeshRequest request = request_of(SOURCE_DIR "/meshes/box.geo");
  request.parameters = {{"n", 12.0}, {"element", static_cast<double>(element)}};
  return read_mesh(request, test_mpi());
}

}  // namespace

TEST_CASE("ring-shaped cells and faces of a cylinder have its volume, surface and moments") {
  const int element = GENERATE(3, 4);
  CAPTURE(element);
  const Mesh mesh = cylinder(element);
  CHECK(mesh.axisymmetric);
  CHECK(total_volume(mesh) == Approx(pi).epsilon(1e-13));
  Point moment;
  for (std::int32_t i = 0; i < mesh.n_owned; ++i) moment = moment + mesh.volume[i] * mesh.centroid[i];
  CHECK(moment.x == Approx(pi / 2).epsilon(1e-13));
  CHECK(moment.y == Approx(2 * pi / 3).epsilon(1e-13));  // integral of r
  for (const BoundaryGroup& group : mesh.boundary_groups) {
    double area = 0, radius = 0;
    for (std::int32_t f = group.first; f < group.last; ++f) {
      area += mesh.area[f], radius += mesh.area[f] * mesh.face_centroid[f].y;
      if (group.name == "bottom") CHECK(mesh.area[f] == 0);
    }
    CAPTURE(group.name);
    if (group.name == "top") CHECK(area == Approx(2 * pi).epsilon(1e-13));
    if (group.name != "left" && group.name != "right") continue;
    CHECK(area == Approx(pi).epsilon(1e-13));
    CHECK(radius == Approx(2 * pi / 3).epsilon(1e-13));
  }
}

TEST_CASE(
    "the faces of a ring add up to its section, outward: a uniform pressure needs that of the hoop, and no more") {
  const int element = GENERATE(3, 4);
  CAPTURE(element);
  const Mesh mesh = cylinder(element);
  std::vector<Point> sum(mesh.n_owned);
  std::vector<double> divergence(mesh.n_owned, 0);  // of the position: 3
  for (std::int32_t f = 0; f < mesh.n_faces(); ++f) {
    const Point area = mesh.area[f] * Point{mesh.nx[f], mesh.ny[f], 0};
    sum[mesh.left[f]] = sum[mesh.left[f]] + area;
    divergence[mesh.left[f]] += dot(area, mesh.face_centroid[f]);
    if (f >= mesh.n_interior_faces) continue;
    sum[mesh.right[f]] = sum[mesh.right[f]] - area;
    divergence[mesh.right[f]] -= dot(area, mesh.face_centroid[f]);
  }
  double worst = 0, worst_volume = 0;
  for (std::int32_t i = 0; i < mesh.n_owned; ++i) {
    worst = std::max(worst, length(sum[i] - Point{0, 2 * pi * mesh.section[i], 0}) / mesh.section[i]);
    worst_volume = std::max(worst_volume, std::abs(divergence[i] / (3 * mesh.volume[i]) - 1));
    CHECK(mesh.section_centroid[i].y < mesh.centroid[i].y);
    CHECK(mesh.volume[i] == Approx(2 * pi * mesh.section_centroid[i].y * mesh.section[i]).epsilon(1e-14));  // Pappus
  }
  CHECK(worst < 1e-12);
  CHECK(worst_volume < 1e-12);
}

TEST_CASE("a mesh below the axis and a periodic pair across it are refused while round-off at the axis is none") {
  const Folder folder;
  const std::string square = strip_geo(3, 3);
  CHECK_THAT(error_of(request_of(folder.write("a.geo", square + "Translate {0, -0.5, 0} { Surface{1}; }\n"))),
             Contains("a.geo: the mesh of an axisymmetric scene lies at y >= 0") && Contains("-0.5"));
  CHECK_THAT(error_of(request_of(folder.write("b.geo", square), {{"bottom", "top"}})),
             Contains("'bottom' and 'top'") && Contains("a translation along x"));
  CHECK(error_of(request_of(folder.write("c.geo", square), {{"left", "right"}})).empty());
  const Mesh mesh =
      read_mesh(request_of(folder.write("d.geo", square + "Translate {0, 1e-12, 0} { Surface{1}; }\n")), test_mpi());
  double lowest = 1;
  for (const Point& p : mesh.nodes) lowest = std::min(lowest, p.y);
  CHECK(lowest == 0);
}
