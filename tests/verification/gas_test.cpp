// Gases and liquids alone, against the exact solution of their Riemann problem.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "gas_riemann.hpp"
#include "measures.hpp"

using namespace cobasis;
using namespace cobasis::test;

namespace {

std::string tube(int n, const std::string& element, double end_time) {
  return first_order +
         fmt::format("mesh = \"@tube.geo\"\nmesh_parameters = {{ n = {}, element = {} }}\nend_time = {}\ncfl = 0.8\n",
                     n, element, end_time);
}
std::string halves(const std::string& phase_l, const Gas& l, const std::string& phase_r, const Gas& r) {
  const auto state = [](const std::string& phase, const Gas& g) {
    return fmt::format("fill = \"{}\"\npressure = {}\nvelocity = [{}, 0.0]\nphase.{} = {{ density = {} }}\n", phase,
                       g.p, g.u, phase, g.rho);
  };
  return "[[region]]\nshape = \"everywhere\"\n" + state(phase_r, r) +
         "[[region]]\nshape = \"half_space\"\npoint = [0.5, 0.0]\nnormal = [-1.0, 0.0]\n" + state(phase_l, l) +
         "[boundary]\nleft = \"transmissive\"\nright = \"transmissive\"\n\"*\" = \"symmetry\"\n";
}

}  // namespace

TEST_CASE("a shock tube in a gas converges to the exact solution") {
  const Gas l{1.4, 0, 1.0, 0, 1e5}, r{1.4, 0, 0.125, 0, 1e4};
  const GasRiemann exact(l, r);
  CHECK(exact.p_star == Approx(30313.0).epsilon(1e-5));  // Toro, table 4.2, test 1
  CHECK(exact.u_star == Approx(0.92745 * std::sqrt(1e5)).epsilon(1e-5));
  const double time = 6e-4;
  const std::string element = GENERATE(as<std::string>{}, "4", "3");
  double coarser = 0;
  for (const int n : {100, 200, 400, 800}) {
    Scene scene = make_scene(tube(n, element, time) + "[phase.gas]\neos = { type = \"ideal_gas\", gamma = 1.4 }\n" +
                                 halves("gas", l, "gas", r),
                             ranks());
    scene.run();
    const Result result(scene);
    const double error = mean(scene, [&](std::int32_t cell) {
      return std::fabs(result.phase("gas").density[cell] - exact.at((result.centre(cell).x - 0.5) / time).rho);
    });
    if (coarser > 0) {
      const double order = std::log2(coarser / error);
      INFO("element " << element << ", " << n << " cells: L1 error of density " << error << ", order " << order);
      CHECK(order > 0.6);
    }
    coarser = error;
  }
  CHECK(coarser < 0.005);
}

namespace {

/// Pressure and velocity on either side of the contact, within 1 %.
void check_contact(const Scene& scene, const GasRiemann& exact,
                   const std::vector<std::pair<double, double>>& plateaus) {
  const Result result(scene);
  for (const auto& [from, to] : plateaus) {
    const auto here = [&, a = from, b = to](std::int32_t cell) {
      const double xi = (result.centre(cell).x - 0.5) / scene.solver->time();
      return xi > a && xi < b;
    };
    const double p = mean(
        scene, [&](auto cell) { return result.mixture.pressure[cell]; }, here);
    const double u = mean(
        scene, [&](auto cell) { return result.mixture.velocity[0][cell]; }, here);
    INFO("between " << from << " and " << to << " m/s: pressure " << p << ", exact " << exact.p_star << "; velocity "
                    << u << ", exact " << exact.u_star);
    CHECK(std::fabs(p / exact.p_star - 1) < 1e-2);
    CHECK(std::fabs(u / exact.u_star - 1) < 1e-2);
  }
}

}  // namespace

// The rarefaction takes the water from 1 GPa to 14 MPa: 1 % of that is 0.014 % of its jump, hence the many cells.
TEST_CASE("a shock tube of water and air reaches the exact pressure and velocity") {
  const Gas water{4.4, 6e8, 1000, 0, 1e9}, air{1.4, 0, 50, 0, 1e5};
  const GasRiemann exact(water, air);
  const std::string element = GENERATE(as<std::string>{}, "4", "3");
  Scene scene =
      make_scene(tube(4000, element, 2e-4) + "[phase.water]\nmaterial = \"water\"\n[phase.air]\nmaterial = \"air\"\n" +
                     halves("water", water, "air", air),
                 ranks());
  scene.run();
  INFO("element " << element << ", contact at " << exact.u_star << " m/s");
  check_contact(scene, exact, {{0, 0.9 * exact.u_star}});
}

