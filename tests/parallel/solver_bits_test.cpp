// The same results to the last bit, whoever owns which cell.
#include <catch2/catch.hpp>
#include <chrono>
#include <random>
#include <regex>
#include <thread>

#include "support/hypersonic.hpp"
#include "support/scene.hpp"

using namespace cobasis;
using namespace cobasis::test;

namespace {

using MakeScene = std::function<Scene(const Mpi&, const SceneOptions&)>;

/// The state after some steps of the scene on the first `n` ranks of this test, and how often a step was taken again;
/// empty on the others.
std::vector<std::vector<double>> state_on(int n, std::int64_t steps, const MakeScene& make,
                                          const SceneOptions& options = {}) {
  MPI_Comm comm;
  MPI_Comm_split(MPI_COMM_WORLD, ranks().rank() < n ? 0 : MPI_UNDEFINED, ranks().rank(), &comm);
  std::vector<std::vector<double>> state;
  if (comm != MPI_COMM_NULL) {
    const Mpi mpi(comm);
    try {
      Scene scene = make(mpi, options);
      scene.run(steps);
      CHECK(scene.solver->step() == steps);
      state = state_by_global_cell(scene, mpi);
      const std::int64_t redone = scene.solver->robustness().redone;
      if (mpi.root()) state.push_back({static_cast<double>(redone)});
    } catch (const std::exception& error) {  // the other ranks wait
      FAIL_CHECK(error.what());
    }
    MPI_Comm_free(&comm);
  }
  ranks().barrier();
  return state;
}

/// Returns, on rank 0, how often a step was taken again.
double check_bits(std::int64_t steps, const std::string& name, const MakeScene& make) {
  const auto serial = state_on(1, steps, make);
  REQUIRE(ranks().any(serial.size() > 100));
  for (int n = 2; n <= ranks().size(); ++n) {
    CAPTURE(name, n);
    const bool same = state_on(n, steps, make) == serial;
    if (ranks().root()) CHECK(same);
  }
  SceneOptions options;
  options.partition = [](std::int64_t cell, int parts) { return static_cast<int>(std::mt19937(cell)() % parts); };
  const bool same = state_on(ranks().size(), steps, make, options) == serial;
  CAPTURE(name, "random partition");
  if (ranks().root()) CHECK(same);
  return serial.empty() ? 0 : serial.back()[0];
}

void check_bits(std::int64_t steps, const std::string& name,
                const std::vector<std::pair<std::string, std::string>>& set) {
  check_bits(steps, name,
             [&](const Mpi& mpi, const SceneOptions& options) { return make_case(name, set, mpi, options); });
}

double check_bits_of_text(std::int64_t steps, const std::string& name, const std::string& text) {
  return check_bits(steps, name,
                    [&](const Mpi& mpi, const SceneOptions& options) { return make_scene(text, mpi, options); });
}

const std::string triangles = "mesh = \"@box.geo\"\nmesh_parameters = { n = 20, element = 3 }\nend_time = 1\n",
                  hexahedra = "mesh = \"@box_space.geo\"\nmesh_parameters = { n = 8 }\nend_time = 1\n",
                  tetrahedra = "mesh = \"@box_space.geo\"\nmesh_parameters = { n = 8, element = 4 }\nend_time = 1\n";
const std::string aluminium = "[phase.aluminium]\nmaterial = \"aluminium\"\n";

std::string block_that_moves(bool space) {
  return aluminium + "[[region]]\nshape = \"everywhere\"\nfill = \"aluminium\"\npressure = 1e8\nvelocity = " +
         (space ? R"(["100*x*y", "-30*x", "50*z"])" : R"(["100*x*y", "-30*x"])") +
         "\n[boundary]\nleft = \"transmissive\"\n\"*\" = \"wall\"\n";
}
const std::string disc_in_void = aluminium + R"([phase.surroundings]
void = { pressure = 1e5 }
[[region]]
shape = "everywhere"
fill = "surroundings"
[[region]]
shape = "sphere"
center = [0.45, 0.5]
radius = 0.3
fill = "aluminium"
pressure = 1e5
velocity = ["100 + 30*y", "50 - 20*x"]
[boundary]
"*" = "wall"
)";
/// Two bodies that meet at 30 degrees to a square of triangles, between the given boundaries.
std::vector<std::pair<std::string, std::string>> oblique(const std::pair<std::string, std::string>& scheme,
                                                         const std::string& boundary) {
  return {scheme,
          {"end_time", "1"},
          {"mesh", "../meshes/box.geo"},
          {"mesh_parameters", "{ n = 20, element = 3 }"},
          {"boundary", boundary},
          {"region.1.normal", "[-0.866, -0.5]"},
          {"region.1.point", "[0.5, 0.5]"}};
}

}  // namespace

