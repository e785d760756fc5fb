// Boundaries that drive what is inside: pistons, outlets, walls to which solids are bonded.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "gas_riemann.hpp"
#include "measures.hpp"

using namespace cobasis;
using namespace cobasis::test;

namespace {

const std::string gas = "[phase.gas]\neos = { type = \"ideal_gas\", gamma = 1.4 }\ndensity = 1.0\n";

Scene tube(int order, int n, const std::string& element, double end_time, const std::string& phase,
           const std::string& region, const std::string& boundaries) {
  return make_scene(fmt::format("scheme = {{ order = {}, interface = \"diffuse\" }}\nmesh = \"@tube.geo\"\n"
                                "mesh_parameters = {{ n = {}, element = {} }}\nend_time = {}\n{}[[region]]\n"
                                "shape = \"everywhere\"\n{}[boundary]\n"
                                "bottom = {{ type = \"periodic\", with = \"top\" }}\n{}",
                                order, n, element, end_time, phase, region, boundaries),
                    ranks());
}

/// L1 distance of pressure from p(x), over `scale`.
double error_of_pressure(const Scene& scene, double scale, const std::function<double(double)>& p) {
  const Result result(scene);
  return mean(scene, [&](auto c) { return std::fabs(result.mixture.pressure[c] - p(result.centre(c).x)); }) / scale;
}

}  // namespace

TEST_CASE("a piston drives the exact shock into a gas, and the exact rarefaction when it withdraws") {
  const int order = GENERATE(1, 2);
  const std::string element = GENERATE(as<std::string>{}, "3", "4");
  const double speed = GENERATE(400.0, -200.0), time = 1e-3;
  CAPTURE(order, element, speed);
  // the piston is the plane of symmetry between two gases that meet, or part, at twice its speed, seen moving with it
  const GasRiemann exact(Gas{1.4, 0, 1.0, 2 * speed, 1e5}, Gas{1.4, 0, 1.0, 0, 1e5});
  REQUIRE(exact.u_star == Approx(speed));
  Scene scene =
      tube(order, 400, element, time, gas, "fill = \"gas\"\npressure = 1e5\n",
           fmt::format("left = {{ type = \"wall\", velocity = [{}, 7] }}\nright = \"transmissive\"\n", speed));
  scene.run();
  const double error = error_of_pressure(scene, std::fabs(exact.p_star - 1e5),
                                         [&](double x) { return exact.at(std::max(x / time, speed)).p; });
  // what was in the tube before, without the few cells in which the wave began
  const double from = speed > 0 ? 1.1 * speed * time : 0.02, to = speed > 0 ? 0.6 : 0.12;
  const Result result(scene);
  const auto plateau = [&](const std::vector<double>& field) {
    return mean(
        scene, [&](auto c) { return field[c]; },
        [&](auto c) { return result.centre(c).x > from && result.centre(c).x < to; });
  };
  const double p = plateau(result.mixture.pressure), rho = plateau(result.mixture.density),
               u = plateau(result.mixture.velocity[0]), rho_star = exact.at(speed > 0 ? 1.1 * speed : 0).rho;
  INFO("error of pressure " << error << "; at the piston " << p << " Pa, exact " << exact.p_star << "; density " << rho
                            << ", exact " << rho_star << "; velocity " << u);
  // a shock that starts in one cell settles slowly
  const double tolerance = speed > 0 ? 5e-3 : order == 1 ? 4e-3 : 1e-4;
  CHECK(error < (speed > 0 ? 0.012 : order == 1 ? 0.01 : 2e-3));
  CHECK(std::fabs(p / exact.p_star - 1) < tolerance);
  CHECK(std::fabs(rho / rho_star - 1) < tolerance);
  CHECK(std::fabs(u - speed) < tolerance * std::fabs(speed));
}

