// Gravity: free fall, a column at rest, and the energy between.
#include <catch2/catch.hpp>
#include <cmath>

#include "measures.hpp"

using namespace cobasis;
using namespace cobasis::test;

namespace {

const std::string schemes[] = {"scheme = { order = 1, interface = \"diffuse\" }\n",
                               "scheme = { order = 2, interface = \"diffuse\" }\n",
                               "scheme = { order = 2, interface = \"sharp\" }\n"};

/// A column of water at rest between walls, 1 m high, under 1000 m/s^2.
Scene column(int n, int order, int element) {
  return make_scene("scheme = { order = " + std::to_string(order) + ", interface = \"diffuse\" }\n" +
                        "mesh = \"@box.geo\"\nmesh_parameters = { length = 0.5, n = " + std::to_string(n / 2) +
                        ", element = " + std::to_string(element) + R"( }
end_time = 5e-3
gravity = [0, -1000]
[phase.water]
material = "water"
[[region]]
shape = "everywhere"
fill = "water"
pressure = "1000*1000*(1 - y) + 1e5"
[boundary]
"*" = "wall"
)",
                    ranks());
}

}  // namespace

TEST_CASE("a gas in a periodic box falls freely: uniform, at g t, with the energy of its velocity") {
  const std::string scheme = GENERATE(as<std::string>{}, schemes[0], schemes[1]);
  const int element = GENERATE(3, 4);
  CAPTURE(scheme, element);
  Scene scene = make_scene(
      scheme + "mesh = \"@box.geo\"\nmesh_parameters = { n = 10, element = " + std::to_string(element) + R"( }
end_time = 0.01
gravity = [3e3, -1e4]
[phase.gas]
eos = { type = "ideal_gas", gamma = 1.4 }
density = 1.2
[[region]]
shape = "everywhere"
fill = "gas"
pressure = 1e5
velocity = [10, 20]
[boundary]
left = { type = "periodic", with = "right" }
bottom = { type = "periodic", with = "top" }
)",
      ranks());
  const double energy = total(*scene.solver, "energy.gas");
  scene.run();
  const double u = 10 + 3e3 * 0.01, v = 20 - 1e4 * 0.01;
  const Result result(scene);
  for (std::int32_t cell = 0; cell < result.cells(); ++cell) {
    CHECK(std::fabs(result.mixture.velocity[0][cell] - u) < 1e-11);
    CHECK(std::fabs(result.mixture.velocity[1][cell] - v) < 1e-11);
    CHECK(std::fabs(result.mixture.pressure[cell] - 1e5) < 1e-9);
    CHECK(std::fabs(result.mixture.density[cell] - 1.2) < 1e-12);
  }
  CHECK(total(*scene.solver, "energy.gas") - energy ==
        Approx(0.5 * 1.2 * (u * u + v * v - 10 * 10 - 20 * 20)).epsilon(1e-10));
}

TEST_CASE("a body in a void falls freely: no stress, all of it at g t, as far as g t^2 / 2") {
  const std::string scheme = GENERATE(as<std::string>{}, schemes[0], schemes[1], schemes[2]);
  const std::string mesh =
      GENERATE(as<std::string>{}, "mesh = \"@box.geo\"\nmesh_parameters = { n = 20, element = 3 }\n",
               "mesh = \"@box.geo\"\nmesh_parameters = { n = 20, element = 4 }\n");
  CAPTURE(scheme, mesh);
  Scene scene = make_scene(scheme + mesh + R"(end_time = 1e-3
gravity = [0, -4e5]
[phase.copper]
material = "copper"
[phase.surroundings]
void = { pressure = 0 }
[[region]]
shape = "everywhere"
fill = "surroundings"
[[region]]
shape = "sphere"
center = [0.4, 0.74]
radius = 0.21
fill = "copper"
pressure = 0
velocity = [50, 0]
[boundary]
"*" = "transmissive"
)",
                           ranks());
  const Solver& solver = *scene.solver;
  const double mass = total(solver, "mass.copper"), energy = total(solver, "energy.copper"),
               potential = total(solver, "potential.copper");
  scene.run();
  CHECK(total(solver, "mass.copper") == Approx(mass).epsilon(1e-12));
  CHECK(total(solver, "momentum.copper.y") == Approx(-400 * mass).epsilon(1e-12));
  CHECK(total(solver, "energy.copper") - energy == Approx(0.5 * 400 * 400 * mass).epsilon(1e-11));
  const double fallen = (potential - total(solver, "potential.copper")) / (4e5 * mass);
  INFO("fallen " << fallen << " m");
  CHECK(std::fabs(fallen - 0.2) < 0.02 * 0.05);  // of a cell: mass is counted at the centroids of cells
  const PhaseSnapshot copper = solver.snapshot().phases[0];
  const auto inside = [&](std::int32_t c) { return copper.alpha[c] > 0.1; };
  const Range stress = range(
      scene, [&](std::int32_t c) { return copper.pressure[c]; }, inside);
  const Range v = range(
      scene, [&](std::int32_t c) { return copper.velocity[1][c]; }, inside);
  INFO("pressure " << stress.low << " to " << stress.high << " Pa, velocity " << v.low << " to " << v.high);
  if (scheme == schemes[2] && mesh.find("element = 3") != std::string::npos) return;  // curved, it is not exact unmoved
  CHECK(stress.distance_to(0) < 1e-3);
  CHECK(v.distance_to(-400) < 1e-6);
}

