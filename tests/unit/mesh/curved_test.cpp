// Curved boundaries are polygons and polyhedra of corners that lie on them: what that costs, and elements of second
// order.
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "mesh/geometry.hpp"
#include "mesh_files.hpp"

using namespace cobasis;

namespace {

constexpr double pi = std::numbers::pi;

Mesh project_mesh(const std::string& name, const std::map<std::string, double>& parameters, bool axisymmetric = false) {
  MeshRequest request;
  request.file = SOURCE_DIR "/meshes/" + name;
  request.parameters = parameters;
  request.axisymmetric = axisymmetric;
  return read_mesh(request, test_mpi());
}

double volume_of(const Mesh& mesh, const std::string& region) {
  double sum = 0;
  for (std::int32_t i = 0; i < mesh.n_owned; ++i)
    if (mesh.region_names[mesh.cell_region[i]] == region) sum += mesh.volume[i];
  return sum;
}

double area_of(const Mesh& mesh, const std::string& group) {
  double sum = 0;
  for (const BoundaryGroup& g : mesh.boundary_groups)
    for (std::int32_t f = g.first; g.name == group && f < g.last; ++f) sum += mesh.area[f];
  return sum;
}

/// Where the droplet's mantle meets its surroundings, that is without its lid.
double mantle_of(const Mesh& mesh) {
  double sum = 0;
  for (std::int32_t f = 0; f < mesh.n_interior_faces; ++f)
    if (mesh.cell_region[mesh.left[f]] != mesh.cell_region[mesh.right[f]] && std::fabs(mesh.nz[f]) < 0.5)
      sum += mesh.area[f];
  return sum;
}

double order(double coarse, double fine) { return std::log2(std::fabs(coarse / fine)); }

}  // namespace

TEST_CASE("the droplet has the volume and the area of the polygon in its circle, exact to second order") {
  constexpr double radius = 6e-3, body = 2e-3;
  std::vector<double> volume_errors, area_errors;
  for (const int m : {4, 8}) {  // cells along an eighth of the circle
    CAPTURE(m);
    const Mesh mesh =
        project_mesh("droplet.geo", {{"h", 2 * radius / (3 * m)}, {"body", body}, {"height", 1.5 * body}});
    const double theta = pi / 4 / m;  // of a side of the polygon
    volume_errors.push_back(volume_of(mesh, "jelly") / (pi / 4 * radius * radius * body) - 1);
    area_errors.push_back(mantle_of(mesh) / (pi / 2 * radius * body) - 1);
    CHECK(volume_errors.back() == Approx(std::sin(theta) / theta - 1).epsilon(1e-9));
    CHECK(area_errors.back() == Approx(std::sin(theta / 2) / (theta / 2) - 1).epsilon(1e-9));
  }
  INFO("volume " << volume_errors[0] << ", " << volume_errors[1] << "; area " << area_errors[0] << ", "
                 << area_errors[1]);
  CHECK(order(volume_errors[0], volume_errors[1]) == Approx(2).margin(0.02));
  CHECK(order(area_errors[0], area_errors[1]) == Approx(2).margin(0.02));
}

TEST_CASE("a round wall has the area of the sphere, and the room before it its volume, to second order") {
  const double element = GENERATE(3, 4);
  constexpr double wall = 6e-3, height = 8e-3, outer = wall + height, phi = 80 * pi / 180;
  const double area = 2 * pi * wall * wall * (1 - std::cos(phi));
  const double volume = 2 * pi / 3 * (1 - std::cos(phi)) * (outer * outer * outer - wall * wall * wall);
  std::vector<double> volume_errors, area_errors;
  for (const double h : {phi * wall / 12, phi * wall / 24, phi * wall / 48}) {
    const Mesh mesh = project_mesh("round_wall.geo", {{"h", h}, {"element", element}}, true);
    volume_errors.push_back(volume_of(mesh, "room") / volume - 1);
    area_errors.push_back(area_of(mesh, "wall") / area - 1);
  }
  INFO("volume " << volume_errors[0] << ", " << volume_errors[1] << ", " << volume_errors[2] << "; area "
                 << area_errors[0] << ", " << area_errors[1] << ", " << area_errors[2]);
  for (int i = 0; i < 2; ++i) {
    CHECK(order(volume_errors[i], volume_errors[i + 1]) == Approx(2).margin(0.02));
    CHECK(order(area_errors[i], area_errors[i + 1]) == Approx(2).margin(0.02));
  }
  CHECK(std::fabs(area_errors[2]) < 2e-4);
}

