// The kernels of a scene, picked once at start-up: each is compiled for just what it uses (geometry, kinds of phases),
// so any number of phases needs no new instantiation.
#pragma once

#include "solver/cell_update.hpp"
#include "solver/setup.hpp"

namespace cobasis {

struct PhaseKernels {
  void (*primitives)(Phase&, const CellList&, std::int32_t n, BadCells&) = nullptr;
  void (*sweep_pure)(Faces&, Phase&, Segment) = nullptr;
  void (*sweep_pure_mirror)(Faces&, Phase&, Segment) = nullptr;
  void (*sweep_mixed)(Faces&, Phase&, Segment) = nullptr;
  void (*sweep_mixed_mirror)(Faces&, Phase&, Segment) = nullptr;
  void (*sweep_free_surface)(Faces&, Phase&, double p0, const PairList&, Segment) = nullptr;
  void (*update_pure)(const Faces&, const AlignedVector<double>& volume, Phase&, const CellList&, std::int32_t n,
                      double dt) = nullptr;
  void (*update_mixed)(const Faces&, const AlignedVector<double>& volume, Phase&, const CellList&, std::int32_t n,
                       double dt) = nullptr;
  int n_conserved = 0, n_primitive = 0, n_flux = 0, n_gain = 0, n_side = 0;
};
using PairKernel = void (*)(Faces&, Phase&, Phase&, const PairList&, Segment);

/// `Real` = Pack for runs; double to compare with.
template <class G, class Real>
PhaseKernels phase_kernels(Kind kind);
template <class G, class Real>
PairKernel pair_kernel(Kind l, Kind m, Tangent tangent);

extern template PhaseKernels phase_kernels<Plane, Pack>(Kind);
extern template PhaseKernels phase_kernels<Plane, double>(Kind);
extern template PhaseKernels phase_kernels<Space, Pack>(Kind);
extern template PhaseKernels phase_kernels<Space, double>(Kind);
extern template PairKernel pair_kernel<Plane, Pack>(Kind, Kind, Tangent);
extern template PairKernel pair_kernel<Plane, double>(Kind, Kind, Tangent);
extern template PairKernel pair_kernel<Space, Pack>(Kind, Kind, Tangent);
extern template PairKernel pair_kernel<Space, double>(Kind, Kind, Tangent);

}  // namespace cobasis
