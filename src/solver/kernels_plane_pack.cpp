#include "solver/kernels_impl.hpp"

namespace cobasis {

template PhaseKernels phase_kernels<Plane, Pack>(Kind, int);
template PairKernels pair_kernels<Plane, Pack>(Kind, Kind, Tangent, int);

}  // namespace cobasis
