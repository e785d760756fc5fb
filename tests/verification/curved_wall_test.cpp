// A body on a wall that is curved: a ball of jelly falls on a sphere.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "app/integrals.hpp"
#include "measures.hpp"

using namespace cobasis;
using namespace cobasis::test;

TEST_CASE(
    "a ball on a sphere keeps its mass and, with the work of the void, its energy, and spreads as on finer meshes") {
  const std::string element = GENERATE(as<std::string>{}, "3", "4");
  CAPTURE(element);
  Scene scene =
      make_case("droplet_on_sphere", {{"mesh_parameters", "{ h = 0.4e-3, element = " + element + " }"}}, ranks());
  const Solver& solver = *scene.solver;
  Integrals integrals(scene.setup.integrals, Geometry::axisymmetric, scene.mesh, ranks(), scene.setup.phases);
  const double pressure = *scene.setup.phases[1].void_pressure;
  const auto energy = [&] {  // what the void loses, too
    return total(solver, "energy.carbopol") + total(solver, "potential.carbopol") +
           pressure * total(solver, "volume.carbopol");
  };
  const double mass = total(solver, "mass.carbopol"), kinetic = total(solver, "kinetic.carbopol"), initial = energy();
  double spread = 0, change = 0;
  while (solver.time() < scene.setup.end_time) {
    scene.run(100);
    spread = std::max(spread, integrals.evaluate(scene.solver->snapshot(Solver::Content::alpha))[0]);
    change = std::max(change, std::fabs(energy() - initial) / kinetic);
  }
  INFO("largest spread " << spread << " m; energy changes by " << change << " of the kinetic energy at first");
  CHECK(total(solver, "mass.carbopol") == Approx(mass).epsilon(1e-12));
  CHECK(change < 1e-3);
  CHECK(spread == Approx(4.45e-3).epsilon(0.05));  // h = 0.2 mm: 4.44 mm on quadrilaterals, 4.47 mm on triangles
}

TEST_CASE("a gas at rest before a curved wall stays at rest, in the meridian plane and with a curved wall in a plane") {
  const std::string scene_type = GENERATE(as<std::string>{}, "plane", "axisymmetric");
  const std::string element = GENERATE(as<std::string>{}, "3", "4");
  CAPTURE(scene_type, element);
  Scene scene = make_scene("scene = \"" + scene_type +
                               "\"\nmesh = \"@round_wall.geo\"\nmesh_parameters = { h = 0.8e-3, element = " + element +
                               R"( }
end_time = 1e-4
[phase.air]
material = "air"
[[region]]
shape = "everywhere"
fill = "air"
pressure = 1e5
[boundary]
axis = ")" + (scene_type == "plane" ? "symmetry" : "axis") +
                               "\"\n\"*\" = \"wall\"\n",
                           ranks());
  scene.run();
  const Result result(scene);
  for (int d = 0; d < 2; ++d) {
    const Range u = range(scene, [&](std::int32_t c) { return result.mixture.velocity[d][c]; });
    CHECK(u.distance_to(0) < 1e-9);  // round-off; sound takes 345 m/s
  }
}
