// Section 5.1: a front between aluminium and air, density ratio 2700, in uniform flow at 400 m/s.
#include <catch2/catch.hpp>
#include <cmath>

#include "measures.hpp"

using namespace cobasis;
using namespace cobasis::test;

namespace {

/// The case to its end, 0.5 ms. Phases are looked at where they fill more than `visible` of a cell; `noise`: how much
/// more of round-off may be seen than where interfaces are diffuse.
Scene run_advection(const Changes& changes, double visible = 0, double noise = 1) {
  Scene scene = make_case("advection", Changes{set_first_order} + changes, ranks());
  const double mass_al = balance(*scene.solver, "mass.aluminium"), mass_air = balance(*scene.solver, "mass.air");
  const std::vector<PhaseState>& states = scene.setup.regions[0].filling.states;
  const double u[3] = {states[0].velocity[0].constant(), states[0].velocity[1].constant(),
                       states[0].velocity[2].constant()};
  scene.run();
  CHECK(scene.solver->time() == 0.5e-3);
  const Result result(scene);
  for (const PhaseSnapshot& phase : result.snapshot.phases) {
    const auto here = [&](std::int32_t cell) { return phase.alpha[cell] > visible; };
    const Range p = range(
        scene, [&](std::int32_t cell) { return phase.pressure[cell]; }, here);
    const double dp = p.distance_to(1e5);
    double du = 0;
    for (int i = 0; i < 3; ++i)
      du = std::max(du, range(
                            scene, [&](std::int32_t c) { return phase.velocity[i][c]; }, here)
                            .distance_to(u[i]));
    INFO(phase.name << ": pressure off by " << dp << " Pa, velocity by " << du << " m/s");
    CHECK(dp < noise * (phase.is_solid ? 20.0 : 1e5 * 1e-9));
    CHECK(du < noise * 400 * 1e-9);
  }
  const double gained_al = balance(*scene.solver, "mass.aluminium") / mass_al - 1;
  const double gained_air = balance(*scene.solver, "mass.air") / mass_air - 1;
  INFO("mass gained: aluminium " << gained_al << ", air " << gained_air << " of itself");
  CHECK(std::fabs(gained_al) < 1e-12);
  CHECK(std::fabs(gained_air) < 1e-12);
  return scene;
}

/// The front has moved by 0.2 m: as much aluminium has come in through the left end.
void check_front(const Scene& scene) {
  const double front = total(*scene.solver, "volume.aluminium") /
                       (total(*scene.solver, "volume.aluminium") + total(*scene.solver, "volume.air"));
  INFO("front off by " << front - 0.7 << " m");
  CHECK(std::fabs(front - 0.7) < 1e-9);
}

Changes tube(int n, int element) {
  return {{"mesh_parameters", "{ n = " + std::to_string(n) + ", element = " + std::to_string(element) + " }"}};
}
Changes tube_space(int n, int element) {
  return Changes{
             {"mesh", "\"../meshes/tube_space.geo\""}, {"boundary.back", "symmetry"}, {"boundary.front", "symmetry"}} +
         tube(n, element);
}
/// The front at 30 degrees to a square, or to a slice of a cube, and moving along its own normal.
Changes oblique(const Changes& mesh) {
  return mesh + Changes{{"boundary", "{ \"*\" = \"transmissive\" }"},
                        {"region.1.point", "[0.4, 0.4]"},
                        {"region.1.normal", "[-0.8660254037844386, -0.5]"},
                        {"region.0.velocity", "[346.41016151377545, 200.0]"},
                        {"region.1.velocity", "[346.41016151377545, 200.0]"}};
}
Changes box(const std::string& file, const std::string& parameters) {
  return {{"mesh", "\"../meshes/" + file + "\""}, {"mesh_parameters", parameters}};
}

/// Sharp interfaces. In a volume of 1e-6 of a cell round-off of the cell is a million times as large; where an
/// interface has passed less may be left, and on its way through tetrahedra it comes to every size.
constexpr double dust = 1e-6, noise_of_tetrahedra = 10;
Changes sharp(int order) { return {{"scheme.order", std::to_string(order)}, {"scheme.interface", "\"sharp\""}}; }

/// From 1 % to 99 % of aluminium, along the front's normal, in cells of size h.
void check_width(const Scene& scene, const Point& n, double h) {
  const Result result(scene);
  const PhaseSnapshot& al = result.phase("aluminium");
  double first = 1e30, last = -1e30;
  for (std::int32_t i = 0; i < result.cells(); ++i) {
    if (al.alpha[i] < 0.01 || al.alpha[i] > 0.99) continue;
    const double x = dot(n, result.centre(i));
    first = std::min(first, x), last = std::max(last, x);
  }
  INFO("the front is " << (last - first) / h + 1 << " cells wide");
  CHECK((last - first) / h + 1 < 4);
}

}  // namespace