TEST_CASE("500 steps of the droplet give the same bits on any number of ranks and for a random partition") {
  check_bits(500, "droplet", {set_first_order, {"mesh_parameters.h", "1e-3"}});
  check_bits(60, "droplet", {set_first_order, {"mesh_parameters.h", "1e-3"}, {"mesh_parameters.element", "4"}});
}

TEST_CASE("two solids, and a solid in gas, give the same bits on any number of ranks") {
  check_bits(150, "impact",
             oblique(set_first_order, "{ left = \"transmissive\", right = \"transmissive\", \"*\" = \"wall\" }"));
  check_bits(150, "advection", {set_first_order, {"mesh_parameters", "{ n = 100, element = 3 }"}});
}

TEST_CASE("a solid of second order gives the same bits on any number of ranks") {
  check_bits_of_text(60, "triangles", second_order + triangles + block_that_moves(false));
  check_bits_of_text(30, "hexahedra", second_order + hexahedra + block_that_moves(true));
  check_bits_of_text(30, "tetrahedra", second_order + tetrahedra + block_that_moves(true));
}

TEST_CASE("sharp interfaces of second order give the same bits on any number of ranks") {
  check_bits(60, "impact", oblique(set_second_order, "{ \"*\" = \"transmissive\" }"));
  check_bits(100, "sliding", oblique(set_second_order, "{ \"*\" = \"transmissive\" }"));
  check_bits(100, "advection", {set_second_order, {"mesh_parameters", "{ n = 100, element = 3 }"}});
  check_bits_of_text(60, "disc in void", second_order + triangles + disc_in_void);
}

TEST_CASE("a sharp contact between tetrahedra gives the same bits on any number of ranks") {
  check_bits_of_text(60, "bodies that meet", second_order + tetrahedra + R"([phase.copper]
material = "copper"
[phase.aluminium]
material = "aluminium"
[[region]]
shape = "everywhere"
fill = "aluminium"
pressure = 1e5
velocity = [-300, 50, 0]
[[region]]
shape = "half_space"
point = [0.45, 0.5, 0.5]
normal = [-0.8, -0.4, -0.2]
fill = "copper"
pressure = 1e5
velocity = [400, -50, 0]
[boundary]
"*" = "transmissive"
)");
}

TEST_CASE("a body that goes through another between sharp surfaces gives the same bits on any number of ranks") {
  const std::string around = GENERATE("void = { pressure = 1e5 }", "material = \"air\"");
  const bool space = GENERATE(false, true);
  const auto point = [&](const std::string& in_plane) { return "[" + in_plane + (space ? ", 0.5]\n" : "]\n"); };
  const std::string state = "pressure = 1e5\n",
                    mesh = space ? std::regex_replace(tetrahedra, std::regex("n = 8"), "n = 10") : triangles;
  check_bits_of_text(60, around,
                     "scheme = { interface = \"sharp\" }\n" + mesh + "[phase.copper]\nmaterial = \"copper\"\n" +
                         aluminium + "[phase.around]\n" + around +
                         "\n[[region]]\nshape = \"everywhere\"\nfill = \"around\"\n" + (around[0] == 'm' ? state : "") +
                         "[[region]]\nshape = \"box\"\nlow = " + (space ? "[0.5, 0.1, 0.1]" : "[0.5, 0.1]") +
                         "\nhigh = " + (space ? "[0.65, 0.9, 0.9]" : "[0.65, 0.9]") + "\nfill = \"aluminium\"\n" +
                         state + "[[region]]\nshape = \"sphere\"\ncenter = " + point("0.35, 0.5") +
                         "radius = 0.14\nfill = \"copper\"\nvelocity = " + (space ? "[1500, 0, 0]\n" : "[1500, 0]\n") +
                         state + "[boundary]\n\"*\" = \"transmissive\"\n");
}

TEST_CASE("steps that are taken again, and states that are mended, give the same bits on any number of ranks") {
  for (const auto& [name, text] : {std::pair("gas", hypersonic_gas(4)), std::pair("solid", hypersonic_solid(3)),
                                   std::pair("solid in void", hypersonic_solid_in_void(3))}) {
    const double redone = check_bits_of_text(30, name, text);
    CAPTURE(name);
    if (ranks().root()) CHECK(redone > 0);
  }
  check_bits_of_text(30, "two solids", hypersonic_solids(4));
  check_bits_of_text(30, "solid in water", hypersonic_solid_in_water(3));
}

