#include "solver/kernels_impl.hpp"

namespace cobasis {

template PhaseKernels phase_kernels<Space, Pack>(Kind, int);
template PairKernels pair_kernels<Space, Pack>(Kind, Kind, Tangent, int);

}  // namespace cobasis
