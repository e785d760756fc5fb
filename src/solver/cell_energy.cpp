#include "solver/cell_energy.hpp"

#include <cmath>

#include "physics/smooth_flow.hpp"

namespace cobasis {
namespace {

template <class G>
double stored_energy_in(const Fields& fields, const Phase& phase, std::int32_t cell) {
  const auto e = make_cobasis<G>([&](int c) { return phase.conserved[fields.first_cobasis() + c][cell]; });
  if (!(determinant(e) > 0)) return infinity;
  return elastic_energy(phase.material, scaled_metric(e, metric_scale(e)));
}

}  // namespace

double stored_energy(const Fields& fields, const Phase& phase, std::int32_t cell) {
  if (phase.kind == Kind::fluid) return 0;
  return fields.dimension == 2 ? stored_energy_in<Plane>(fields, phase, cell)
                               : stored_energy_in<Space>(fields, phase, cell);
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
