#include "solver/kernels_impl.hpp"

namespace cobasis {

template PhaseKernels phase_kernels<Plane, double>(Kind, int);
template PairKernels pair_kernels<Plane, double>(Kind, Kind, Tangent, int);

}  // namespace cobasis
