// Uniform states stay uniform: the test of consistency that everything else rests on.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "support/scene.hpp"

using namespace cobasis;
using namespace cobasis::test;

TEST_CASE("a uniform, moving, 12 % pre-sheared solid keeps its velocity and cobasis for 100 steps on any mesh") {
  const Mpi& mpi = ranks();
  const std::string scheme = GENERATE(first_order, second_order);
  const std::string mesh =
      GENERATE(as<std::string>{}, "mesh = \"@box.geo\"\nmesh_parameters = { n = 20, element = 3 }\n",
               "mesh = \"@box_space.geo\"\nmesh_parameters = { n = 8, element = 4 }\n",
               "mesh = \"@box_space.geo\"\nmesh_parameters = { n = 9, element = 0 }\n");
  CAPTURE(scheme, mesh);
  const bool space = mesh.find("space") != std::string::npos;
  const std::string cobasis = space ? "[[1.01, 0.12, 0.0], [0.0, 0.99, 0.12], [0.03, 0.0, 1.0]]"
                                    : "[[1.01, 0.12, 0.0], [0.03, 0.99, 0.0], [0.0, 0.0, 1.02]]";
  Scene scene = make_scene(scheme + mesh + R"(
end_time = 1
[phase.aluminium]
material = "aluminium"
[[region]]
shape = "everywhere"
fill = "aluminium"
pressure = 2e8
velocity = )" + (space ? "[100.0, 50.0, -30.0]" : "[100.0, 50.0]") +
                               "\nphase.aluminium = { cobasis = " + cobasis + R"( }
[boundary]
"*" = "transmissive"
)",
                           mpi);
  const std::vector<std::vector<double>> before = state_by_global_cell(scene, mpi);
  scene.run(100);
  CHECK(scene.solver->step() == 100);
  const std::vector<std::vector<double>> after = state_by_global_cell(scene, mpi);
  REQUIRE(after.size() > 100);
  const int D = scene.mesh.dimension;
  double du = 0, de = 0;
  for (std::size_t cell = 0; cell < after.size(); ++cell) {
    for (int i = 1; i <= D; ++i)
      du = std::max(du, std::fabs(after[cell][i] / after[cell][0] - before[cell][i] / before[cell][0]));
    for (std::size_t i = D + 2; i < after[cell].size(); ++i)
      de = std::max(de, std::fabs(after[cell][i] - before[cell][i]));
  }
  INFO("velocity changed by " << du << " m/s, cobasis by " << de);
  CHECK(du < 1e-9);  // [m/s]
  CHECK(de < 1e-13);
}
