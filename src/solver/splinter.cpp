#include "solver/splinter.hpp"

#include <algorithm>
#include <cmath>

#include "physics/smooth_flow.hpp"
#include "solver/cell_energy.hpp"

namespace cobasis {
namespace {

/// v' [m^3/kg] with e(1 / v', p0) = e^h - p0 (v' - v), by bisection: e(v, p0) + p0 v grows with v.
double volume_at(const Eos& eos, double e_h, double v, double p0) {
  const double enthalpy = e_h + p0 * v;
  const auto excess = [&](double volume) {
    return std::visit([&](const auto& law) { return law.energy(1 / volume, p0); }, eos) + p0 * volume - enthalpy;
  };
  const double densest = std::visit([](const auto& law) { return law.densest(); }, eos);
  double low = std::max(1e-6 * v, (1 + 1e-9) / densest), high = 1e6 * v;
  if (!(excess(low) < 0 && excess(high) > 0)) return 0;
  while (high - low > 1e-14 * high) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (excess(middle) < 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

bool relax_to_void(Fields& fields, int k, int void_phase, std::int32_t cell, double tolerance) {
  Phase& phase = fields.phases[k];
  Phase& around = fields.phases[void_phase];
  const double mass = phase.conserved[0][cell], alpha = phase.alpha[cell];
  if (!(mass > 0) || !(alpha > 0)) return false;
  const double e_h = internal_energy(fields, phase, cell);
  const double v = alpha / mass, p0 = around.void_pressure;
  double volume = 0;
  bool deformed = false;
  if (phase.kind == Kind::solid) {
    const double stored = stored_energy(fields, phase, cell);
    deformed = stored < e_h;
    if (deformed) volume = volume_at(phase.eos, e_h - stored, v, p0);
  }
  if (!(volume > 0)) {
    deformed = false;
    volume = volume_at(phase.eos, e_h, v, p0);
  }
  const double filled = mass * volume;
  if (!(volume > 0) || filled > alpha + around.alpha[cell] || std::fabs(filled - alpha) < tolerance * alpha)
    return false;

  phase.conserved[1 + fields.dimension][cell] -= p0 * (filled - alpha);
  phase.alpha[cell] = filled;
  if (phase.kind == Kind::solid) {
    const int first = fields.first_cobasis(), n = phase.n_conserved() - first;
    const double root = std::cbrt(1 / (volume * phase.material.rho0));
    double scale = root;
    if (deformed) {
      const auto component = [&](int c) { return phase.conserved[first + c][cell]; };
      scale /= std::cbrt(fields.dimension == 2 ? determinant(make_cobasis<Plane>(component))
                                               : determinant(make_cobasis<Space>(component)));
    }
    for (int c = 0; c < n; ++c) {
      double& e = phase.conserved[first + c][cell];
      e = scale * (deformed ? e : identity_cobasis(fields.dimension, c));
    }
  }
  fields.complete(cell);
  return true;
}

}  // namespace cobasis
