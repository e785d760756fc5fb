#include "smooth_waves.hpp"

#include <cmath>

namespace cobasis::test {
namespace {

double length(const Point& x) { return std::sqrt(dot(x, x)); }
Point unit(const Point& x) { return (1 / length(x)) * x; }

Cobasis<Space, double> columns(const Matrix& e) {
  return {{e[0][0], e[1][0], e[2][0]}, {e[0][1], e[1][1], e[2][1]}, {e[0][2], e[1][2], e[2][2]}};
}

/// The state of the medium after a displacement with gradient h U n, at unchanged entropy.
SmoothState strained(const SolidMedium& m, double h, const Point& U, const Point& n) {
  const double U_[] = {U.x, U.y, U.z}, n_[] = {n.x, n.y, n.z};
  const Matrix& e0 = m.cobasis;
  Matrix e = e0;  // (I + h U n)^-T e0
  for (int beta = 0; beta < 3; ++beta) {
    const double along = U_[0] * e0[0][beta] + U_[1] * e0[1][beta] + U_[2] * e0[2][beta];
    for (int i = 0; i < 3; ++i) e[i][beta] -= n_[i] * along * h / (1 + h * dot(U, n));
  }
  SmoothState state;
  const double compression = 1 / (1 + h * dot(U, n));
  state.cobasis = e;
  state.density = m.solid.rho0 * determinant(columns(e));
  state.pressure = (m.pressure + m.eos.p_inf) * std::pow(compression, m.eos.gamma) - m.eos.p_inf;
  const Symmetric<Space, double> S = deviatoric_stress(m.solid, state.density, normalised_metric(columns(e)));
  state.stress = {S.xx - state.pressure, S.yy - state.pressure, S.zz - state.pressure, S.xy, S.yz, S.xz};
  return state;
}

Point traction(const std::array<double, 6>& s, const Point& n) {
  return {s[0] * n.x + s[3] * n.y + s[5] * n.z, s[3] * n.x + s[1] * n.y + s[4] * n.z,
          s[5] * n.x + s[4] * n.y + s[2] * n.z};
}

/// The acoustic tensor on U: the change of the traction on n by a displacement gradient U n, per size of the gradient.
Point acoustic(const SolidMedium& medium, const Point& U, const Point& n) {
  constexpr double h = 1e-5;
  return (0.5 / h) * (traction(strained(medium, h, U, n).stress, n) - traction(strained(medium, -h, U, n).stress, n));
}

}  // namespace

PhaseState SmoothState::as_phase() const {
  PhaseState state;
  state.density = density;
  state.pressure = pressure;
  state.velocity = {velocity.x, velocity.y, velocity.z};
  state.cobasis = cobasis;
  return state;
}

SmoothWave solid_wave(const SolidMedium& medium, const Point& wave_vector, Polarisation polarisation, double strain) {
  const Point n = unit(wave_vector);
  const auto largest = [](Point U, const auto& tensor) {  // the tensor is symmetric and positive
    for (int i = 0; i < 1000; ++i) U = unit(tensor(U));
    return U;
  };
  Point U = largest(n, [&](const Point& V) { return acoustic(medium, V, n); });
  if (polarisation == Polarisation::transverse) {
    const Point fast = U;
    const auto across = [&](const Point& V) { return V - dot(V, fast) * fast; };
    const Point start = n.z == 0 ? Point{-n.y, n.x, 0} : Point{n.z, n.x, n.y};
    U = largest(across(start), [&](const Point& V) { return across(acoustic(medium, V, n)); });
  }
  const double rho = strained(medium, 0, U, n).density;
  const double c = std::sqrt(dot(U, acoustic(medium, U, n)) / rho);  // rho c^2 U = Q U
  return {.at =
              [=](const Point& x, double time) {
                const double phase = dot(wave_vector, x - time * medium.velocity) - length(wave_vector) * c * time;
                const double h = strain * std::cos(phase);
                SmoothState state = strained(medium, h, U, n);
                state.velocity = medium.velocity - (c * h) * U;
                return state;
              },
          .speed = c,
          .period = 2 * M_PI / (length(wave_vector) * c)};
}

SmoothWave density_wave(const GasMedium& medium, const Point& wave_vector, double amplitude) {
  const double speed = std::fabs(dot(medium.velocity, unit(wave_vector)));
  return {.at =
              [=](const Point& x, double time) {
                const double phase = dot(wave_vector, x - time * medium.velocity);
                SmoothState state;
                state.density = medium.density * (1 + amplitude * std::sin(phase));
                state.pressure = medium.pressure;
                state.velocity = medium.velocity;
                state.stress = {-state.pressure, -state.pressure, -state.pressure};
                return state;
              },
          .speed = 0,
          .period = 2 * M_PI / (length(wave_vector) * speed)};
}

SmoothWave simple_wave(const GasMedium& medium, const Point& wave_vector, double amplitude) {
  const double k = length(wave_vector), gamma = medium.gamma;
  const double c0 = std::sqrt(gamma * medium.pressure / medium.density);
  return {.at =
              [=](const Point& x, double time) {
                const double phase = dot(wave_vector, x - time * medium.velocity);
                double w = 0;  // w = amplitude c0 sin(phase - k (c0 + (gamma + 1)/2 w) t)
                for (int i = 0; i < 100; ++i)
                  w = amplitude * c0 * std::sin(phase - k * (c0 + (gamma + 1) / 2 * w) * time);
                const double c = c0 + (gamma - 1) / 2 * w;
                SmoothState state;
                state.density = medium.density * std::pow(c / c0, 2 / (gamma - 1));
                state.pressure = medium.pressure * std::pow(c / c0, 2 * gamma / (gamma - 1));
                state.velocity = medium.velocity + w * unit(wave_vector);
                state.stress = {-state.pressure, -state.pressure, -state.pressure};
                return state;
              },
          .speed = c0,
          .period = 2 * M_PI / (k * c0)};
}

}  // namespace cobasis::test
