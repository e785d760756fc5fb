#include "solver/kernels_impl.hpp"

namespace cobasis {

template PhaseKernels phase_kernels<Plane, Pack>(Kind);
template PairKernel pair_kernel<Plane, Pack>(Kind, Kind, Tangent);

}  // namespace cobasis
