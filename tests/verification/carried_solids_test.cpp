// Solids in equilibrium with what surrounds them, carried along: nothing changes but where they are.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "measures.hpp"

using namespace cobasis;
using namespace cobasis::test;

namespace {

/// A ball of turned and compressed aluminium, stress -p I, and a half space of copper like it, in `around`.
Scene carried(bool space, const std::string& around, double pressure, const std::string& velocity) {
  const double c = 1.02 * std::cos(0.5), s = 1.02 * std::sin(0.5);
  const std::string cobasis =
      fmt::format("{{ cobasis = [[{0}, {1}, 0.0], [-{1}, {0}, 0.0], [0.0, 0.0, 1.02]] }}", c, s);
  const std::string state = fmt::format("pressure = {}\nvelocity = {}\n", pressure, velocity);
  return make_scene(
      first_order +
          (space ? "mesh = \"@box_space.geo\"\nmesh_parameters = { n = 10, element = 4 }\n"
                 : "mesh = \"@box.geo\"\nmesh_parameters = { n = 32, element = 3 }\n") +
          fmt::format(R"(end_time = 1
[phase.aluminium]
material = "aluminium"
[phase.copper]
material = "copper"
{}
[[region]]
shape = "everywhere"
fill = "around"
{}[[region]]
shape = "half_space"
point = [0.7, 0.5]
normal = [0.96, 0.28]
fill = "copper"
phase.copper = {}
{}[[region]]
shape = "sphere"
center = [0.3, 0.4, 0.5]
radius = 0.21
fill = "aluminium"
phase.aluminium = {}
{}[boundary]
"*" = "transmissive"
)",
                      around, around.find("void") == std::string::npos ? state : "", cobasis, state, cobasis, state),
      ranks());
}

void check_uniform(Scene& scene, double pressure, const double (&velocity)[3], int steps) {
  scene.run(steps);
  CHECK(scene.solver->step() == steps);
  const double c = 1.02 * std::cos(0.5), s = 1.02 * std::sin(0.5);
  const double cobasis[9] = {c, -s, 0, s, c, 0, 0, 0, 1.02};  // e^1, e^2, e^3
  const Result result(scene);
  for (const PhaseSnapshot& phase : result.snapshot.phases) {
    if (phase.is_void) continue;
    const auto here = [&](std::int32_t cell) { return phase.alpha[cell] > 0; };
    const double dp = range(
                          scene, [&](auto cell) { return phase.pressure[cell]; }, here)
                          .distance_to(pressure);
    double du = 0, de = 0, shear = 0;
    for (int i = 0; i < scene.mesh.dimension; ++i)
      du = std::max(du, range(
                            scene, [&](auto cell) { return phase.velocity[i][cell]; }, here)
                            .distance_to(velocity[i]));
    for (int i = 0; i < 9 && phase.is_solid; ++i)
      de = std::max(de, range(
                            scene, [&](auto cell) { return phase.cobasis[i][cell]; }, here)
                            .distance_to(cobasis[i]));
    for (int i = 3; i < 6; ++i)
      shear = std::max(shear, range(
                                  scene, [&](auto cell) { return phase.stress[i][cell]; }, here)
                                  .distance_to(0));
    INFO(phase.name << ": pressure off by " << dp << " Pa, velocity by " << du << " m/s, cobasis by " << de
                    << ", shear stress " << shear << " Pa");
    CHECK(dp < (phase.is_solid ? 20.0 : 1e-9 * pressure));
    CHECK(du < 1e-6);
    CHECK(de < 1e-12);
    CHECK(shear < 20);
  }
}

}  // namespace

TEST_CASE("turned and compressed solids carried through a gas keep their cobasis wherever they go") {
  const bool space = GENERATE(false, true);
  const std::string air = "[phase.around]\nmaterial = \"air\"\n";
  SECTION("slower than sound in the gas") {
    Scene scene = carried(space, air, 1e5, space ? "[-150.0, 120.0, 60.0]" : "[-150.0, 120.0]");
    check_uniform(scene, 1e5, {-150, 120, 60}, 400);
  }
  SECTION("faster than sound in the gas") {
    Scene scene = carried(space, air, 1e5, space ? "[700.0, -500.0, 100.0]" : "[700.0, -500.0]");
    check_uniform(scene, 1e5, {700, -500, 100}, 200);
  }
}

