#include "solver/cell_energy.hpp"

#include <cmath>

#include "physics/smooth_flow.hpp"

namespace cobasis {
namespace {

template <class G, class Component>
double stored_energy_of(const Phase& phase, const Component& component) {
  const auto e = make_cobasis<G>(component);
  if (!(determinant(e) > 0)) return infinity;
  return elastic_energy(phase.material, scaled_metric(e, metric_scale(e)));
}

template <class Component>
double stored_energy_of(const Fields& fields, const Phase& phase, const Component& component) {
  if (phase.kind == Kind::fluid) return 0;
  return fields.dimension == 2 ? stored_energy_of<Plane>(phase, component) : stored_energy_of<Space>(phase, component);
}

}  // namespace

double stored_energy(const Fields& fields, const Phase& phase, std::int32_t cell) {
  return stored_energy_of(fields, phase, [&](int c) { return phase.conserved[fields.first_cobasis() + c][cell]; });
}

double total_energy(const Fields& fields, const Phase& phase, const double* w) {
  const int D = fields.dimension;
  double E = visit_compiled(phase.eos, [&](const auto& eos) { return eos.energy(w[0], w[1 + D]); });
  for (int d = 0; d < D; ++d) E += 0.5 * w[1 + d] * w[1 + d];
  const double stored = stored_energy_of(fields, phase, [&](int c) { return w[2 + D + c]; });
  return w[0] * (E + (stored == infinity ? std::nan("") : stored));
}

double internal_energy(const Fields& fields, const Phase& phase, std::int32_t cell) {
  const double mass = phase.conserved[0][cell];
  double e = phase.conserved[1 + fields.dimension][cell] / mass;
  for (int d = 0; d < fields.dimension; ++d) {
    const double u = phase.conserved[1 + d][cell] / mass;
    e -= 0.5 * u * u;
  }
  return e;
}

void resize(const Fields& fields, Phase& phase, std::int32_t cell, double alpha) {
  const double scale = std::cbrt(phase.alpha[cell] / alpha);
  for (int c = fields.first_cobasis(); c < phase.n_conserved(); ++c) phase.conserved[c][cell] *= scale;
  phase.alpha[cell] = alpha;
}

}  // namespace cobasis
