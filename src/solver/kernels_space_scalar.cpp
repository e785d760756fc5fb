#include "solver/kernels_impl.hpp"

namespace cobasis {

template PhaseKernels phase_kernels<Space, double>(Kind);
template PairKernel pair_kernel<Space, double>(Kind, Kind, Tangent);

}  // namespace cobasis
