#include "solver/kernels_impl.hpp"

namespace cobasis {

template PhaseKernels phase_kernels<Space, double>(Kind, int);
template PairKernels pair_kernels<Space, double>(Kind, Kind, Tangent, int);

}  // namespace cobasis