TEST_CASE("pressure and velocity stay uniform across a front carried along 1000 quadrilaterals") {
  check_front(run_advection(tube(1000, 4)));
}
TEST_CASE("pressure and velocity stay uniform across a front carried along 1000 cells of triangles") {
  check_front(run_advection(tube(1000, 3)));
}
TEST_CASE("pressure and velocity stay uniform across a front carried along 100 hexahedra") {
  check_front(run_advection(tube_space(100, 8)));
}
TEST_CASE("pressure and velocity stay uniform across a front carried along 100 cells of tetrahedra") {
  check_front(run_advection(tube_space(100, 4)));
}
TEST_CASE("pressure and velocity stay uniform across a front at 30 degrees to quadrilaterals") {
  run_advection(oblique(box("box.geo", "{ n = 80, element = 4 }")));
}
TEST_CASE("pressure and velocity stay uniform across a front at 30 degrees to a square of triangles") {
  run_advection(oblique(box("box.geo", "{ n = 50, element = 3 }")));
}
TEST_CASE("pressure and velocity stay uniform across a front at 30 degrees to hexahedra") {
  run_advection(oblique(box("box_space.geo", "{ n = 40, width = 0.05, element = 8 }")));
}
TEST_CASE("pressure and velocity stay uniform across a front at 30 degrees to a slice of tetrahedra") {
  run_advection(oblique(box("box_space.geo", "{ n = 24, width = 0.1, element = 4 }")));
}
TEST_CASE("pressure and velocity stay uniform across a front with traces of 1e-5, where a phase fills 1 % of a cell") {
  const Changes traces{{"alpha_min", "1e-5"}};
  run_advection(tube(1000, 4) + traces, 1e-2);
  run_advection(oblique(box("box.geo", "{ n = 40, element = 3 }")) + traces, 1e-2);
}

TEST_CASE("pressure and velocity stay uniform across a sharp front on cells of every type") {
  const int order = GENERATE(1, 2);
  const int element = GENERATE(3, 4);
  CAPTURE(order, element);
  for (const bool in_space : {false, true}) {
    const int n = in_space ? 100 : 250, type = in_space && element == 3 ? 4 : in_space ? 8 : element;
    const Scene scene = run_advection((in_space ? tube_space(n, type) : tube(n, type)) + sharp(order), dust);
    check_front(scene);
    check_width(scene, {1, 0, 0}, 1.0 / n);
  }
}
TEST_CASE("pressure and velocity stay uniform across a sharp front on triangles and tetrahedra without a limiter") {
  const Changes unlimited{{"scheme.limiter", "\"none\""}};
  check_front(run_advection(tube(250, 3) + sharp(2) + unlimited, dust));
  check_front(run_advection(tube_space(100, 4) + sharp(2) + unlimited, dust));
}
TEST_CASE("pressure and velocity stay uniform across a sharp front at 30 degrees to a square of any cells") {
  const int order = GENERATE(1, 2), element = GENERATE(3, 4);
  CAPTURE(order, element);
  const Scene scene = run_advection(
      oblique(box("box.geo", "{ n = 50, element = " + std::to_string(element) + " }")) + sharp(order), dust);
  check_width(scene, {std::sqrt(0.75), 0.5, 0}, 1.0 / 50);
}
TEST_CASE("pressure and velocity stay uniform across a sharp front at 30 degrees to a slice of tetrahedra", "[long]") {
  const int order = GENERATE(1, 2);
  CAPTURE(order);
  const Scene scene = run_advection(
      oblique(box("box_space.geo", "{ n = 24, width = 0.1, element = 4 }")) + sharp(order), dust, noise_of_tetrahedra);
  check_width(scene, {std::sqrt(0.75), 0.5, 0}, 1.0 / 24);
}
