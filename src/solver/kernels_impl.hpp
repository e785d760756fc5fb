// Definitions behind kernels.hpp; included once per geometry and number type so that they compile in parallel.
#pragma once

#include "solver/kernels.hpp"

namespace cobasis {

template <class G, Kind K, class Real>
PhaseKernels phase_kernels_of() {
  using L = Layout<G, K>;
  return {.primitives =
              [](Phase& phase, const CellList& cells, std::int32_t n, BadCells& bad) {
                std::visit([&](const auto& eos) { primitives<G, K, Real>(phase, eos, cells, n, bad); }, phase.eos);
              },
          .sweep_pure = &sweep_same<G, K, Real, false, Beyond::cell>,
          .sweep_pure_mirror = &sweep_same<G, K, Real, false, Beyond::mirror>,
          .sweep_mixed = &sweep_same<G, K, Real, true, Beyond::cell>,
          .sweep_mixed_mirror = &sweep_same<G, K, Real, true, Beyond::mirror>,
          .sweep_free_surface = &sweep_free_surface<G, K, Real>,
          .update_pure = &update<G, K, Real, false>,
          .update_mixed = &update<G, K, Real, true>,
          .n_conserved = L::n_conserved,
          .n_primitive = L::n_primitive,
          .n_flux = L::n_flux,
          .n_gain = L::n_gain,
          .n_side = L::n_side};
}

template <class G, class Real>
PhaseKernels phase_kernels(Kind kind) {
  return kind == Kind::solid ? phase_kernels_of<G, Kind::solid, Real>() : phase_kernels_of<G, Kind::fluid, Real>();
}

template <class G, class Real>
PairKernel pair_kernel(Kind l, Kind m, Tangent tangent) {
  if (l == Kind::fluid && m == Kind::fluid) return &sweep_pair<G, Kind::fluid, Kind::fluid, Tangent::free, Real>;
  if (l == Kind::fluid) return &sweep_pair<G, Kind::fluid, Kind::solid, Tangent::free, Real>;
  if (m == Kind::fluid) return &sweep_pair<G, Kind::solid, Kind::fluid, Tangent::free, Real>;
  return tangent == Tangent::bonded ? &sweep_pair<G, Kind::solid, Kind::solid, Tangent::bonded, Real>
                                    : &sweep_pair<G, Kind::solid, Kind::solid, Tangent::free, Real>;
}

}  // namespace cobasis
