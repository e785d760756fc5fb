#include "gas_riemann.hpp"

#include <algorithm>
#include <cmath>

namespace cobasis::test {
namespace {

/// Velocity that a gas loses across its wave to the pressure p.
double velocity_change(const Gas& g, double p) {
  const double P = p + g.p_inf, P_0 = g.p + g.p_inf;
  if (p > g.p) return (p - g.p) * std::sqrt(2 / (g.rho * ((g.gamma + 1) * P + (g.gamma - 1) * P_0)));
  return 2 * g.sound_speed() / (g.gamma - 1) * (std::pow(P / P_0, (g.gamma - 1) / (2 * g.gamma)) - 1);
}

/// For a wave that runs to the left.
GasRiemann::State behind_left_wave(const Gas& g, double p_star, double u_star, double xi) {
  const double P = p_star + g.p_inf, P_0 = g.p + g.p_inf, c = g.sound_speed(), k = (g.gamma - 1) / (g.gamma + 1);
  if (p_star > g.p) {
    const double speed = g.u - c * std::sqrt((g.gamma + 1) / (2 * g.gamma) * (P / P_0 - 1) + 1);
    if (xi < speed) return {g.rho, g.u, g.p};
    return {g.rho * (P / P_0 + k) / (k * P / P_0 + 1), u_star, p_star};
  }
  const double c_star = c * std::pow(P / P_0, (g.gamma - 1) / (2 * g.gamma));
  if (xi < g.u - c) return {g.rho, g.u, g.p};
  if (xi > u_star - c_star) return {g.rho * std::pow(P / P_0, 1 / g.gamma), u_star, p_star};
  const double c_fan = 2 / (g.gamma + 1) * c + k * (g.u - xi);
  return {g.rho * std::pow(c_fan / c, 2 / (g.gamma - 1)), xi + c_fan,
          P_0 * std::pow(c_fan / c, 2 * g.gamma / (g.gamma - 1)) - g.p_inf};
}

}  // namespace

double Gas::sound_speed() const { return std::sqrt(gamma * (p + p_inf) / rho); }

GasRiemann::GasRiemann(const Gas& left, const Gas& right) : l(left), r(right) {
  double low = -std::min(l.p_inf, r.p_inf), high = 1e3 * (std::max(l.p, r.p) + std::min(l.p_inf, r.p_inf) + 1);
  for (int i = 0; i < 200; ++i) {  // the sum grows with p
    const double middle = 0.5 * (low + high);
    (velocity_change(l, middle) + velocity_change(r, middle) < l.u - r.u ? low : high) = middle;
  }
  p_star = 0.5 * (low + high);
  u_star = 0.5 * (l.u - velocity_change(l, p_star) + r.u + velocity_change(r, p_star));
}

GasRiemann::State GasRiemann::at(double xi) const {
  if (xi < u_star) return behind_left_wave(l, p_star, u_star, xi);
  Gas mirrored = r;
  mirrored.u = -r.u;
  State state = behind_left_wave(mirrored, p_star, -u_star, -xi);
  state.u = -state.u;
  return state;
}

GasRiemann::Interval GasRiemann::star_region() const {
  const auto edge = [&](double outside) {
    double inside = u_star;
    for (int i = 0; i < 200; ++i) {
      const double middle = 0.5 * (inside + outside);
      (at(middle).p == p_star ? inside : outside) = middle;
    }
    return inside;
  };
  const double reach = std::fabs(l.u) + std::fabs(r.u) + std::fabs(u_star) + l.sound_speed() + r.sound_speed();
  return {edge(u_star - 10 * reach), edge(u_star + 10 * reach)};
}

}  // namespace cobasis::test
