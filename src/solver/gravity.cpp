#include "solver/gravity.hpp"

#include <array>

namespace cobasis {

void accelerate(Fields& fields, const Point& gain) {
  const std::array components = {gain.x, gain.y, gain.z};
  for (Phase& phase : fields.phases) {
    if (phase.is_void) continue;
    const double* const mass = phase.conserved[0].data();
    double* const energy = phase.conserved[1 + fields.dimension].data();
    for (int d = 0; d < fields.dimension; ++d) {
      const double u = components.at(d);
      if (u == 0) continue;
      double* const momentum = phase.conserved[1 + d].data();
      for (std::int32_t cell = 0; cell < fields.n_owned; ++cell) {
        energy[cell] += u * (momentum[cell] + 0.5 * (mass[cell] * u));
        momentum[cell] += mass[cell] * u;
      }
    }
  }
}

}  // namespace cobasis