TEST_CASE("what leaves is the same, to the last bit, with a rank that has no boundary") {
  const auto outflow = [](const SceneOptions& options) {
    Scene scene = make_scene(
        second_order + "mesh = \"@box.geo\"\nmesh_parameters = { n = 8 }\nend_time = 1\n" + block_that_moves(false),
        ranks(), options);
    if (options.partition && ranks().rank() == ranks().size() - 1) {
      CHECK(scene.mesh.n_owned == 1);
      CHECK(scene.mesh.first_boundary_face() == scene.mesh.n_faces());
    }
    scene.run(5);
    return std::pair(total(*scene.solver, "outflow.left.mass.aluminium"),
                     total(*scene.solver, "outflow.top.energy.aluminium"));
  };
  SceneOptions apart;  // a cell in the middle of the first quarter
  apart.partition = [](std::int64_t cell, int parts) { return cell == 12 ? parts - 1 : 0; };
  CHECK(outflow(apart) == outflow({}));
}

TEST_CASE("the droplet with a sharp surface gives the same bits on any number of ranks") {
  check_bits(100, "droplet", {set_second_order, {"mesh_parameters.h", "1e-3"}});
}

TEST_CASE("the axisymmetric droplet gives the same bits on any number of ranks") {
  check_bits(100, "droplet_axisymmetric", {set_first_order});
  check_bits(100, "droplet_axisymmetric", {{"mesh_parameters.element", "3"}});
  check_bits(100, "droplet_axisymmetric", {{"scheme.interface", "compressed"}});
}

TEST_CASE("faces inside a rank are swept while the halo of a late neighbour is on its way") {
  constexpr auto delay = std::chrono::milliseconds(300);
  SceneOptions options;
  options.solver.before_halo_send = [&] {
    if (ranks().rank() == 1) std::this_thread::sleep_for(delay);
  };
  Scene scene = make_case("shear", {set_first_order, {"mesh_parameters", "{ n = 300 }"}}, ranks(), options);
  scene.run(1);
  bool waits_for_one = false;
  for (const Neighbour& neighbour : scene.mesh.neighbours) waits_for_one = waits_for_one || neighbour.rank == 1;
  CHECK(ranks().any(waits_for_one));
  const double late = std::chrono::duration<double>(delay).count();
  if (waits_for_one) {
    CHECK(scene.solver->clock().inside_swept < 0.5 * late);
    CHECK(scene.solver->clock().halo_received > 0.9 * late);
  }
}

TEST_CASE("falling bodies that rub between driven walls give the same bits on any number of ranks") {
  for (const std::string& scheme : {first_order, second_order})
    check_bits_of_text(60, "bodies that rub", scheme + triangles + R"(gravity = [2e4, -1e5]
[phase.copper]
eos = { type = "mie_gruneisen", rho0 = 8930, c0 = 3940, s = 1.489, gamma0 = 2.02 }
elastic = { mu = 46e9, rho0 = 8930 }
[phase.aluminium]
material = "aluminium"
[contact]
default = { type = "friction", coefficient = 0.3 }
[[region]]
shape = "everywhere"
fill = "aluminium"
pressure = 1e8
velocity = [-30, 50]
[[region]]
shape = "half_space"
point = [0.45, 0.5]
normal = [-0.8, -0.4]
fill = "copper"
pressure = 1e8
velocity = [30, -20]
[boundary]
left = { type = "wall", velocity = [20, 0] }
right = { type = "no_slip", velocity = [0, "10*y"] }
bottom = "no_slip"
top = { type = "outlet", pressure = 1e5 }
)");
}

TEST_CASE("mixtures whose velocities and pressures relax give the same bits on any number of ranks") {
  check_bits_of_text(60, "relaxing mixture", triangles + R"([phase.copper]
material = "copper"
[phase.air]
material = "air"
[relaxation]
"copper-air" = { velocity = 1e8, pressure = "stiff" }
[[region]]
shape = "everywhere"
alpha = { copper = 0.6, air = 0.4 }
pressure = 1e6
velocity = [-30, 50]
[[region]]
shape = "half_space"
point = [0.45, 0.5]
normal = [-0.8, -0.4]
fill = "copper"
pressure = 1e8
velocity = [30, -20]
[boundary]
"*" = "wall"
)");
}
