// Order of accuracy of axisymmetric waves that are smooth, against exact solutions: standing waves in a cylinder of
// radius 1 m in a frictionless tube, periodic along the axis.
#include <catch2/catch.hpp>
#include <cmath>

#include "physics/material_library.hpp"
#include "smooth_flow.hpp"

using namespace cobasis;
using namespace cobasis::test;

namespace {

/// Displacement amplitude * sin(omega t) times the gradient of J0(k r) cos(m x) (compression), or the curl of
/// J1(k r) sin(m x) around the axis (shear). J1(k) = 0: the wall sees neither normal displacement nor shear stress.
/// Exact in linear elasticity, whose moduli the material has at p = 1e5 Pa.
struct StandingWave {
  double m, bulk, mu, density;
  bool shear = false;
  static constexpr double k = 7.0155866698156188, amplitude = 1e-7;

  double length() const { return m == 0 ? 0.5 : 1; }
  double omega() const { return std::sqrt((shear ? mu : bulk + 4 * mu / 3) / density * (k * k + m * m)); }

  Numbers at(const Point& x, double time) const {
    const double r = x.y, j0 = std::cyl_bessel_j(0, k * r), j1 = std::cyl_bessel_j(1, k * r),
                 slope = k * j0 - j1 / r,  // d/dr J1(k r)
        c = std::cos(m * x.x), s = std::sin(m * x.x);
    const double along = shear ? k * j0 * s : -m * j0 * s, across = shear ? -m * j1 * c : -k * j1 * c;
    const double xx = shear ? k * m * j0 * c : -m * m * j0 * c, rr = shear ? -m * slope * c : -k * slope * c,
                 hoop = shear ? -m * j1 / r * c : -k * j1 / r * c,
                 xr = shear ? 0.5 * (m * m - k * k) * j1 * s : k * m * j1 * s;
    const double rate = amplitude * omega() * std::cos(omega() * time), size = amplitude * std::sin(omega() * time);
    const double pressure = 1e5 - size * (bulk - 2 * mu / 3) * (xx + rr + hoop);
    Numbers q{rate * along, rate * across};
    q[3] = 2 * mu * size * xx - pressure;
    q[4] = 2 * mu * size * rr - pressure;
    q[5] = 2 * mu * size * hoop - pressure;
    q[6] = 2 * mu * size * xr;
    return q;
  }
};

/// The mean distance of velocity and stress from the exact ones, over the mean size of what the wave changes; stress by
/// the impedance, so that an error of the wave's phase counts alike at any time.
double error(const Scene& scene, const StandingWave& wave) {
  const std::vector<Numbers> computed = numbers(scene);
  const double impedance = wave.density * wave.omega() / std::hypot(wave.k, wave.m);
  double error = 0, size = 0;
  for (std::int32_t i = 0; i < scene.mesh.n_owned; ++i) {
    const Numbers q = wave.at(scene.mesh.centroid[i], scene.solver->time());
    double error2 = 0, size2 = 0;
    for (int c = 0; c < 9; ++c) {
      const double scale = c < 3 ? 1 : 1 / impedance, rest = c >= 3 && c < 6 ? -1e5 : 0;
      error2 += std::pow(scale * (computed[i][c] - q[c]), 2);
      size2 += std::pow(scale * (q[c] - rest), 2);
    }
    error += scene.mesh.volume[i] * std::sqrt(error2);
    size += scene.mesh.volume[i] * std::sqrt(size2);
  }
  return error / size;
}

void check_order(const StandingWave& wave, const std::string& material, const std::string& element) {
  const auto sizes = element == "3" ? std::array{24, 48, 96} : std::array{32, 64, 128};  // cells along the radius
  std::array<double, 3> errors{};
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    SceneOptions options;
    options.solver.initial_state = [&wave](int, const Point& x) {
      const Numbers q = wave.at(x, 0);
      PhaseState state;
      state.pressure = 1e5;
      state.velocity = {q[0], q[1], 0.0};
      return state;
    };
    Scene scene = make_scene("scene = \"axisymmetric\"\nmesh = \"@box.geo\"\nmesh_parameters = { n = " +
                                 std::to_string(std::lround(sizes[i] * wave.length())) +
                                 ", length = " + std::to_string(wave.length()) + ", element = " + element +
                                 " }\nend_time = 1\n" + "[phase.body]\nmaterial = \"" + material + R"("
[[region]]
shape = "everywhere"
fill = "body"
pressure = 1e5
[boundary]
bottom = "axis"
top = "wall"
left = { type = "periodic", with = "right" }
)",
                             ranks(), options);
    scene.setup.end_time = 1.15 * 2 * M_PI / wave.omega();
    scene.run();
    errors[i] = error(scene, wave);
  }
  const double order = std::log(errors[1] / errors[2]) / std::log(static_cast<double>(sizes[2]) / sizes[1]);
  INFO("errors " << errors[0] << ", " << errors[1] << ", " << errors[2] << ", order " << order);
  CHECK(order >= 1.9);
}

StandingWave in_aluminium(double m, bool shear) {
  const Material& material = *find_material("aluminium");
  const auto& eos = std::get<StiffenedGas>(material.eos);
  return {m, eos.gamma * (1e5 + eos.p_inf), material.elastic->mu, material.elastic->rho0, shear};
}

void check_sound(const std::string& element) {
  const double m = GENERATE(0.0, 2 * M_PI);
  CAPTURE(m);
  SECTION("in a gas") { check_order({m, 1.4e5, 0, find_material("air")->rho0}, "air", element); }
  SECTION("in a rod") { check_order(in_aluminium(m, false), "aluminium", element); }
}

}  // namespace

TEST_CASE("sound in a cylinder converges with second order on quadrilaterals") { check_sound("4"); }
TEST_CASE("sound in a cylinder converges with second order on triangles") { check_sound("3"); }

TEST_CASE("shear waves in a rod converge with second order on quadrilaterals and triangles") {
  const std::string element = GENERATE("4", "3");
  CAPTURE(element);
  check_order(in_aluminium(2 * M_PI, true), "aluminium", element);
}
