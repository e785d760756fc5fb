#include "solver/field.hpp"

namespace cobasis {

void Fields::complete(std::int32_t cell) {
  int last = 0, present = 0, some = 0;
  for (int k = 0; k < n_phases(); ++k) {
    if (phases[k].is_void) {
      last = k;
      break;
    }
    if (phases[k].alpha[cell] > phases[last].alpha[cell]) last = k;
  }
  double others = 0;
  for (int k = 0; k < n_phases(); ++k) {
    if (k == last) continue;
    const double alpha = phases[k].alpha[cell];
    others += alpha;
    if (alpha != 0) ++present, some = k;
  }
  double& rest = phases[last].alpha[cell];
  rest = present == 0 ? 1 : 1 - others;
  if (rest != 0) ++present, some = last;
  pure[cell] = present == 1 && phases[some].alpha[cell] == 1 ? some : -1;
}

}  // namespace cobasis
