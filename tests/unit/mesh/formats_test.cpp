#include <cstdlib>

#include "mesh/geometry.hpp"
#include "mesh_files.hpp"
#include "mixed_mesh.hpp"

using namespace cobasis;

namespace {

std::string convert(const Folder& folder, const std::string& geo, const std::string& options) {
  const std::string out = folder.path("out.msh");
  const std::string command = "gmsh -3 " + folder.path(geo) + " " + options + " -o " + out + " > /dev/null 2>&1";
  REQUIRE(std::system(command.c_str()) == 0);
  return out;
}

void check_same(const Mesh& a, const Mesh& b) {
  CHECK(a.dimension == b.dimension);
  CHECK(a.cell_nodes == b.cell_nodes);
  CHECK(a.cell_type == b.cell_type);
  CHECK(a.cell_region == b.cell_region);
  CHECK(a.region_names == b.region_names);
  CHECK(a.left == b.left);
  CHECK(a.right == b.right);
  CHECK(a.cell_faces == b.cell_faces);
  REQUIRE(a.boundary_groups.size() == b.boundary_groups.size());
  for (std::size_t g = 0; g < a.boundary_groups.size(); ++g) {
    CHECK(a.boundary_groups[g].name == b.boundary_groups[g].name);
    CHECK(a.boundary_groups[g].first == b.boundary_groups[g].first);
    CHECK(a.boundary_groups[g].last == b.boundary_groups[g].last);
  }
  REQUIRE(a.nodes.size() == b.nodes.size());
  double worst = 0;  // ASCII files carry 16 digits
  for (std::size_t i = 0; i < a.nodes.size(); ++i) worst = std::max(worst, length(a.nodes[i] - b.nodes[i]));
  CHECK(worst < 1e-14);
}

}  // namespace

TEST_CASE("both versions of .msh, ASCII and binary, give the mesh of the .geo") {
  const Folder folder;
  folder.write("space.geo", tetrahedra_geo(0.4));
  folder.write("plane.geo", strip_geo(6, 4, false) + "Physical Surface(\"body\") = {1};");
  for (const std::string geo : {"space.geo", "plane.geo"}) {
    const Mesh direct = read(folder.path(geo));
    CHECK(direct.region_names == std::vector<std::string>{"body"});
    for (const std::string options : {"-format msh22", "-format msh22 -bin", "-format msh41", "-format msh41 -bin"}) {
      INFO(geo + " " + options);
      check_same(direct, read(convert(folder, geo, options)));
    }
  }
}

TEST_CASE("elements of second order are read by their corners, with a notice") {
  const Folder folder;
  folder.write("a.geo", tetrahedra_geo(0.4));
  const Mesh linear = read(folder.path("a.geo"));
  const Mesh quadratic = read(convert(folder, "a.geo", "-order 2"));
  check_same(linear, quadratic);
  CHECK(linear.notices.empty());
  REQUIRE(quadratic.notices.size() == 1);
  CHECK_THAT(quadratic.notices[0], Catch::Contains("order 2"));
}

TEST_CASE("DefineConstant numbers of a .geo are set by name") {
  const Folder folder;
  MeshRequest request;
  request.file = folder.write("a.geo", strip_geo(4, 2));
  CHECK(read_mesh(request, test_mpi()).n_owned == 8);
  request.parameters = {{"nx", 10}, {"ny", 3}};
  CHECK(read_mesh(request, test_mpi()).n_owned == 30);
  request.parameters = {{"nz", 10}};
  CHECK_THAT(error_of(request), Catch::Contains("unknown mesh parameter 'nz'") && Catch::Contains("allowed: nx, ny"));
  request.parameters = {{"yy", 10}};
  CHECK_THAT(error_of(request), Catch::Contains("did you mean \"ny\"?"));
  request.file = folder.write("a.msh", mixed_mesh(0).text());
  CHECK_THAT(error_of(request), Catch::Contains("need a .geo"));
}

TEST_CASE("plane cells are turned counter-clockwise") {
  MshText mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.cells = {{CellType::triangle, {0, 2, 1}}, {CellType::triangle, {0, 2, 3}}};
  const Mesh read_back = read_text("a.msh", mesh.text());
  CHECK(read_back.volume == std::vector<double>{0.5, 0.5});
  CHECK(worst_gap(read_back) < 1e-16);
}

TEST_CASE("a dimension can be asked for") {
  const Folder folder;
  MeshRequest request;
  request.file = folder.write("a.geo", tetrahedra_geo(0.5));
  request.dimension = 2;
  CHECK_THAT(error_of(request), Catch::Contains("z = 0"));
  request.file = folder.write("b.geo", strip_geo(2, 2));
  CHECK(error_of(request).empty());
  request.dimension = 3;
  CHECK_THAT(error_of(request), Catch::Contains("no cells of dimension 3"));
}

TEST_CASE("boundary elements inside the mesh and off it are ignored with a notice") {
  MshText mesh = mixed_mesh(0);
  mesh.extra_elements = "3 2 1 1 5 6 7 8\n2 2 1 1 1 2 16\n";
  const Mesh read_back = read_text("a.msh", mesh.text());
  CHECK(read_back.n_interior_faces == 17);
  REQUIRE(read_back.notices.size() == 2);
  CHECK_THAT(read_back.notices[0], Catch::Contains("'wall' lie between two cells"));
  CHECK_THAT(read_back.notices[1], Catch::Contains("not the side of any cell"));
}