TEST_CASE("solids at the pressure of the void around them stay as they are wherever they go") {
  const bool space = GENERATE(false, true);
  Scene scene = carried(space, "[phase.around]\nvoid = { pressure = 3e9 }\n", 3e9,
                        space ? "[700.0, -500.0, 100.0]" : "[700.0, -500.0]");
  check_uniform(scene, 3e9, {700, -500, 100}, 200);
}

TEST_CASE("two solids that touch fly through a void with sharp interfaces as one would, corners and edges included") {
  const auto [mesh, space] = GENERATE(table<std::string, bool>({
      {"\"@box.geo\"\nmesh_parameters = { n = 40, element = 3 }", false},
      {"\"@box.geo\"\nmesh_parameters = { n = 40, element = 4 }", false},
      {"\"@box_space.geo\"\nmesh_parameters = { n = 12, element = 8 }", true},
  }));
  CAPTURE(mesh);
  const auto box = [&, in_space = space](const std::string& fill, double left, double right) {
    const auto point = [&](double x, double y, double z) {
      return in_space ? fmt::format("[{}, {}, {}]", x, y, z) : fmt::format("[{}, {}]", x, y);
    };
    return fmt::format(
        "[[region]]\nshape = \"box\"\nlow = {}\nhigh = {}\nfill = \"{}\"\npressure = 1e5\nvelocity = {}\n",
        point(left, 0.2, 0.2), point(right, 0.55, 0.6), fill, point(300, 200, 100));
  };
  Scene scene = make_scene("mesh = " + mesh + R"(
end_time = 0.3e-3
scheme = { interface = "sharp" }
[phase.copper]
material = "copper"
[phase.aluminium]
material = "aluminium"
[phase.around]
void = { pressure = 1e5 }
[[region]]
shape = "everywhere"
fill = "around"
)" + box("aluminium", 0.2, 0.45) +
                               box("copper", 0.45, 0.6) + "[boundary]\n\"*\" = \"transmissive\"\n",
                           ranks());
  scene.run();
  const Result result(scene);
  for (const PhaseSnapshot& phase : result.snapshot.phases) {
    if (phase.is_void) continue;
    const auto here = [&](std::int32_t cell) { return phase.alpha[cell] > 0.1; };
    CAPTURE(phase.name);
    CHECK(range(
              scene, [&](auto cell) { return phase.pressure[cell]; }, here)
              .distance_to(1e5) < 20);
    CHECK(range(
              scene, [&](auto cell) { return phase.velocity[0][cell]; }, here)
              .distance_to(300) < 1e-5);
  }
}

TEST_CASE("a bubble that is nothing beside the tension of a stretched solid does not tear it") {
  const auto [mesh, velocity] = GENERATE(table<std::string, std::string>(
      {{"\"@box.geo\"\nmesh_parameters = { n = 16, element = 3 }", "[100.0, 50.0]"},
       {"\"@box_space.geo\"\nmesh_parameters = { n = 8, element = 4 }", "[100.0, 50.0, 20.0]"}}));
  CAPTURE(mesh);
  const std::string copper = "pressure = -5e9\nvelocity = " + velocity + "\n",
                    bubble = "{ pressure = 1e5, velocity = " + velocity + " }\n";
  Scene scene = make_scene("mesh = " + mesh + R"(
end_time = 2e-4
scheme = { interface = "sharp" }
[phase.copper]
material = "copper"
[phase.air]
material = "air"
[[region]]
shape = "everywhere"
fill = "copper"
)" + copper + R"([[region]]
shape = "sphere"
center = [0.4, 0.4, 0.4]
radius = 0.1
alpha = { copper = 0.999999999, air = 1e-9 }
)" + copper + "phase.air = " + bubble +
                               R"([boundary]
"*" = "transmissive"
)",
                           ranks());
  const double air = total(*scene.solver, "mass.air");
  scene.run();
  CHECK(total(*scene.solver, "volume.air") == 0);
  CHECK(total(*scene.solver, "mass.air") == Approx(air).epsilon(1e-12));
  const Result result(scene);
  for (const PhaseSnapshot& phase : result.snapshot.phases)
    if (phase.is_solid)
      CHECK(range(
                scene, [&](auto cell) { return phase.pressure[cell]; }, [](auto) { return true; })
                .distance_to(-5e9) < 1e-4 * 5e9);
}