TEST_CASE("an unstructured ball of tetrahedra has the volume of the ball to second order") {
  const Folder folder;
  std::vector<double> errors;
  for (const double h : {0.5, 0.25}) {
    const Mesh mesh =
        read(folder.write("ball.geo", fmt::format("SetFactory(\"OpenCASCADE\"); Sphere(1) = {{0, 0, 0, 1}};\n"
                                                  "Mesh.MeshSizeMin = {0}; Mesh.MeshSizeMax = {0};\n"
                                                  "Physical Surface(\"wall\") = {{1}};",
                                                  h)));
    errors.push_back(total_volume(mesh) / (4 * pi / 3) - 1);
  }
  INFO("volume " << errors[0] << ", " << errors[1]);
  CHECK(order(errors[0], errors[1]) == Approx(2).margin(0.3));
}

TEST_CASE("triangles, quadrilaterals, tetrahedra, hexahedra and prisms of second order are read by their corners") {
  const Folder folder;
  const std::string disc = R"(SetFactory("OpenCASCADE"); Disk(1) = {0, 0, 0, 1};
Mesh.MeshSizeMax = 0.4; Physical Curve("wall") = {1}; Physical Surface("disc") = {1};
)";
  const std::string block = R"(SetFactory("OpenCASCADE"); Disk(1) = {0, 0, 0, 1}; Mesh.MeshSizeMax = 0.5;
body[] = Extrude {0, 0, 1} { Surface{1}; Layers{2}; Recombine; };
Physical Surface("wall") = Surface{:}; Physical Volume("body") = {body[1]};
)";
  const struct {
    std::string name, text;
    CellType type;
  } kinds[] = {
      {"triangle", disc, CellType::triangle},
      {"quadrilateral", disc + "Mesh.RecombineAll = 1; Mesh.SubdivisionAlgorithm = 1;", CellType::quadrilateral},
      {"tetrahedron", tetrahedra_geo(0.5), CellType::tetrahedron},
      {"hexahedron", "Mesh.RecombineAll = 1; Mesh.SubdivisionAlgorithm = 1;" + block, CellType::hexahedron},
      {"prism", block, CellType::prism}};
  for (const auto& kind : kinds) {
    const std::string file = folder.write("a.geo", kind.text);
    const Mesh linear = read(file);
    REQUIRE(linear.n_owned > 4);
    CHECK(linear.cell_type == std::vector<CellType>(linear.cell_type.size(), kind.type));
    for (const std::string complete : {"0", "1"}) {
      CAPTURE(kind.name, complete);
      const std::string out = folder.path("a.msh");
      const std::string command =
          "gmsh -3 -order 2 -setnumber Mesh.SecondOrderIncomplete " + complete + " " + file + " -o " + out;
      REQUIRE(std::system((command + " > /dev/null 2>&1").c_str()) == 0);
      const Mesh quadratic = read(out);
      CHECK(quadratic.cell_type == linear.cell_type);
      CHECK(quadratic.cell_nodes == linear.cell_nodes);
      CHECK(quadratic.nodes.size() == linear.nodes.size());
      CHECK(total_volume(quadratic) == Approx(total_volume(linear)).epsilon(1e-13));
      REQUIRE(quadratic.boundary_groups.size() == 1);
      CHECK(quadratic.boundary_groups[0].name == "wall");
      CHECK(quadratic.n_boundary_faces == linear.n_boundary_faces);
      CHECK(worst_gap(quadratic) < 1e-14);
      REQUIRE(quadratic.notices.size() == 1);
      CHECK_THAT(quadratic.notices[0], Catch::Contains("order 2"));
    }
  }
  const Mesh script = read(folder.write("b.geo", disc + "Mesh.ElementOrder = 2;"));
  CHECK_THAT(script.notices.at(0), Catch::Contains("elements of order 2 are read by their corners"));
}
