// The state of a phase in a cell as Primitives numbers it, and what slopes may make of it.
#pragma once

#include "math/pack.hpp"
#include "physics/smooth_flow.hpp"
#include "solver/field.hpp"

namespace cobasis {

/// Density, velocity, pressure and cobasis of cells.
template <class G, Kind K, class Real>
typename Primitives<G, K>::template State<Real> mean_state(const Phase& phase, const Indices<Real>& cell) {
  using P = Primitives<G, K>;
  typename P::template State<Real> w;
  for (int v = 0; v < P::size; ++v)
    w[v] = gather<Real>((v == P::rho ? phase.density()
                         : v < P::e  ? phase.primitive[v]
                                     : phase.conserved[Layout<G, K>::cobasis + v - P::e])
                            .data(),
                        cell);
  return w;
}

template <class G, Kind K, class Real>
Cobasis<G, Real> cobasis_of(const std::array<Real, Primitives<G, K>::size>& w) {
  return make_cobasis<G>([&](int c) { return w[Primitives<G, K>::e + c]; });
}

/// Whether the components of an e that slopes have made still belong to one deformation: whether their determinant is
/// near the one that the mean, or the density, says.
template <class Real>
Mask<Real> is_one_deformation(const Real& det, const Real& expected) {
  constexpr double least = 0.5, most = 2;
  return det > least * expected && det < most * expected;
}

}  // namespace cobasis
