// What must not matter: the order in which phases are named, and which of all tangents a face has.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "measures.hpp"

using namespace cobasis;
using namespace cobasis::test;

namespace {

const std::string copper = "[phase.copper]\nmaterial = \"copper\"\n";
const std::string aluminium = "[phase.aluminium]\nmaterial = \"aluminium\"\n";
const std::string air = "[phase.air]\nmaterial = \"air\"\n";

const std::string plane_box = "mesh = \"@box.geo\"\nmesh_parameters = { n = 24, element = 3 }\nend_time = 1\n";
const std::string space_box = "mesh = \"@box_space.geo\"\nmesh_parameters = { n = 8, element = 4 }\nend_time = 1\n";

/// A disc (ball) of copper and a half space of aluminium in air, all meeting.
std::string three_bodies(bool space) {
  const std::string z = space ? ", 40.0]\n" : "]\n", centre = space ? "[0.35, 0.5, 0.5]" : "[0.35, 0.5]";
  return R"([[region]]
shape = "everywhere"
fill = "air"
pressure = 1e5
velocity = [0.0, 0.0)" +
         std::string(space ? ", 0.0]\n" : "]\n") + R"([[region]]
shape = "half_space"
fill = "aluminium"
pressure = 1e5
point = [0.57, 0.5]
normal = [0.96, 0.28]
velocity = [-100.0, 30.0)" +
         z + R"([[region]]
shape = "sphere"
center = )" +
         centre + R"(
radius = 0.2
fill = "copper"
pressure = 2e8
velocity = [300.0, -20.0)" +
         z + R"([boundary]
"*" = "wall"
)";
}

Scene run(const std::string& text, int steps, const SceneOptions& options = {}) {
  Scene scene = make_scene(first_order + text, ranks(), options);
  scene.run(steps);
  return scene;
}

/// Turns the tangents of every face by an angle of its own.
void turn_tangents(Mesh& mesh) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> angles(0, 2 * M_PI);
  for (std::int32_t f = 0; f < mesh.n_faces(); ++f) {
    const double angle = angles(random), c = std::cos(angle), s = std::sin(angle);
    const double t2[3] = {mesh.ny[f] * mesh.tz[f] - mesh.nz[f] * mesh.ty[f],
                          mesh.nz[f] * mesh.tx[f] - mesh.nx[f] * mesh.tz[f],
                          mesh.nx[f] * mesh.ty[f] - mesh.ny[f] * mesh.tx[f]};
    double* const t1[3] = {&mesh.tx[f], &mesh.ty[f], &mesh.tz[f]};
    for (int i = 0; i < 3; ++i) *t1[i] = c * *t1[i] + s * t2[i];
  }
}

double change_by_turning(const std::string& text) {
  SceneOptions turned;
  turned.change_mesh = turn_tangents;
  const Scene a = run(text, 50), b = run(text, 50, turned);
  CHECK(a.solver->step() == 50);
  return largest_difference(a, b);
}

}  // namespace

TEST_CASE("the order of the phases in the case does not matter") {
  const bool space = GENERATE(false, true);
  const std::string mesh = space ? space_box : plane_box;
  std::vector<std::string> phases{copper, aluminium, air};
  const Scene first = run(mesh + phases[0] + phases[1] + phases[2] + three_bodies(space), 50);
  CHECK(first.solver->step() == 50);
  std::sort(phases.begin(), phases.end());
  do {
    const Scene other = run(mesh + phases[0] + phases[1] + phases[2] + three_bodies(space), 50);
    const double difference = largest_difference(first, other);
    INFO((space ? "space, " : "plane, ") << phases[0].substr(0, 16) << phases[1].substr(0, 16)
                                         << phases[2].substr(0, 16) << ": relative difference " << difference);
    CHECK(difference < 1e-12);
  } while (std::next_permutation(phases.begin(), phases.end()));
}

TEST_CASE("the choice of the tangents does not matter in a prestrained solid") {
  const double difference = change_by_turning(space_box + aluminium + R"(
[[region]]
shape = "everywhere"
fill = "aluminium"
pressure = 2e8
velocity = ["100*x*y", "200*y*z", "-150*x"]
phase.aluminium = { cobasis = [[1.01, 0.12, 0.0], [0.0, 0.99, 0.12], [0.03, 0.0, 1.0]] }
[boundary]
"*" = "wall"
)");
  INFO("relative difference " << difference);
  CHECK(difference < 1e-12);
}

TEST_CASE("the choice of the tangents does not matter where two solids meet") {
  const std::string contact = GENERATE(as<std::string>{}, "sliding", "adherence");
  const double difference = change_by_turning(space_box + copper + aluminium + air + "[contact]\ndefault = \"" +
                                              contact + "\"\n" + three_bodies(true));
  INFO(contact << ": relative difference " << difference);
  CHECK(difference < 1e-12);
}
