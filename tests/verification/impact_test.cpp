// Section 5.2: copper at 400 m/s strikes aluminium at -200 m/s. A shock into each, normal stress and velocity
// continuous.
#include <catch2/catch.hpp>
#include <cmath>

#include "measures.hpp"

using namespace cobasis;
using namespace cobasis::test;

namespace {

const Changes as_reference{set_first_order, {"cfl", "1.0"}};

Changes hexahedra(const std::string& parameters) {
  return {{"mesh", "\"../meshes/tube_space.geo\""},
          {"mesh_parameters", "{ ny = 1, element = 8, " + parameters + " }"},
          {"boundary.back", "symmetry"},
          {"boundary.front", "symmetry"}};
}

Scene run_impact(const Changes& changes) {
  Scene scene = make_case("impact", as_reference + changes, ranks());
  scene.run();
  return scene;
}

/// Stress and velocity behind the shocks, on either side of the contact and across it.
void check_plateau(const Scene& scene, double tolerance) {
  const Result result(scene);
  const Table exact = read_table("impact.csv");
  const double stress = exact("stress_xx", 0.5), u = exact("velocity", 0.5);
  const auto between = [&](double a, double b) {
    return [&result, a, b](std::int32_t cell) { return result.centre(cell).x > a && result.centre(cell).x < b; };
  };
  const auto stress_xx = [&](std::int32_t cell) { return result.mixture.stress[0][cell]; };
  const auto velocity = [&](std::int32_t cell) { return result.mixture.velocity[0][cell]; };
  for (const auto& [from, to] : {std::pair(0.35, 0.5), std::pair(0.53, 0.72)}) {
    const double plateau_stress = mean(scene, stress_xx, between(from, to));
    const double plateau_u = mean(scene, velocity, between(from, to));
    INFO("between " << from << " and " << to << " m: stress off by " << plateau_stress / stress - 1 << ", velocity by "
                    << plateau_u / u - 1);
    CHECK(std::fabs(plateau_stress / stress - 1) < tolerance);
    CHECK(std::fabs(plateau_u / u - 1) < tolerance);
  }
}

/// Nowhere more stress than exact, no velocity outside the plateau's, no density beyond both sides' at the contact.
void check_no_overshoot(const Scene& scene, double tolerance) {
  const Result result(scene);
  const Table exact = read_table("impact.csv");
  const auto contact = [&](std::int32_t cell) { return std::fabs(result.centre(cell).x - 0.512) < 0.1; };
  const Range stress = range(scene, [&](std::int32_t cell) { return result.mixture.stress[0][cell]; });
  const Range u = range(
      scene, [&](std::int32_t cell) { return result.mixture.velocity[0][cell]; }, contact);
  const Range rho = range(
      scene, [&](std::int32_t cell) { return result.mixture.density[cell]; }, contact);
  INFO("largest stress " << stress.low << " Pa; near the contact velocity " << u.low << " to " << u.high
                         << " m/s, density " << rho.low << " to " << rho.high << " kg/m^3");
  CHECK(stress.low > (1 + tolerance) * exact("stress_xx", 0.5));
  CHECK(u.distance_to(exact("velocity", 0.5)) < tolerance * exact("velocity", 0.5));
  CHECK(rho.high < (1 + tolerance) * exact("density", 0.5));
  CHECK(rho.low > (1 - tolerance) * exact("density", 0.6));
}

}  // namespace

TEST_CASE("an impact reaches the exact stress and velocity within 0.1 %, without overshoot, on 2000 quadrilaterals") {
  const Scene scene = run_impact({{"mesh_parameters", "{ n = 2000, element = 4 }"}});
  check_plateau(scene, 1e-3);
  check_no_overshoot(scene, 1e-3);
}

TEST_CASE("an impact reaches the exact stress and velocity within 0.1 %, without overshoot, on 2000 hexahedra") {
  const Scene scene = run_impact(hexahedra("n = 2000"));
  check_plateau(scene, 1e-3);
  check_no_overshoot(scene, 1e-3);
}

TEST_CASE("an impact reaches the exact stress and velocity within 0.7 % on regular triangles") {
  check_plateau(run_impact({{"mesh_parameters", "{ n = 2000, element = 3 }"}}), 7e-3);
}

TEST_CASE("an impact reaches the exact stress and velocity within 0.7 % on irregular triangles") {
  check_plateau(
      run_impact({{"mesh", "\"../meshes/box.geo\""}, {"mesh_parameters", "{ n = 2000, height = 0.002, element = 3 }"}}),
      7e-3);
}

TEST_CASE("an impact with a sharp contact reaches the exact stress and velocity within 0.2 % on simplices") {
  const int order = GENERATE(1, 2);
  CAPTURE(order);
  const Changes sharp{{"scheme.order", std::to_string(order)}, {"scheme.interface", "\"sharp\""}};
  const Changes tetrahedra{{"mesh", "\"../meshes/tube_space.geo\""},
                           {"mesh_parameters", "{ n = 125, element = 4 }"},
                           {"boundary.back", "symmetry"},
                           {"boundary.front", "symmetry"}};
  check_plateau(run_impact(Changes{{"mesh_parameters", "{ n = 500, element = 3 }"}} + sharp), 2e-3);
  check_plateau(run_impact(Changes{{"mesh", "\"../meshes/box.geo\""},
                                   {"mesh_parameters", "{ n = 250, height = 0.016, element = 3 }"}} +
                           sharp),
                2e-3);
  check_plateau(run_impact(tetrahedra + sharp), 2e-3);
}

TEST_CASE("an impact on 500 cells is as accurate as an independent first-order implementation") {
  const Table exact = read_table("impact.csv"), errors = read_table("impact_errors.csv");
  const bool in_space = GENERATE(false, true);
  CAPTURE(in_space);
  // hexahedra twice as wide as long: CFL 1 is then half a cell per step, as on squares and in the reference
  const Scene scene = run_impact(in_space ? hexahedra("n = 500, width = 0.004")
                                          : Changes{{"mesh_parameters", "{ n = 500, element = 4 }"}});
  const Result result(scene);
  const auto check = [&](const std::string& name, const std::vector<double>& field) {
    const double error =
        mean(scene, [&](std::int32_t cell) { return std::fabs(field[cell] - exact(name, result.centre(cell).x)); });
    INFO(name << ": error " << error << ", " << error / errors(name, 500) << " of the reference");
    CHECK(error < 1.2 * errors(name, 500));
  };
  check("density", result.mixture.density);
  check("velocity", result.mixture.velocity[0]);
  check("pressure", result.mixture.pressure);
  check("stress_xx", result.mixture.stress[0]);
}
