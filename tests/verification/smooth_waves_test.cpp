// The exact solutions that orders of accuracy are measured against satisfy the equations, by central differences.
#include <catch2/catch.hpp>
#include <cmath>

#include "physics/material_library.hpp"
#include "smooth_waves.hpp"

using namespace cobasis;
using namespace cobasis::test;

namespace {

std::array<std::array<double, 3>, 3> stress_of(const SmoothState& s) {
  const auto& t = s.stress;
  return {{{t[0], t[3], t[5]}, {t[3], t[1], t[4]}, {t[5], t[4], t[2]}}};
}

/// Densities and fluxes of mass, momentum and energy, a row each.
std::vector<std::array<double, 4>> balances(const SmoothState& s, double internal_energy) {
  const double u[] = {s.velocity.x, s.velocity.y, s.velocity.z};
  const auto sigma = stress_of(s);
  const double E = s.density * 0.5 * dot(s.velocity, s.velocity) + internal_energy;
  std::vector<std::array<double, 4>> rows(5);
  rows[0][0] = s.density, rows[4][0] = E;
  for (int j = 0; j < 3; ++j) {
    rows[0][1 + j] = s.density * u[j];
    rows[4][1 + j] = E * u[j];
    for (int i = 0; i < 3; ++i) {
      rows[1 + i][0] = s.density * u[i];
      rows[1 + i][1 + j] = s.density * u[i] * u[j] - sigma[i][j];
      rows[4][1 + j] -= sigma[i][j] * u[i];
    }
  }
  return rows;
}

Point step(int i, double dx) { return {i == 0 ? dx : 0, i == 1 ? dx : 0, i == 2 ? dx : 0}; }

/// The largest residual of a balance, over the largest of its terms.
template <class Energy>
double residual_of_balances(const SmoothWave& wave, const Point& x, double t, double dx, const Energy& energy) {
  const double dt = 3e-4 * wave.period;
  const auto rows = [&](const Point& at, double time) {
    const SmoothState s = wave.at(at, time);
    return balances(s, energy(s));
  };
  const auto later = rows(x, t + dt), earlier = rows(x, t - dt);
  double worst = 0;
  for (int law = 0; law < 5; ++law) {
    double sum = (later[law][0] - earlier[law][0]) / (2 * dt), largest = std::fabs(sum);
    for (int j = 0; j < 3; ++j) {
      const double term = (rows(x + step(j, dx), t)[law][1 + j] - rows(x - step(j, dx), t)[law][1 + j]) / (2 * dx);
      sum += term;
      largest = std::max(largest, std::fabs(term));
    }
    if (largest > 0) worst = std::max(worst, std::fabs(sum) / largest);
  }
  return worst;
}

/// The same of d/dt e_i + u_j d_j e_i + e_j d_i u_j = 0 for the three e.
double residual_of_cobasis(const SmoothWave& wave, const Point& x, double t, double dx) {
  const double dt = 3e-4 * wave.period;
  const SmoothState here = wave.at(x, t), later = wave.at(x, t + dt), earlier = wave.at(x, t - dt);
  const auto component = [](const Point& u, int j) { return j == 0 ? u.x : j == 1 ? u.y : u.z; };
  double worst = 0, largest = 0;
  for (int beta = 0; beta < 3; ++beta)
    for (int i = 0; i < 3; ++i) {
      double sum = ((*later.cobasis)[i][beta] - (*earlier.cobasis)[i][beta]) / (2 * dt);
      largest = std::max(largest, std::fabs(sum));
      for (int j = 0; j < 3; ++j) {
        const SmoothState after = wave.at(x + step(j, dx), t), before = wave.at(x - step(j, dx), t);
        sum += component(here.velocity, j) * ((*after.cobasis)[i][beta] - (*before.cobasis)[i][beta]) / (2 * dx);
        const SmoothState up = wave.at(x + step(i, dx), t), down = wave.at(x - step(i, dx), t);
        sum += (*here.cobasis)[j][beta] * (component(up.velocity, j) - component(down.velocity, j)) / (2 * dx);
      }
      worst = std::max(worst, std::fabs(sum));
    }
  return worst / largest;
}

}  // namespace