TEST_CASE("a tube that opens to a lower pressure empties through the exact rarefaction, also faster than sound") {
  const int order = GENERATE(1, 2);
  const double outside = GENERATE(5e4, 1e3);
  const double time = 1e-3;
  CAPTURE(order, outside);
  // a gas of no inertia behind the opening
  const Gas inside{1.4, 0, 1.0, 0, 1e5};
  const double c = inside.sound_speed(), sonic = 1e5 * std::pow(2 / 2.4, 7);
  const double p_out = std::max(outside, sonic);
  const auto exact = [&](double x) {
    const double xi = (x - 1) / time;
    if (xi < -c) return 1e5;
    const double c_fan = 2 / 2.4 * c - 0.4 / 2.4 * xi;  // u - c = xi, u + 5 c = 5 c_0
    return std::max(p_out, 1e5 * std::pow(c_fan / c, 7));
  };
  Scene scene = tube(order, 400, "4", time, gas, "fill = \"gas\"\npressure = 1e5\n",
                     fmt::format("left = \"wall\"\nright = {{ type = \"outlet\", pressure = {} }}\n", outside));
  scene.run();
  const double error = error_of_pressure(scene, 1e5 - p_out, exact);
  INFO("error of pressure " << error);
  CHECK(error < (order == 1 ? 0.012 : 0.002));
}

TEST_CASE("at an outlet with its own pressure nothing begins to move") {
  Scene scene = tube(2, 50, "3", 1e-3, gas, "fill = \"gas\"\npressure = 1e5\n",
                     "left = { type = \"outlet\", pressure = 1e5 }\nright = { type = \"outlet\", pressure = 1e5 }\n");
  scene.run(100);
  const Result result(scene);
  CHECK(range(scene, [&](auto c) { return result.mixture.velocity[0][c]; }).distance_to(0) < 1e-10);
  CHECK(total(*scene.solver, "outflow.left.mass.gas") == Approx(0).margin(1e-15));
}

TEST_CASE("a wall that moves along a bonded solid sends the exact shear wave into it, a frictionless one nothing") {
  const int order = GENERATE(1, 2);
  const bool bonded = GENERATE(true, false);
  CAPTURE(order, bonded);
  const double time = 1e-4, speed = 1, rho = 8900, c = std::sqrt(92e9 / rho);
  Scene scene =
      tube(order, 400, "4", time, "[phase.copper]\nmaterial = \"copper\"\n", "fill = \"copper\"\npressure = 0\n",
           fmt::format("left = {{ type = \"{}\", velocity = [0, {}] }}\nright = \"no_slip\"\n",
                       bonded ? "no_slip" : "wall", speed));
  scene.run();
  const Result result(scene);
  const auto behind = [&](std::int32_t cell) { return result.centre(cell).x < 0.6 * c * time; };
  const Range tau = range(
      scene, [&](auto cell) { return result.mixture.stress[3][cell]; }, behind);
  const Range v = range(
      scene, [&](auto cell) { return result.mixture.velocity[1][cell]; }, behind);
  const double exact = bonded ? -rho * c * speed : 0;
  const double front = mean(scene, [&](auto cell) { return result.mixture.velocity[1][cell]; });
  INFO("shear stress " << tau.low << " to " << tau.high << " Pa, exact " << exact << "; velocity " << v.low << " to "
                       << v.high << "; travelled " << front << ", exact " << c * time * speed);
  if (!bonded) {
    CHECK(tau.distance_to(0) == 0);
    CHECK(v.distance_to(0) == 0);
    return;
  }
  CHECK(tau.distance_to(exact) < 1e-3 * std::fabs(exact));
  CHECK(v.distance_to(speed) < 1e-3 * speed);
  CHECK(front == Approx(c * time * speed).epsilon(2e-3));
}

