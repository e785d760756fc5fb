// Section 5.3: two halves of one block of aluminium move past each other at 1000 m/s.
#include <catch2/catch.hpp>
#include <cmath>

#include "measures.hpp"

using namespace cobasis;
using namespace cobasis::test;

namespace {

void check_errors(int n) {
  Scene scene = make_case(
      "shear", {set_first_order, {"cfl", "1.0"}, {"mesh_parameters", "{ n = " + std::to_string(n) + " }"}}, ranks());
  scene.run();
  const Result result(scene);
  const Table exact = read_table("shear.csv"), errors = read_table("shear_errors.csv");
  const auto check = [&](const std::string& name, const std::vector<double>& field) {
    const double error =
        mean(scene, [&](std::int32_t cell) { return std::fabs(field[cell] - exact(name, result.centre(cell).x)); });
    INFO(n << " cells, " << name << ": error " << error << ", " << error / errors(name, n) << " of the reference");
    CHECK(error < 1.2 * errors(name, n));
  };
  check("tangential_velocity", result.mixture.velocity[1]);
  check("pressure", result.mixture.pressure);
  check("stress_xy", result.mixture.stress[3]);
}

}  // namespace

TEST_CASE("the shear test is as accurate as an independent first-order implementation on 500 and 1000 cells") {
  check_errors(500);
  check_errors(1000);
}
TEST_CASE("the shear test is as accurate as an independent first-order implementation on 2000 cells") {
  check_errors(2000);
}

TEST_CASE("the waves of the shear test are the same whichever tangent carries the slip") {
  const auto run = [](const std::string& v, const std::string& minus_v) {
    Scene scene = make_case("shear",
                            {set_first_order,
                             {"mesh", "\"../meshes/tube_space.geo\""},
                             {"mesh_parameters", "{ n = 100, ny = 1 }"},
                             {"boundary.back", "{ type = \"periodic\", with = \"front\" }"},
                             {"region.0.velocity", minus_v},
                             {"region.1.velocity", v}},
                            ranks());
    advance_by(scene, 2e-7, 200);  // the same steps: the fastest |u_n| + c is not the same
    return scene;
  };
  const Scene along_y = run("[0, 500, 0]", "[0, -500, 0]"), oblique = run("[0, 300, 400]", "[0, -300, -400]");
  const Result y(along_y), yz(oblique);
  double largest = 0;
  for (std::int32_t cell = 0; cell < y.cells(); ++cell) {
    const double v = std::hypot(yz.mixture.velocity[1][cell], yz.mixture.velocity[2][cell]);
    largest = std::max(largest, std::fabs(v - std::fabs(y.mixture.velocity[1][cell])) / 500);
    largest = std::max(largest, std::fabs(yz.mixture.pressure[cell] - y.mixture.pressure[cell]) / 1e9);
  }
  INFO("relative difference " << largest);
  CHECK(largest < 1e-12);
}
