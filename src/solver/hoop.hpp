// Axisymmetric scenes: what faces do not say of a ring. A plane scene's z is the hoop here, e^3 its stretch.
//
// Over a ring with faces A n, where sum A n = section e_r:
//   radial momentum:  + section (-sigma_zz);   e^3:  - section u_r e^3;   grad u:  sum A n u* / V - section e_r u / V,
// with stress and velocity at the centroid of the section: the ring's own is farther from the axis, and there, where
// cells touch it, the difference is no small one. The sum of the stretches is then exactly that of the volume.
#pragma once

#include "physics/smooth_flow.hpp"
#include "solver/mean_state.hpp"

namespace cobasis {

inline constexpr int n_hoop = 3;

/// Keeps -sigma_zz and the velocity at the centroid of the section, at the time at which the faces are.
template <Kind K, class Real>
void keep_hoop(Phase& phase, const Indices<Real>& at, const typename Primitives<Plane, K>::template State<Real>& w) {
  using P = Primitives<Plane, K>;
  scatter(hoop_pressure<K, Real>(phase.material, w), phase.hoop.component(0), at);
  for (int d = 0; d < 2; ++d) scatter(w[P::u + d], phase.hoop.component(1 + d), at);
}

/// The same of a cell without slopes: stress and axial velocity as they are; a radial velocity that is zero on the
/// axis.
template <Kind K, class Real>
void keep_hoop_of_cell(Phase& phase, const Rings& rings, const Indices<Real>& at,
                       typename Primitives<Plane, K>::template State<Real> w) {
  using P = Primitives<Plane, K>;
  w[P::u + 1] = gather<Real>(rings.lever.data(), at) * w[P::u + 1];
  keep_hoop<K>(phase, at, w);
}

/// For the listed cells.
template <class G, Kind K, class Real>
COBASIS_KERNEL void hoop_of_cells(Phase& phase, const Rings& rings, const CellList& cells, std::int32_t n) {
  for (std::int32_t i = 0; i < n; i += lanes<Real>) {
    const Indices<Real> at = load_indices<Real>(&cells[i]);
    keep_hoop_of_cell<K>(phase, rings, at, mean_state<G, K, Real>(phase, at));
  }
}

/// Adds to the changes that faces make, per volume and time step; `share`: volume fraction at its beginning. Of a solid
/// also to `deformation`; returns the hoop's stretching.
template <Kind K, class Real, class Change, class Deformation, class Velocity>
Real add_hoop(const Phase& phase, const Rings& rings, const Indices<Real>& at, const Real& share, Change& change,
              Deformation& deformation, const Velocity& u) {
  using L = Layout<Plane, K>;
  const Mask<Real> present = share > Real(0.0);
  const Real section = share * gather<Real>(rings.section.data(), at);
  const auto hoop = [&](int c) { return select(present, gather<Real>(phase.hoop.component(c), at), Real(0.0)); };
  change[L::momentum + 1] = change[L::momentum + 1] + section * hoop(0);
  const Real u_r = hoop(2);
  if constexpr (K == Kind::solid) {
    deformation[1][0] = deformation[1][0] + section * (hoop(1) - u[0]);
    deformation[1][1] = deformation[1][1] + section * (u_r - u[1]);
  }
  return section * u_r;
}

}  // namespace cobasis
