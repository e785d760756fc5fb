#include "solver/kernels_impl.hpp"

namespace cobasis {

template PhaseKernels phase_kernels<Plane, double>(Kind);
template PairKernel pair_kernel<Plane, double>(Kind, Kind, Tangent);

}  // namespace cobasis
