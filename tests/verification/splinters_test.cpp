// Little of a body that is in a cell alone, before a void: nothing acts on it.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "support/scene.hpp"

using namespace cobasis;
using namespace cobasis::test;

namespace {

const std::string rubber_in_void = R"TOML(
end_time = 10
[phase.rubber]
eos = { type = "stiffened_gas", gamma = 4.0, p_inf = 125.0 }
elastic = { mu = 1.0, rho0 = 1.0, a = -1.0 }
[phase.surroundings]
void = { pressure = 0.0 }
[[region]]
shape = "everywhere"
fill = "surroundings"
[boundary]
"*" = "symmetry"
)TOML";

/// A box of rubber without stress that takes `share` of the cells in it; lengths in tenths.
std::string part(double x, double y, double width, double height, double share, const std::string& velocity) {
  return fmt::format(R"TOML(
[[region]]
shape = "box"
low = [{}, {}, -1.0]
high = [{}, {}, 2.0]
alpha.rubber = {}
alpha.surroundings = {}
phase.rubber = {{ pressure = 0.0, velocity = {} }}
)TOML",
                     0.1 * x, 0.1 * y, 0.1 * (x + width), 0.1 * (y + height), share, 1 - share, velocity);
}

/// The largest kinetic energy over the first until `end` [s].
double largest_gain(const std::string& text, double end) {
  Scene scene = make_scene(second_order + text, ranks());
  const double first = total(*scene.solver, "kinetic.rubber");
  double most = 0;
  while (scene.solver->time() < end) {
    scene.solver->advance(end);
    most = std::max(most, total(*scene.solver, "kinetic.rubber"));
  }
  return most / first;
}

}  // namespace

TEST_CASE("a splinter alone in a cell flies on: its pressure does not overshoot") {
  // a box over several triangles with more in them than this may still gain some
  const auto [element, share] =
      GENERATE(table<int, double>({{4, 0.4}, {4, 0.2}, {4, 0.037}, {4, 0.01}, {3, 0.037}, {3, 0.01}}));
  const std::string velocity = GENERATE(as<std::string>{}, "[0.0, -0.1]", "[0.5, 0.1]");
  CAPTURE(element, share, velocity);
  const std::string mesh =
      fmt::format("mesh = \"@box.geo\"\nmesh_parameters = {{ height = 1.0, n = 10, element = {} }}\n", element);
  CHECK(largest_gain(mesh + rubber_in_void + part(4, 6, 1, 1, share, velocity), 0.3) < 1 + 1e-12);
}

TEST_CASE("a splinter behind debris of a body does not burst") {
  const double debris = GENERATE(1e-3, 3e-4, 1e-5), share = GENERATE(0.037, 0.1);
  const std::string velocity = GENERATE(as<std::string>{}, "[0.0, -0.1]", "[0.5, 0.1]", "[1.0, -1.0]");
  CAPTURE(debris, share, velocity);
  const std::string still = "[0.0, 0.0]";
  const std::string scene = "mesh = \"@box.geo\"\nmesh_parameters = { height = 1.0, n = 10 }\n" + rubber_in_void +
                            part(-9, -9, 30, 13, 1, still) + part(3, 4, 4, 1, 0.52, still) +
                            part(4, 5, 1, 1, debris, still) + part(4, 6, 1, 1, share, velocity) +
                            part(4, 7, 1, 1, 1.3 * debris, velocity) + part(3, 6, 1, 1, 2 * debris, velocity);
  CHECK(largest_gain(scene, 0.3) < 1 + 1e-9);
}
