#include "solver/kernels_impl.hpp"

namespace cobasis {

template PhaseKernels phase_kernels<Space, Pack>(Kind);
template PairKernel pair_kernel<Space, Pack>(Kind, Kind, Tangent);

}  // namespace cobasis
