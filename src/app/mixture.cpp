#include "app/mixture.hpp"

#include <cassert>

namespace cobasis {

Mixture mix(const Snapshot& snapshot, std::span<const PhaseSetup> phases) {
  assert(snapshot.phases.size() == phases.size() && !phases.empty());
  const std::size_t n = snapshot.phases.front().alpha.size();
  Mixture result;
  result.density.assign(n, 0);
  result.pressure.assign(n, 0);
  for (auto& component : result.velocity) component.assign(n, 0);
  for (auto& component : result.stress) component.assign(n, 0);

  for (std::size_t k = 0; k < phases.size(); ++k) {
    const PhaseSnapshot& phase = snapshot.phases[k];
    for (std::size_t i = 0; i < n; ++i) {
      const double alpha = phase.alpha[i];
      if (phases[k].is_void()) {
        const double p0 = *phases[k].void_pressure;
        result.pressure[i] += alpha * p0;
        for (int c = 0; c < 3; ++c) result.stress[c][i] -= alpha * p0;
        continue;
      }
      const double mass = alpha * phase.density[i];  // per volume of the mixture
      result.density[i] += mass;
      result.pressure[i] += alpha * phase.pressure[i];
      for (int c = 0; c < 3; ++c) result.velocity[c][i] += mass * phase.velocity[c][i];
      for (int c = 0; c < 6; ++c) result.stress[c][i] += alpha * phase.stress[c][i];
    }
  }
  for (auto& component : result.velocity) {
    for (std::size_t i = 0; i < n; ++i) component[i] = result.density[i] > 0 ? component[i] / result.density[i] : 0;
  }
  return result;
}

}  // namespace cobasis
