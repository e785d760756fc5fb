// Order of accuracy of waves that are smooth, against exact solutions.
#include <catch2/catch.hpp>
#include <cmath>

#include "physics/material_library.hpp"
#include "smooth_flow.hpp"
#include "smooth_waves.hpp"

using namespace cobasis;
using namespace cobasis::test;

namespace {

Numbers as_numbers(const SmoothState& s) {
  Numbers q{s.velocity.x, s.velocity.y, s.velocity.z};
  std::copy(s.stress.begin(), s.stress.end(), &q[3]);
  q[9] = s.density;
  for (int beta = 0; beta < 3 && s.cobasis; ++beta)
    for (int i = 0; i < 3; ++i) q[10 + 3 * beta + i] = (*s.cobasis)[i][beta];
  return q;
}

/// The wave for a part of its period on three meshes. `reported`: quantities of which nothing is claimed.
void check_order(Cells cells, const std::array<int, 3>& sizes, const std::string& material, const SmoothWave& wave,
                 double periods, const std::vector<Quantity>& claimed, const std::vector<Quantity>& reported = {}) {
  SceneOptions options;
  options.solver.initial_state = [&wave](int, const Point& x) { return wave.at(x, 0).as_phase(); };
  std::vector<Quantity> quantities = claimed;
  quantities.insert(quantities.end(), reported.begin(), reported.end());
  Convergence convergence(quantities);
  for (const int n : sizes) {
    Scene scene = make_scene(periodic_box(cells, n, 2) + "[phase.body]\nmaterial = \"" + material + R"("
[[region]]
shape = "everywhere"
fill = "body"
pressure = 1e5
)",
                             ranks(), options);
    scene.setup.end_time = periods * wave.period;
    scene.run();
    convergence.add(scene, [&](const Point& x) { return as_numbers(wave.at(x, scene.solver->time())); });
  }
  for (std::size_t q = 0; q < claimed.size(); ++q) {
    INFO(convergence.report() << claimed[q].name << ":");
    // transverse waves on tetrahedra reach 1.89 in stress
    CHECK(convergence.order(static_cast<int>(q)) >= (cells == Cells::tetrahedra ? 1.88 : 1.9));
  }
}

SolidMedium aluminium_at_rest() {
  const Material& material = *find_material("aluminium");
  return {*material.elastic, std::get<StiffenedGas>(material.eos), {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, 1e5, {}};
}

SolidMedium moving_sheared_aluminium(bool space) {
  SolidMedium medium = aluminium_at_rest();
  medium.pressure = 2e8;
  medium.velocity = {1000, 500, space ? -300.0 : 0};
  medium.cobasis = space ? Matrix{{{1.01, 0.12, 0}, {0, 0.99, 0.12}, {0.03, 0, 1}}}
                         : Matrix{{{1.01, 0.12, 0}, {0.03, 0.99, 0}, {0, 0, 1.02}}};
  return medium;
}

Point waves_per_side(double x, double y, double z = 0) { return {2 * M_PI * x, 2 * M_PI * y, 2 * M_PI * z}; }

void check_solid_waves(Cells cells, const std::array<int, 3>& sizes, double periods) {
  constexpr double strain = 1e-6;
  const Point wave_vector = in_space(cells) ? waves_per_side(1, 1, 1) : waves_per_side(2, 1);
  SECTION("longitudinal, in aluminium at rest") {
    check_order(cells, sizes, "aluminium",
                solid_wave(aluminium_at_rest(), wave_vector, Polarisation::longitudinal, strain), periods,
                {velocity, stress}, {cobasis_vectors});
  }
  SECTION("transverse, in aluminium that moves and is sheared by 12 %") {  // half as fast: as many steps
    const SolidMedium medium = moving_sheared_aluminium(in_space(cells));
    check_order(cells, sizes, "aluminium", solid_wave(medium, wave_vector, Polarisation::transverse, strain),
                periods / 2, {velocity, stress}, {cobasis_vectors});
  }
}

const GasMedium wind{1.4, 1.19, 1e5, {300, 100, 0}};

}  // namespace

TEST_CASE("small waves in a solid converge with second order on triangles") {
  check_solid_waves(Cells::triangles, {24, 48, 96}, 0.5);
}
TEST_CASE("small waves in a solid converge with second order on quadrilaterals") {
  check_solid_waves(Cells::quadrilaterals, {32, 64, 128}, 0.5);
}
TEST_CASE("small waves in a solid converge with second order on tetrahedra", "[long]") {
  check_solid_waves(Cells::tetrahedra, {8, 16, 32}, 0.15);
}
TEST_CASE("small waves in a solid converge with second order on hexahedra") {
  check_solid_waves(Cells::hexahedra, {8, 16, 32}, 0.25);
}

TEST_CASE("waves of finite amplitude in a gas converge with second order on triangles") {
  SECTION("density, carried along") {
    check_order(Cells::triangles, {24, 48, 96}, "air", density_wave(wind, waves_per_side(2, 1), 0.2), 0.5, {density});
  }
  SECTION("sound of 5 % of its speed") {
    check_order(Cells::triangles, {24, 48, 96}, "air", simple_wave(wind, waves_per_side(2, 1), 0.05), 0.5,
                {velocity, stress, density});
  }
}
