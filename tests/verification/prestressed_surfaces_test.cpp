// Free surfaces of solids at rest, also stretched or compressed along them: in equilibrium, and it should stay so.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "support/scene.hpp"

using namespace cobasis;
using namespace cobasis::test;

namespace {

/// Rubber between the heights `low` and `high` in a void, its length along x `stretch` times the one without stress,
/// free of traction above and below.
std::string block(const std::string& mesh, double low, double high, double stretch, const std::string& velocity) {
  const double along = stretch * stretch, across = 1 / along;
  return second_order + "mesh = " + mesh +
         fmt::format(R"TOML(
end_time = 10
[phase.rubber]
eos = {{ type = "stiffened_gas", gamma = 4.0, p_inf = 125.0 }}
elastic = {{ mu = 1.0, rho0 = 1.0, a = -1.0 }}
[phase.surroundings]
void = {{ pressure = 0.0 }}
[[region]]
shape = "everywhere"
fill = "surroundings"
[[region]]
shape = "box"
low = [-1.0, {}, -1.0]
high = [2.0, {}, 2.0]
fill = "rubber"
phase.rubber = {{ pressure = {}, cobasis = [[{}, 0, 0], [0, {}, 0], [0, 0, 1.0]], velocity = {} }}
[boundary]
"*" = "symmetry"
)TOML",
                     low, high, across - (along + across + 1) / 3, 1 / stretch, stretch, velocity);
}

}  // namespace

TEST_CASE("a body at rest calms down at the default CFL number, whatever part of cells its surface leaves it") {
  const int element = GENERATE(4, 3);
  const double part = GENERATE(0.05, 0.35, 0.5, 0.55, 0.75);
  CAPTURE(element, part);
  const std::string mesh =
      fmt::format("\"@box.geo\"\nmesh_parameters = {{ height = 0.5, n = 16, element = {} }}", element);
  Scene scene =
      make_scene(block(mesh, -1, (5 + part) / 16, 1, R"TOML([0.0, "1e-6*sin(12345*x*x+777*y)"])TOML"), ranks());
  const double before = total(*scene.solver, "kinetic.rubber");
  while (scene.solver->time() < 1) scene.solver->advance(1);  // [s]; shear waves cross the length once
  CHECK(before > 1e-14);
  CHECK(total(*scene.solver, "kinetic.rubber") < 0.1 * before);
}

TEST_CASE("a surface compressed to 0.65 of its length calms down") {
  const auto [mesh, n, space] = GENERATE(table<std::string, int, bool>({
      {"\"@box.geo\"\nmesh_parameters = { height = 0.75, n = 16, element = 4 }", 16, false},
      {"\"@box.geo\"\nmesh_parameters = { height = 0.75, n = 16, element = 3 }", 16, false},
      {"\"@box_space.geo\"\nmesh_parameters = { height = 0.6, width = 0.3, n = 10, element = 8 }", 10, true},
      {"\"@box_space.geo\"\nmesh_parameters = { height = 0.6, width = 0.3, n = 8, element = 4 }", 8, true},
  }));
  CAPTURE(mesh);
  const std::string noise = space ? R"TOML(["1e-6*sin(12345*x*x+777*y+33*z)", "1e-6*cos(1345*x*x+77*y+51*z)", 0])TOML"
                                  : R"TOML(["1e-6*sin(12345*x*x+777*y)", "1e-6*cos(1345*x*x+77*y)"])TOML";
  Scene scene = make_scene(block(mesh, -1, (std::round(0.3 * n) + 0.3) / n, 0.65, noise), ranks());
  const double before = total(*scene.solver, "kinetic.rubber");
  while (scene.solver->time() < 2) scene.solver->advance(2);  // [s]; shear waves cross the length twice
  CHECK(total(*scene.solver, "kinetic.rubber") < 0.1 * before);
}

TEST_CASE(
    "a stretched or compressed body flies through a void, leaves nothing behind and feels no wall before it is there") {
  struct Flight {
    int element;
    double stretch, speed, way, tolerance;
  };
  // corners of triangles let their surfaces enter with errors of round-off, which grow somewhat
  const Flight flight =
      GENERATE(Flight{4, 1.3, 1, 0.28, 1e-10}, Flight{4, 0.9, 1, 0.28, 1e-10}, Flight{4, 0.75, 5, 0.28, 1e-10},
               Flight{3, 1.1, 0.1, 0.2, 1e-6}, Flight{3, 0.9, 0.1, 0.2, 1e-6}, Flight{3, 1.3, 1, 0.28, 1e-6});
  CAPTURE(flight.element, flight.stretch, flight.speed);
  const std::string mesh =
      fmt::format("\"@box.geo\"\nmesh_parameters = {{ height = 0.75, n = 16, element = {} }}", flight.element);
  Scene scene = make_scene(block(mesh, 0.123, 0.423, flight.stretch, fmt::format("[0.0, {}]", flight.speed)), ranks());
  const double end = flight.way / flight.speed;
  while (scene.solver->time() < end) scene.solver->advance(end);
  const Phase& rubber = scene.solver->fields().phases[0];
  double off = 0;
  for (std::int32_t cell = 0; cell < scene.mesh.n_owned; ++cell)
    if (rubber.alpha[cell] > 1e-6)
      off = std::max({off, std::fabs(rubber.primitive[1][cell]), std::fabs(rubber.primitive[2][cell] - flight.speed)});
  CHECK(ranks().max(off) < flight.tolerance * flight.speed);
  double behind = 0;  // volume in rows that the lower surface has passed
  for (std::int32_t cell = 0; cell < scene.mesh.n_owned; ++cell)
    if (scene.mesh.centroid[cell].y < 0.123 + flight.way - 1.0 / 16) behind += rubber.alpha[cell];
  CHECK(ranks().max(behind) < 1e-11);
}
