#include "solver/relaxation.hpp"

#include <algorithm>
#include <cmath>

#include "solver/cell_energy.hpp"

namespace cobasis {
namespace {

/// Traces of gas in a body under tension would fill what it leaves to them at next to no density, and as such go on to
/// the next cell, thinner by a thousand each time. They do not relax.
constexpr double most_expansion = 10;

/// Where f changes its sign between a and b, by regula falsi in the variant of Illinois.
template <class F>
double root(const F& f, double a, double b) {
  double f_a = f(a), f_b = f(b);
  for (int i = 0; i < 200 && f_a != 0 && f_b != 0; ++i) {
    double x = i % 5 == 4 ? 0.5 * (a + b) : (a * f_b - b * f_a) / (f_b - f_a);
    if (!(x > std::min(a, b) && x < std::max(a, b))) x = 0.5 * (a + b);
    if (x == a || x == b || std::fabs(b - a) <= 1e-15 * std::max(std::fabs(a), std::fabs(b))) return x;
    const double f_x = f(x);
    if ((f_x < 0) != (f_b < 0)) {
      a = b, f_a = f_b;
    } else {
      f_a *= 0.5;
    }
    b = x, f_b = f_x;
  }
  return f_a == 0 ? a : b;
}

/// A phase in a cell, on the path on which its volume changes at the constant outer pressure p_I.
struct Volume {
  const Eos& eos;
  double alpha, mass, e_h;

  Volume(const Fields& fields, const Phase& phase, std::int32_t cell)
      : eos(phase.eos),
        alpha(phase.alpha[cell]),
        mass(phase.conserved[0][cell]),
        e_h(internal_energy(fields, phase, cell) - stored_energy(fields, phase, cell)) {}

  double pressure(double filled, double p_I) const {
    return std::visit([&](const auto& law) { return law.pressure(mass / filled, e_h - p_I * (filled - alpha) / mass); },
                      eos);
  }
  bool admissible(double filled, double p_I) const {
    const auto [lowest, densest] =
        std::visit([](const auto& law) { return std::pair(law.lowest_pressure(), law.densest()); }, eos);
    return mass / filled < densest && pressure(filled, p_I) > lowest;
  }
  /// The volume fraction at which its own pressure is p_I too; `most`, if that is less than it.
  double filled_at(double p_I, double most) const {
    return std::visit(
        [&](const auto& law) {
          const auto excess = [&](double filled) {  // grows with the volume
            return mass * (law.energy(mass / filled, p_I) - e_h) + p_I * (filled - alpha);
          };
          if (p_I <= law.lowest_pressure() || excess(most) < 0) return most;
          return root(excess, std::max(1e-9 * alpha, (1 + 1e-12) * mass / law.densest()), most);
        },
        eos);
  }
};

void relax_velocities(Fields& fields, Phase& l, Phase& m, std::int32_t cell, double drag, double dt) {
  const double m_l = l.conserved[0][cell], m_m = m.conserved[0][cell];
  const double lost = -std::expm1(-drag * (l.alpha[cell] * m.alpha[cell]) * (1 / m_l + 1 / m_m) * dt);
  double work = 0;
  for (int d = 1; d <= fields.dimension; ++d) {
    double &of_l = l.conserved[d][cell], &of_m = m.conserved[d][cell];
    const double common = (of_l + of_m) / (m_l + m_m);
    const double change = lost * (m_l * m_m / (m_l + m_m)) * (of_m / m_m - of_l / m_l);
    of_l += change, of_m -= change;
    work += change * common;
  }
  l.conserved[1 + fields.dimension][cell] += work;
  m.conserved[1 + fields.dimension][cell] -= work;
}

/// The volume fraction of l after the time dt, from the one where it comes to rest. What is left of the difference
/// decays as exp(-k t), k from the middle of substeps in which it hardly changes.
double filled_after(const Volume& l, const Volume& m, double rest, double p_I, double rate, double dt) {
  const double sum = l.alpha + m.alpha;
  const auto k = [&](double filled) {
    const double difference = l.pressure(filled, p_I) - m.pressure(sum - filled, p_I);
    return rate * filled * (sum - filled) * difference / (rest - filled);
  };
  double filled = l.alpha, left = dt;
  while (left > 0 && std::fabs(rest - filled) > 1e-12 * std::fabs(rest - l.alpha)) {
    const double first = k(filled);
    if (!(first > 0)) break;
    double step = std::min(left, 0.5 / first), middle;
    for (;; step *= 0.5) {
      middle = k(rest - (rest - filled) * std::exp(-0.5 * first * step));
      if (!(std::fabs(middle - first) * step > 0.02) || step < 1e-9 * dt) break;
    }
    const double next = rest - (rest - filled) * std::exp(-middle * step);
    if (next == filled) break;  // k is round-off, and may ask for 1e14 substeps more
    filled = next;
    left -= step;
  }
  return filled;
}

void relax_pressures(Fields& fields, Phase& l, Phase& m, std::int32_t cell, double rate, double dt) {
  const Volume of_l(fields, l, cell), of_m(fields, m, cell);
  if (!of_l.admissible(of_l.alpha, 0) || !of_m.admissible(of_m.alpha, 0)) return;
  const double p_l = of_l.pressure(of_l.alpha, 0), p_m = of_m.pressure(of_m.alpha, 0), sum = of_l.alpha + of_m.alpha;
  if (p_l == p_m) return;
  const double p_I =
      root([&](double p) { return of_l.filled_at(p, 2 * sum) + of_m.filled_at(p, 2 * sum) - sum; }, p_l, p_m);
  const bool l_is_less = of_l.alpha < of_m.alpha;  // whose volume is known to more digits
  double filled = l_is_less ? of_l.filled_at(p_I, 2 * sum) : sum - of_m.filled_at(p_I, 2 * sum);
  if (!std::isinf(rate)) filled = filled_after(of_l, of_m, filled, p_I, rate, dt);
  if (!(filled > 0 && filled < most_expansion * of_l.alpha)) return;
  if (!(filled < sum && sum - filled < most_expansion * of_m.alpha)) return;
  if (!of_l.admissible(filled, p_I) || !of_m.admissible(sum - filled, p_I)) return;
  const double work = p_I * (filled - of_l.alpha);
  l.conserved[1 + fields.dimension][cell] -= work;
  m.conserved[1 + fields.dimension][cell] += work;
  resize(fields, l, cell, filled);
  resize(fields, m, cell, sum - filled);
  fields.complete(cell);
}

}  // namespace

void relax(Fields& fields, const RelaxedPair& pair, std::int32_t cell, double dt) {
  Phase &l = fields.phases[pair.l], &m = fields.phases[pair.m];
  if (!(l.alpha[cell] > 0 && m.alpha[cell] > 0 && l.conserved[0][cell] > 0 && m.conserved[0][cell] > 0)) return;
  if (pair.rates.velocity > 0) relax_velocities(fields, l, m, cell, pair.rates.velocity, dt);
  if (pair.rates.pressure > 0) relax_pressures(fields, l, m, cell, pair.rates.pressure, dt);
}

}  // namespace cobasis
