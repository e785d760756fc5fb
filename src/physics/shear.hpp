// Sub-systems 2 and 3, solved together: the tangential Riemann problem with one joint speed, which makes the result
// independent of the choice of the tangents.
#pragma once

#include "physics/face_state.hpp"

namespace cobasis {

/// tau = (0, sigma_12, sigma_13) of the contact [Pa]; w_l, w_r: tangential velocity (0, v, w) left and right of it
/// [m/s].
template <class G, class Real>
struct ShearStar {
  using Tangential = Vec3<Zero, Real, Third<G, Real>>;
  Tangential tau, w_l, w_r;
};

template <class Real>
Real ratio_or_zero(const Real& x, const Real& z) {
  return select(z > Real(0.0), x / z, Real(0.0));
}
template <class Real>
Zero ratio_or_zero(Zero, const Real&) {
  return {};
}

/// Material on both sides bonded: the same solid, or two solids that adhere (App. C). The larger of the two speeds
/// counts for both sides. With mu = 0 on both it is a fluid: no stress, and each side keeps its velocity.
template <class G, class Real>
ShearStar<G, Real> bonded_shear(const SolidFace<G, Real>& l, const SolidFace<G, Real>& r) {
  const Real c = larger(l.cs, r.cs);
  const Real z_l = l.rho * c, z_r = r.rho * c, sum = z_l + z_r;
  const auto stress = [&](const auto& tau_l, const auto& tau_r, const auto& w_l, const auto& w_r) {
    return ratio_or_zero(z_r * tau_l + z_l * tau_r + (z_l * z_r) * (w_r - w_l), sum);
  };
  ShearStar<G, Real> star;
  star.tau.y = stress(l.tau.y, r.tau.y, l.u.y, r.u.y);
  star.tau.z = stress(l.tau.z, r.tau.z, l.u.z, r.u.z);
  star.w_l = {Zero{}, l.u.y - ratio_or_zero(l.tau.y - star.tau.y, z_l),
              l.u.z - ratio_or_zero(l.tau.z - star.tau.z, z_l)};
  star.w_r = {Zero{}, r.u.y + ratio_or_zero(r.tau.y - star.tau.y, z_r),
              r.u.z + ratio_or_zero(r.tau.z - star.tau.z, z_r)};
  return star;
}

/// Tangential velocity of a surface free of shear stress; `side` = +1 where the solid lies left of it, -1 right.
template <class G, class Real>
Vec3<Zero, Real, Third<G, Real>> free_surface_velocity(const SolidFace<G, Real>& s, const Real& side) {
  const Real z = s.rho * s.cs;
  return {Zero{}, s.u.y - ratio_or_zero(side * s.tau.y, z), s.u.z - ratio_or_zero(side * s.tau.z, z)};
}

}  // namespace cobasis