TEST_CASE("two layers of fluid under gravity, each with its own formulas, stay at rest to the order of the mesh") {
  const std::string interface = GENERATE(as<std::string>{}, "diffuse", "sharp");
  CAPTURE(interface);
  std::vector<double> speeds;
  for (const int n : {40, 80}) {
    Scene scene = make_scene(
        "scheme = { interface = \"" + interface +
            "\" }\nmesh = \"@box.geo\"\nmesh_parameters = { length = 0.5, n = " + std::to_string(n / 2) + R"( }
end_time = 5e-3
gravity = [0, -1000]
[phase.water]
material = "water"
[phase.oil]
material = "water"
[[region]]
shape = "everywhere"
fill = "oil"
density = "600 + 200*y"
pressure = "1000*(600*(1 - y) + 100*(1 - y^2)) + 2e5"
[[region]]
shape = "half_space"
point = [0, 0.5]
normal = [0, -1]
fill = "water"
phase.water = { density = "1100 - 200*y", pressure = "1000*(375 + 1100*(0.5 - y) - 100*(0.25 - y^2)) + 2e5" }
[boundary]
"*" = "wall"
)",
        ranks());
    scene.run();
    const Result result(scene);
    speeds.push_back(
        mean(scene, [&](auto c) { return std::hypot(result.mixture.velocity[0][c], result.mixture.velocity[1][c]); }));
  }
  INFO("mean speed " << speeds[0] << ", " << speeds[1] << " m/s");
  CHECK(speeds[1] < 8e-5 * 1000 * 5e-3);  // of what it would have fallen freely
  // beside planes slopes know no neighbour on the other side: 1.67 here, 1.5 from 40 to 80 cells
  CHECK(std::log2(speeds[0] / speeds[1]) > (interface == "sharp" ? 1.4 : 1.7));
}

TEST_CASE("a column of water between walls stays at rest to the order of the scheme") {
  const int order = GENERATE(1, 2);
  const int element = GENERATE(3, 4);
  CAPTURE(order, element);
  std::vector<double> speeds, drifts;
  for (const int n : {20, 40}) {
    Scene scene = column(n, order, element);
    const double energy = total(*scene.solver, "energy.water") + total(*scene.solver, "potential.water");
    scene.run();
    const double drift = total(*scene.solver, "energy.water") + total(*scene.solver, "potential.water") - energy;
    const Result result(scene);
    const double speed =
        mean(scene, [&](auto c) { return std::hypot(result.mixture.velocity[0][c], result.mixture.velocity[1][c]); });
    speeds.push_back(speed);
    drifts.push_back(std::fabs(drift));
  }
  INFO("mean speed " << speeds[0] << ", " << speeds[1] << " m/s; energy drifts by " << drifts[0] << ", " << drifts[1]
                     << " J");
  CHECK(speeds[1] < 2e-3 * 1000 * 5e-3);  // of what it would have fallen freely
  CHECK(std::log2(speeds[0] / speeds[1]) > (order == 1 ? 0.9 : 1.7));
  CHECK(std::log2(drifts[0] / drifts[1]) > (order == 1 ? 0.9 : 1.9));
}