TEST_CASE("a bonded wall at rest holds a solid that slides past it and passes nothing but shear") {
  Scene scene = make_scene(second_order + R"(mesh = "@box.geo"
mesh_parameters = { n = 20, element = 3 }
end_time = 1e-4
[phase.copper]
material = "copper"
[[region]]
shape = "everywhere"
fill = "copper"
pressure = 1e5
velocity = ["30*y", "-10*x"]
[boundary]
"*" = "no_slip"
)",
                           ranks());
  const double energy = total(*scene.solver, "energy.copper");
  scene.run();
  CHECK(total(*scene.solver, "energy.copper") == Approx(energy).epsilon(1e-13));
  for (const char* group : {"left", "right", "bottom", "top"}) {
    CHECK(total(*scene.solver, std::string("outflow.") + group + ".mass.copper") == 0);
    CHECK(total(*scene.solver, std::string("outflow.") + group + ".energy.copper") == Approx(0).margin(1e-16 * energy));
  }
  CHECK(std::fabs(total(*scene.solver, "outflow.bottom.momentum.copper.x")) > 1);
}

TEST_CASE("a wall that moves at no speed is a wall at rest, before any phases in any geometry") {
  const auto run = [](const std::string& mesh, const std::string& outside, const std::string& wall) {
    Scene scene = make_scene("scheme = { order = 1, interface = \"sharp\" }\n" + mesh + R"(end_time = 1
[phase.copper]
material = "copper"
)" + outside + R"([[region]]
shape = "everywhere"
fill = "outside"
pressure = 1e5
[[region]]
shape = "half_space"
point = [0.5, 0.4, 0.0]
normal = [0.1, -1.0, 0.0]
fill = "copper"
pressure = 1e5
velocity = ["20*x", "-30*x"]
[boundary]
"*" = )" + wall + "\n",
                             ranks());
    scene.run(40);
    return scene;
  };
  const std::string gas_outside = "[phase.outside]\nmaterial = \"air\"\n",
                    void_outside = "[phase.outside]\nvoid = { pressure = 1e5 }\n";
  const std::string plane = "mesh = \"@box.geo\"\nmesh_parameters = { n = 14, element = 3 }\n",
                    space = "mesh = \"@box_space.geo\"\nmesh_parameters = { n = 6 }\n";
  for (const auto& [mesh, outside] : {std::pair(plane, gas_outside), std::pair(space, void_outside)}) {
    CAPTURE(mesh);
    const Scene moving = run(mesh, outside, "{ type = \"wall\", velocity = [0, 0] }"),
                at_rest = run(mesh, outside, "\"wall\"");
    const double difference = largest_difference(moving, at_rest);
    INFO("largest difference " << difference);
    CHECK(difference < 1e-10);
  }
}

TEST_CASE("a solid that opens to a lower pressure is released by the exact linear wave") {
  constexpr double rho = 8900, time = 5e-5, pressure = 1e6;
  const double c = std::sqrt((4.2 * (pressure + 34.2e9) + 4.0 / 3 * 92e9) / rho);
  Scene scene =
      tube(2, 200, "4", time, "[phase.copper]\nmaterial = \"copper\"\n", "fill = \"copper\"\npressure = 1e6\n",
           "left = { type = \"outlet\", pressure = 0 }\nright = \"wall\"\n");
  scene.run();
  const Result result(scene);
  const auto behind = [&](std::int32_t cell) { return result.centre(cell).x < 0.7 * c * time; };
  const Range u = range(
      scene, [&](auto cell) { return result.mixture.velocity[0][cell]; }, behind);
  const Range stress = range(
      scene, [&](auto cell) { return result.mixture.stress[0][cell]; }, behind);
  INFO("velocity " << u.low << " to " << u.high << ", exact " << -pressure / (rho * c) << " m/s; stress " << stress.low
                   << " to " << stress.high << " Pa");
  CHECK(u.distance_to(-pressure / (rho * c)) < 2e-3 * pressure / (rho * c));
  CHECK(stress.distance_to(0) < 2e-3 * pressure);
}
