// Boundaries: what enters, what is mirrored, what comes back on the other side.
#include <catch2/catch.hpp>
#include <cmath>

#include "support/scene.hpp"

using namespace cobasis;
using namespace cobasis::test;

namespace {

double largest_change(const std::vector<std::vector<double>>& a, const std::vector<std::vector<double>>& b,
                      std::size_t component) {
  double largest = 0;
  for (std::size_t cell = 0; cell < a.size(); ++cell)
    largest = std::max(largest, std::fabs(a[cell][component] - b[cell][component]));
  return largest;
}

}  // namespace

TEST_CASE("a solid that flows in displaces the gas at its own speed, with pressure and velocity uniform") {
  const std::string element = GENERATE("3", "4");
  CAPTURE(element);
  Scene scene = make_scene(
      first_order + "mesh = \"@box.geo\"\nmesh_parameters = { n = 30, height = 0.2, element = " + element + R"( }
end_time = 0.5e-3
[phase.aluminium]
material = "aluminium"
[phase.air]
material = "air"
[[region]]
shape = "everywhere"
fill = "air"
density = 1.0
pressure = 1e5
velocity = [400.0, 0.0]
[boundary]
left = { type = "inflow", fill = "aluminium", pressure = 1e5, velocity = [400.0, 0.0] }
right = "transmissive"
"*" = "symmetry"
)",
      ranks());
  scene.run();
  const Solver& solver = *scene.solver;
  const double volume = 400 * 0.5e-3 * 0.2;  // u t times the inlet
  CHECK(total(solver, "volume.aluminium") == Approx(volume).epsilon(1e-9));
  CHECK(total(solver, "mass.aluminium") == Approx(2700 * volume).epsilon(1e-9));
  CHECK(total(solver, "mass.aluminium") + total(solver, "outflow.left.mass.aluminium") == Approx(0).margin(1e-9));
  const Snapshot snapshot = solver.snapshot();
  for (std::int32_t cell = 0; cell < scene.mesh.n_owned; ++cell) {
    const PhaseSnapshot &aluminium = snapshot.phases[0], &air = snapshot.phases[1];
    if (aluminium.alpha[cell] > 0) {
      CHECK(std::fabs(aluminium.pressure[cell] - 1e5) < 20);
      CHECK(std::fabs(aluminium.velocity[0][cell] - 400) < 4e-7);
    }
    if (air.alpha[cell] > 0) {
      CHECK(std::fabs(air.pressure[cell] - 1e5) < 1e-4);
      CHECK(std::fabs(air.velocity[0][cell] - 400) < 4e-7);
    }
  }
}

TEST_CASE("a solid stretched along and across its slip walls stays at rest between them") {
  const std::string mesh =
      GENERATE(as<std::string>{}, "mesh = \"@box.geo\"\nmesh_parameters = { n = 12, element = 3 }\n",
               "mesh = \"@box_space.geo\"\nmesh_parameters = { n = 6, element = 4 }\n");
  CAPTURE(mesh);
  Scene scene = make_scene(first_order + mesh + R"(end_time = 1
[phase.copper]
material = "copper"
[[region]]
shape = "everywhere"
fill = "copper"
pressure = 3e9
phase.copper = { cobasis = [[1.1, 0, 0], [0, 0.95, 0], [0, 0, 0.98]] }
[boundary]
"*" = "wall"
)",
                           ranks());
  const auto before = state_by_global_cell(scene, ranks());
  scene.run(100);
  const auto after = state_by_global_cell(scene, ranks());
  CHECK(largest_change(before, after, 0) < 1e-9);                                                         // [kg/m^3]
  for (int i = 1; i <= scene.mesh.dimension; ++i) CHECK(largest_change(before, after, i) < 1e-9 * 8900);  // 1e-9 m/s
}

TEST_CASE("nothing passes a wall, not even round-off") {
  Scene scene = make_scene(first_order + R"(mesh = "@box.geo"
mesh_parameters = { n = 15, element = 3 }
end_time = 1
[phase.copper]
material = "copper"
[[region]]
shape = "everywhere"
fill = "copper"
pressure = 1e5
velocity = ["100*x*y", "-30*x"]
[boundary]
"*" = "wall"
)",
                           ranks());
  scene.run(50);
  for (const char* group : {"left", "right", "bottom", "top"}) {
    CHECK(total(*scene.solver, std::string("outflow.") + group + ".mass.copper") == 0);
    CHECK(total(*scene.solver, std::string("outflow.") + group + ".energy.copper") == 0);
  }
}

TEST_CASE("what leaves through a periodic boundary comes back on the other side") {
  Scene scene = make_scene(first_order + R"case(mesh = "@box.geo"
mesh_parameters = { n = 20, element = 3 }
end_time = 1
[phase.gas]
eos = { type = "ideal_gas", gamma = 1.4 }
density = 1.0
[[region]]
shape = "everywhere"
fill = "gas"
pressure = 1e5
velocity = ["100 + 50*sin(2*pi*y)", "70 + 20*sin(2*pi*x)"]
[boundary]
left = { type = "periodic", with = "right" }
bottom = { type = "periodic", with = "top" }
)case",
                           ranks());
  CHECK(scene.mesh.boundary_groups.empty());
  const double mass = total(*scene.solver, "mass.gas"), momentum = total(*scene.solver, "momentum.gas.x"),
               energy = total(*scene.solver, "energy.gas");
  scene.run(200);
  CHECK(total(*scene.solver, "mass.gas") == Approx(mass).epsilon(1e-13));
  CHECK(total(*scene.solver, "momentum.gas.x") == Approx(momentum).epsilon(1e-12));
  CHECK(total(*scene.solver, "energy.gas") == Approx(energy).epsilon(1e-13));
}

TEST_CASE("a liquid that only its inlet shows comes in with a sharp surface") {
  const std::string element = GENERATE("3", "4");
  CAPTURE(element);
  Scene scene = make_scene("mesh = \"@box.geo\"\nmesh_parameters = { n = 20, element = " + element + R"( }
end_time = 3e-3
[phase.water]
material = "water"
[phase.air]
material = "air"
[[region]]
shape = "everywhere"
fill = "air"
pressure = 1e5
[boundary]
left = { type = "inflow", fill = "water", pressure = 1e5, velocity = [200.0, 0.0] }
right = "transmissive"
"*" = "symmetry"
)",
                           ranks());
  scene.run();
  const Solver& solver = *scene.solver;
  CHECK(total(solver, "mass.water") == Approx(-total(solver, "outflow.left.mass.water")).epsilon(1e-12));
  CHECK(total(solver, "volume.water") == Approx(200 * 3e-3).epsilon(0.01));  // u t times the inlet
}
