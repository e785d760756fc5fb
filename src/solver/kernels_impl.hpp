// Definitions behind kernels.hpp; included once per geometry and number type so that they compile in parallel.
#pragma once

#include "solver/kernels.hpp"

namespace cobasis {

template <class G, Kind K, class Real, Around A, bool Averaged>
std::int64_t reconstruct_phase(Phase& phase, const Faces& faces, const Stencil& stencil, const CellList& cells,
                               std::int32_t n, const ReconstructionOptions& options) {
  return visit_compiled(phase.eos, [&]<class EquationOfState>(const EquationOfState& eos) {
    return reconstruct<G, K, Real, EquationOfState, A, Averaged>(phase, eos, faces, stencil, cells, n, options);
  });
}

template <class G, Kind K, class Real>
void add_second_order(PhaseKernels& kernels) {
  const auto add = [&]<Around A>(std::integral_constant<Around, A>) {
    constexpr int around = static_cast<int>(A);
    kernels.reconstruct[around][0] = &reconstruct_phase<G, K, Real, A, false>;
    kernels.reconstruct[around][1] = &reconstruct_phase<G, K, Real, A, true>;
    kernels.find_slopes[around] = &find_slopes<G, K, Real, A>;
  };
  add(std::integral_constant<Around, Around::phase>());
  add(std::integral_constant<Around, Around::mirrors>());
  add(std::integral_constant<Around, Around::gaps>());
  kernels.copy_to_faces = &copy_to_faces<G, K, Real>;
}

template <class G, Kind K, class Real, int Order>
PhaseKernels phase_kernels_of() {
  using L = Layout<G, K>;
  PhaseKernels kernels{
      .primitives =
          [](Phase& phase, const CellList& cells, std::int32_t n, BadCells& bad) {
            visit_compiled(phase.eos, [&](const auto& eos) { primitives<G, K, Real>(phase, eos, cells, n, bad); });
          },
      .sweep_pure = &sweep_same<G, K, Real, false, Beyond::cell, Order>,
      .sweep_pure_mirror = &sweep_same<G, K, Real, false, Beyond::mirror, Order>,
      .sweep_pure_prescribed = &sweep_same<G, K, Real, false, Beyond::prescribed, Order>,
      .sweep_mixed = &sweep_same<G, K, Real, true, Beyond::cell, Order>,
      .sweep_mixed_mirror = &sweep_same<G, K, Real, true, Beyond::mirror, Order>,
      .sweep_mixed_prescribed = &sweep_same<G, K, Real, true, Beyond::prescribed, Order>,
      .sweep_free_surface = &sweep_free_surface<G, K, Real, Order>,
      .update_pure = &update<G, K, Real, false>,
      .update_mixed = &update<G, K, Real, true>,
      .free_surface_in_cells = &free_surface_in_cells<G, K, Real, false>,
      .free_surface_speed = &free_surface_in_cells<G, K, Real, true>,
      .n_conserved = L::n_conserved,
      .n_primitive = L::n_primitive,
      .n_flux = L::n_flux,
      .n_gain = L::n_gain,
      .n_side = L::n_side,
      .n_face_state = L::n_face_state,
      .n_slopes = Primitives<G, K>::size * G::dimension,
      .n_used_slopes = Primitives<G, K>::size * (G::dimension + 1),
      .n_inner = L::n_inner};
  if constexpr (G::dimension == 2) kernels.hoop_of_cells = &hoop_of_cells<G, K, Real>;
  if constexpr (K == Kind::solid) kernels.ripple_speed = &ripple_speeds<G, Real>;
  if constexpr (Order == 2) add_second_order<G, K, Real>(kernels);
  return kernels;
}

template <class G, class Real>
PhaseKernels phase_kernels(Kind kind, int order) {
  if (kind == Kind::solid)
    return order == 1 ? phase_kernels_of<G, Kind::solid, Real, 1>() : phase_kernels_of<G, Kind::solid, Real, 2>();
  return order == 1 ? phase_kernels_of<G, Kind::fluid, Real, 1>() : phase_kernels_of<G, Kind::fluid, Real, 2>();
}

template <class G, Kind Kl, Kind Km, Tangent T, class Real>
PairKernels pair_kernels_of(int order) {
  return {.sweep = order == 1 ? &sweep_pair<G, Kl, Km, T, Real, 1> : &sweep_pair<G, Kl, Km, T, Real, 2>,
          .contact_in_cells = &contact_in_cells<G, Kl, Km, T, Real, false>,
          .contact_speed = &contact_in_cells<G, Kl, Km, T, Real, true>};
}

template <class G, class Real>
PairKernels pair_kernels(Kind l, Kind m, Tangent tangent, int order) {
  constexpr Kind fluid = Kind::fluid, solid = Kind::solid;
  if (l == fluid && m == fluid) return pair_kernels_of<G, fluid, fluid, Tangent::free, Real>(order);
  if (l == fluid) return pair_kernels_of<G, fluid, solid, Tangent::free, Real>(order);
  if (m == fluid) return pair_kernels_of<G, solid, fluid, Tangent::free, Real>(order);
  if (tangent == Tangent::bonded) return pair_kernels_of<G, solid, solid, Tangent::bonded, Real>(order);
  if (tangent == Tangent::rubbing) return pair_kernels_of<G, solid, solid, Tangent::rubbing, Real>(order);
  return pair_kernels_of<G, solid, solid, Tangent::free, Real>(order);
}

}  // namespace cobasis
