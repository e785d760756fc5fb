// Solids in contact: three materials at once under impact, and solids that adhere.
#include <catch2/catch.hpp>
#include <cmath>

#include "measures.hpp"

using namespace cobasis;
using namespace cobasis::test;

TEST_CASE("copper strikes aluminium in air on triangles: states stay admissible for 300 steps") {
  Scene scene = make_scene(first_order + R"(mesh = "@box.geo"
mesh_parameters = { n = 60, element = 3 }
end_time = 1
[phase.copper]
material = "copper"
[phase.aluminium]
material = "aluminium"
[phase.air]
material = "air"
[[region]]
shape = "everywhere"
fill = "air"
pressure = 1e5
velocity = [0.0, 0.0]
[[region]]
shape = "box"
low = [0.5, 0.05]
high = [0.8, 0.95]
fill = "aluminium"
pressure = 1e5
velocity = [0.0, 0.0]
[[region]]
shape = "sphere"
center = [0.3, 0.5]
radius = 0.19
fill = "copper"
pressure = 1e5
velocity = [1000.0, 0.0]
[boundary]
"*" = "transmissive"
)",
                           ranks());
  REQUIRE_NOTHROW(scene.run(300));
  CHECK(scene.solver->step() == 300);
  const Result result(scene);
  for (const PhaseSnapshot& phase : result.snapshot.phases) {
    const auto here = [&](std::int32_t cell) { return phase.alpha[cell] > 1e-2; };
    const Range alpha = range(scene, [&](auto cell) { return phase.alpha[cell]; });
    const Range rho = range(
        scene, [&](auto cell) { return phase.density[cell]; }, here);
    const Range p = range(
        scene, [&](auto cell) { return phase.pressure[cell]; }, here);
    const Range u = range(
        scene, [&](auto cell) { return phase.velocity[0][cell]; }, here);
    INFO(phase.name << ": alpha " << alpha.low << " to " << alpha.high << ", density " << rho.low << " to " << rho.high
                    << ", pressure " << p.low << " to " << p.high << ", velocity " << u.low << " to " << u.high);
    CHECK(alpha.low >= 0);
    CHECK(alpha.high <= 1);
    CHECK(rho.low > 0);
    const Eos& eos = scene.setup.phases[&phase - result.snapshot.phases.data()].eos;
    CHECK(p.low > std::visit([](const auto& law) { return law.lowest_pressure(); }, eos));
    CHECK(u.high < 2500);
    if (!phase.is_solid) continue;
    // the deformation follows the density: rho = rho0 det e
    const double drift = mean(
        scene,
        [&](std::int32_t c) {
          const auto& e = phase.cobasis;
          const double det = (e[0][c] * e[4][c] - e[1][c] * e[3][c]) * e[8][c];
          return std::fabs(phase.density[c] / (phase.rho0 * det) - 1);
        },
        here);
    INFO("mean |rho / (rho0 det e) - 1| " << drift);
    CHECK(drift < 0.05);
  }
  const Range contact = range(scene, [&](auto cell) { return result.mixture.pressure[cell]; });
  INFO("largest pressure " << contact.high);
  CHECK(contact.high > 1e8);  // the bodies have met
}

TEST_CASE("two solids that adhere share the shear stress of the acoustic limit") {
  const double z_cu = 2.8615e7, z_al = 8.3785e6;  // rho0 c_T [Pa s/m]
  const double exact = z_cu * z_al / (z_cu + z_al) * 2;
  const auto run = [&](const std::string& contact) {
    Scene scene = make_case("sliding",
                            {set_first_order,
                             {"mesh_parameters", "{ n = 500 }"},
                             {"end_time", "8e-5"},
                             {"contact.default", contact},
                             {"region.0.velocity", "[0.0, -1.0]"},
                             {"region.1.velocity", "[0.0, 1.0]"}},
                            ranks());
    scene.run();
    const Result result(scene);  // shear waves at x = 0.243 and 0.748 m
    return range(
        scene, [&](auto cell) { return std::fabs(result.mixture.stress[3][cell]); },
        [&](auto cell) { return result.centre(cell).x > 0.35 && result.centre(cell).x < 0.65; });
  };
  const Range bonded = run("adherence"), sliding = run("sliding");
  INFO("adhering " << bonded.low << " to " << bonded.high << " Pa, exact " << exact << "; sliding " << sliding.high
                   << " Pa");
  CHECK(bonded.distance_to(exact) < 5e-3 * exact);
  CHECK(sliding.high < 1e-4);
}
