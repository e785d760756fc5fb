#include "mesh/geometry.hpp"
#include "mesh_files.hpp"

using namespace cobasis;

TEST_CASE("a strip one cell high is its own neighbour across a periodic pair") {
  const Mesh mesh = read_text("a.geo", strip_geo(4, 1), {{"top", "bottom"}});
  REQUIRE(mesh.n_owned == 4);
  CHECK(mesh.n_interior_faces == 3 + 4);
  CHECK(mesh.n_boundary_faces == 2);
  CHECK(mesh.boundary_groups.size() == 2);
  CHECK(worst_gap(mesh) < 1e-15);
  int own = 0;
  for (std::int32_t f = 0; f < mesh.n_interior_faces; ++f) {
    if (mesh.left[f] != mesh.right[f]) continue;
    ++own;
    CHECK(mesh.ny[f] == Approx(1));  // out of the first-named group
    CHECK(length(mesh.face_delta[f] - Point{0, 0.25, 0}) < 1e-10);
  }
  CHECK(own == 4);
}

TEST_CASE("two cells in a ring share two faces, the periodic one points out of the first-named group") {
  for (const bool turned : {false, true}) {
    const auto pair = turned ? std::pair("right", "left") : std::pair("left", "right");
    const Mesh mesh = read_text("a.geo", strip_geo(2, 1), {pair});
    REQUIRE(mesh.n_interior_faces == 2);
    double nx_of_periodic = 0;
    for (std::int32_t f = 0; f < 2; ++f) {
      CHECK(mesh.left[f] + mesh.right[f] == 1);
      const Point n{mesh.nx[f], mesh.ny[f], 0};
      CHECK(length(mesh.face_delta[f] - 0.5 * n) < 1e-10);
      const double x = mesh.face_centroid[f].x;
      if (std::abs(x - 0.5) > 0.1) nx_of_periodic = mesh.nx[f];
    }
    CHECK(nx_of_periodic == Approx(turned ? 1 : -1));
    CHECK(worst_gap(mesh) < 1e-15);
  }
}

TEST_CASE("a square periodic both ways has no boundary") {
  const Mesh mesh = read_text("a.geo", strip_geo(8, 8, false), {{"left", "right"}, {"bottom", "top"}});
  CHECK(mesh.n_boundary_faces == 0);
  CHECK(mesh.boundary_groups.empty());
  CHECK(mesh.n_interior_faces == 3 * mesh.n_owned / 2);
  for (std::int32_t f = 0; f < mesh.n_interior_faces; ++f) {
    CHECK(length(mesh.face_delta[f]) < 0.2);
    CHECK(mesh.left[f] < mesh.right[f]);
    CHECK(dot(mesh.face_delta[f], Point{mesh.nx[f], mesh.ny[f], 0}) > 0);
  }
}

TEST_CASE("a tetrahedral box periodic in x joins the meshes of both sides") {
  std::string geo = R"(SetFactory("OpenCASCADE"); Box(1) = {0, 0, 0, 1, 1, 1}; Mesh.MeshSizeMax = 0.3;
Periodic Surface {2} = {1} Translate {1, 0, 0};
Physical Surface("x0") = {1}; Physical Surface("x1") = {2}; Physical Surface("wall") = {3, 4, 5, 6};
)";
  const Mesh open = read_text("a.geo", geo), closed = read_text("a.geo", geo, {{"x0", "x1"}});
  CHECK(closed.n_boundary_faces < open.n_boundary_faces);
  CHECK(closed.n_faces() - closed.n_boundary_faces ==
        open.n_faces() - open.n_boundary_faces + (open.n_boundary_faces - closed.n_boundary_faces) / 2);
  CHECK(worst_gap(closed) < 1e-14);
  REQUIRE(closed.boundary_groups.size() == 1);
  CHECK(closed.boundary_groups[0].name == "wall");
}

TEST_CASE("pairs that do not match are refused") {
  const auto error = [](std::vector<std::pair<std::string, std::string>> pairs, const std::string& more) {
    const Folder folder;
    MeshRequest request;
    request.file = folder.write("a.geo", strip_geo(4, 4) + more);
    request.periodic = std::move(pairs);
    return error_of(request);
  };
  CHECK(error({{"left", "right"}}, "").empty());
  CHECK_THAT(error({{"left", "rigth"}}, ""), Catch::Contains("'rigth'") && Catch::Contains("right"));
  CHECK_THAT(error({{"left", "top"}}, ""), Catch::Contains("no face of 'top'"));
  CHECK_THAT(error({{"left", "left"}}, ""), Catch::Contains("named twice"));
  CHECK_THAT(error({{"left", "right"}, {"top", "left"}}, ""), Catch::Contains("named twice"));
  const std::string graded = "Transfinite Curve {2} = 5 Using Progression 1.01;";
  CHECK_THAT(error({{"left", "right"}}, graded), Catch::Contains("no face of 'right'"));
}
