// The kernels of a scene, picked once at start-up: each is compiled for just what it uses (geometry, kinds of phases),
// so any number of phases needs no new instantiation.
#pragma once

#include "solver/cell_update.hpp"
#include "solver/contact_cells.hpp"
#include "solver/contact_sweep.hpp"
#include "solver/reconstruct.hpp"

namespace cobasis {

/// Contacts inside cells, of a phase before a void at pressure p0 and of two phases.
using FreeSurfaceKernel = void (*)(Phase&, double p0, ContactList&, std::int32_t n);
using ContactKernel = void (*)(Phase&, Phase&, ContactList&, std::int32_t n);

struct PhaseKernels {
  void (*primitives)(Phase&, const CellList&, std::int32_t n, BadCells&) = nullptr;
  /// Order 2: states on both sides of the faces of the listed cells; [Around][with averaged gradients].
  std::int64_t (*reconstruct[3][2])(Phase&, const Faces&, const Stencil&, const CellList&, std::int32_t n,
                                    const ReconstructionOptions&) = {};
  void (*find_slopes[3])(Phase&, const Faces&, const Stencil&, const CellList&, std::int32_t n) = {};  ///< [Around]
  void (*copy_to_faces)(Phase&, const Faces&, const CellList&, std::int32_t n) = nullptr;
  void (*sweep_pure)(Faces&, Phase&, Segment) = nullptr;
  void (*sweep_pure_mirror)(Faces&, Phase&, Segment) = nullptr;
  void (*sweep_pure_prescribed)(Faces&, Phase&, Segment) = nullptr;
  void (*sweep_mixed)(Faces&, Phase&, Segment) = nullptr;
  void (*sweep_mixed_mirror)(Faces&, Phase&, Segment) = nullptr;
  void (*sweep_mixed_prescribed)(Faces&, Phase&, Segment) = nullptr;
  void (*sweep_free_surface)(Faces&, Phase&, double p0, const PairList&, Segment) = nullptr;
  void (*update_pure)(const Faces&, const AlignedVector<double>& volume, const Rings*, Phase&, const CellList&,
                      std::int32_t n, double dt, double centring) = nullptr;
  void (*update_mixed)(const Faces&, const AlignedVector<double>& volume, const Rings*, Phase&, const CellList&,
                       std::int32_t n, double dt, double centring) = nullptr;
  void (*hoop_of_cells)(Phase&, const Rings&, const CellList&, std::int32_t n) = nullptr;  ///< null in space
  FreeSurfaceKernel free_surface_in_cells = nullptr, free_surface_speed = nullptr;
  void (*ripple_speed)(const Phase&, ContactList&, std::int32_t n) = nullptr;  ///< null of fluids
  int n_conserved = 0, n_primitive = 0, n_flux = 0, n_gain = 0, n_side = 0, n_face_state = 0, n_slopes = 0,
      n_used_slopes = 0, n_inner = 0;
};
struct PairKernels {
  void (*sweep)(Faces&, Phase&, Phase&, const PairList&, Segment) = nullptr;
  ContactKernel contact_in_cells = nullptr, contact_speed = nullptr;
};

/// `Real` = Pack for runs; double to compare with.
template <class G, class Real>
PhaseKernels phase_kernels(Kind kind, int order);
template <class G, class Real>
PairKernels pair_kernels(Kind l, Kind m, Tangent tangent, int order);

extern template PhaseKernels phase_kernels<Plane, Pack>(Kind, int);
extern template PhaseKernels phase_kernels<Plane, double>(Kind, int);
extern template PhaseKernels phase_kernels<Space, Pack>(Kind, int);
extern template PhaseKernels phase_kernels<Space, double>(Kind, int);
extern template PairKernels pair_kernels<Plane, Pack>(Kind, Kind, Tangent, int);
extern template PairKernels pair_kernels<Plane, double>(Kind, Kind, Tangent, int);
extern template PairKernels pair_kernels<Space, Pack>(Kind, Kind, Tangent, int);
extern template PairKernels pair_kernels<Space, double>(Kind, Kind, Tangent, int);

}  // namespace cobasis