TEST_CASE("a shock tube of helium and nitrogen reaches the exact pressure and velocity") {
  const Gas helium{5.0 / 3, 0, 1.6, 0, 1e6}, nitrogen{1.4, 0, 1.165, 0, 1e5};
  const GasRiemann exact(helium, nitrogen);
  const std::string element = GENERATE(as<std::string>{}, "4", "3");
  Scene scene = make_scene(tube(1000, element, 3e-4) +
                               "[phase.helium]\nmaterial = \"helium\"\n[phase.nitrogen]\nmaterial = \"nitrogen\"\n" +
                               halves("helium", helium, "nitrogen", nitrogen),
                           ranks());
  scene.run();
  INFO("element " << element << ", contact at " << exact.u_star << " m/s");
  check_contact(scene, exact, {{0.3 * exact.u_star, 0.9 * exact.u_star}, {1.03 * exact.u_star, 1.1 * exact.u_star}});
}

// With w = 1 / rho - b in the place of 1 / rho the laws of a gas with covolume are those of one without.
TEST_CASE("a shock tube of water with covolume and air reaches the exact pressure, velocity and densities") {
  constexpr double b = 6.61e-4, rho = 1000;
  const Gas water{1.19, 7.028e8, rho / (1 - b * rho), 0, 1e9}, air{1.4, 0, 50, 0, 1e5};
  const GasRiemann exact(water, air);
  Scene scene = make_scene(
      tube(2000, "4", 1.5e-4) +
          "[phase.water]\neos = { type = \"noble_abel_stiffened_gas\", gamma = 1.19, p_inf = 7.028e8, b = 6.61e-4 }\n"
          "[phase.air]\nmaterial = \"air\"\n" +
          halves("water", {1.19, 7.028e8, rho, 0, 1e9}, "air", air),
      ranks());
  scene.run();
  INFO("contact at " << exact.u_star << " m/s");
  check_contact(scene, exact, {{0, 0.9 * exact.u_star}});
  const Result result(scene);
  const double density = mean(
      scene, [&](auto cell) { return result.phase("water").density[cell]; },
      [&](auto cell) {
        const double xi = (result.centre(cell).x - 0.5) / scene.solver->time();
        return xi > 0 && xi < 0.9 * exact.u_star;
      });
  const double expected = 1 / (1 / exact.at(0.5 * exact.u_star).rho + b);
  INFO("density " << density << ", exact " << expected);
  CHECK(std::fabs(density / expected - 1) < 1e-3);
}

TEST_CASE("two blocks of Mie and Grueneisen's copper strike each other: shocks on the line u_s = c0 + s u_p") {
  const int order = GENERATE(1, 2);
  const double u_p = GENERATE(300.0, 2000.0);
  constexpr double rho0 = 8930, c0 = 3940, s = 1.489;
  CAPTURE(order, u_p);
  const double u_s = c0 + s * u_p, time = 0.35 / (u_s - u_p);
  Scene scene =
      make_scene(fmt::format("scheme = {{ order = {}, interface = \"diffuse\" }}\nmesh = \"@tube.geo\"\n"
                             "mesh_parameters = {{ n = 800 }}\nend_time = {}\n[phase.copper]\ndensity = 8930\n"
                             "eos = {{ type = \"mie_gruneisen\", rho0 = 8930, c0 = 3940, s = 1.489, gamma0 = 2.02 }}\n",
                             order, time) +
                     halves("copper", {1, 0, rho0, u_p, 0}, "copper", {1, 0, rho0, -u_p, 0}),
                 ranks());
  scene.run();
  const Result result(scene);
  const auto plateau = [&](double from, double to, const std::vector<double>& field) {
    return mean(
        scene, [&](auto cell) { return field[cell]; },
        [&](auto cell) {
          const double distance = std::fabs(result.centre(cell).x - 0.5);
          return distance > from && distance < to;
        });
  };
  const double p = plateau(0.05, 0.3, result.mixture.pressure), rho = plateau(0.05, 0.3, result.mixture.density);
  INFO("pressure " << p << ", exact " << rho0 * u_s * u_p << "; density " << rho << ", exact "
                   << rho0 * u_s / (u_s - u_p));
  CHECK(p == Approx(rho0 * u_s * u_p).epsilon(1e-4));
  CHECK(rho == Approx(rho0 * u_s / (u_s - u_p)).epsilon(1e-4));
  // where the pressure is half: the shocks
  double low = 1, high = 0;
  for (std::int32_t cell = 0; cell < result.cells(); ++cell)
    if (result.mixture.pressure[cell] > 0.5 * p) {
      low = std::min(low, result.centre(cell).x);
      high = std::max(high, result.centre(cell).x);
    }
  CHECK(high - low == Approx(0.7).epsilon(5e-3));
}