// Differences over 6e-4 wavelengths err by (3e-4 2 pi)^2 / 6, 6e-7 of a term; the linear theory by the
// strain, times the few powers in which it enters.
TEST_CASE("the small waves in a solid satisfy the equations up to the square of their strain") {
  const Polarisation polarisation = GENERATE(Polarisation::longitudinal, Polarisation::transverse);
  CAPTURE(static_cast<int>(polarisation));
  const Material& material = *find_material("aluminium");
  const SolidMedium medium{*material.elastic,
                           std::get<StiffenedGas>(material.eos),
                           {{{1.01, 0.12, 0}, {0, 0.99, 0.12}, {0.03, 0, 1}}},
                           2e8,
                           {1000, 500, -300}};
  const Point wave_vector{2 * M_PI, 4 * M_PI, -2 * M_PI};
  const SmoothWave wave = solid_wave(medium, wave_vector, polarisation, 1e-6);
  const auto energy = [&](const SmoothState& s) {
    const Matrix& e = *s.cobasis;
    const Cobasis<Space, double> columns{
        {e[0][0], e[1][0], e[2][0]}, {e[0][1], e[1][1], e[2][1]}, {e[0][2], e[1][2], e[2][2]}};
    return s.density *
           (medium.eos.energy(s.density, s.pressure) + elastic_energy(medium.solid, normalised_metric(columns)));
  };
  const double dx = 3e-4 * 2 * M_PI / std::sqrt(dot(wave_vector, wave_vector));
  const Point x{0.31, 0.17, 0.59};
  const double balance = residual_of_balances(wave, x, 0.3 * wave.period, dx, energy),
               cobasis = residual_of_cobasis(wave, x, 0.3 * wave.period, dx);
  INFO("relative residuals: " << balance << " of mass, momentum, energy; " << cobasis << " of the cobasis");
  CHECK(balance < 5e-5);
  CHECK(cobasis < 5e-5);
}

TEST_CASE("small waves in an undeformed solid run at the speeds of linear elasticity") {
  const Material& material = *find_material("aluminium");
  const auto& solid = *material.elastic;
  const auto& eos = std::get<StiffenedGas>(material.eos);
  const SolidMedium medium{solid, eos, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, 1e5, {}};
  const auto speed = [&](Polarisation p) { return solid_wave(medium, {1, 2, 3}, p, 1e-6).speed; };
  const double bulk = eos.gamma * (1e5 + eos.p_inf);
  CHECK(speed(Polarisation::longitudinal) == Approx(std::sqrt((bulk + 4 * solid.mu / 3) / solid.rho0)).epsilon(1e-8));
  CHECK(speed(Polarisation::transverse) == Approx(std::sqrt(solid.mu / solid.rho0)).epsilon(1e-8));
}

TEST_CASE("the waves of finite amplitude in a gas satisfy the equations") {
  const GasMedium medium{1.4, 1.19, 1e5, {300, 100, 50}};
  const Point wave_vector{2 * M_PI, 4 * M_PI, -2 * M_PI};
  const bool simple = GENERATE(true, false);
  CAPTURE(simple);
  const SmoothWave wave = simple ? simple_wave(medium, wave_vector, 0.05) : density_wave(medium, wave_vector, 0.2);
  const double dx = 3e-4 * 2 * M_PI / std::sqrt(dot(wave_vector, wave_vector));
  const double balance = residual_of_balances(wave, {0.31, 0.17, 0.59}, 0.5 * wave.period, dx,
                                              [&](const SmoothState& s) { return s.pressure / (medium.gamma - 1); });
  INFO("relative residual " << balance);
  CHECK(balance < 5e-5);
}
