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
Real inverse_or_zero(const Real& z) {
  return select(z > Real(0.0), 1.0 / z, Real(0.0));
}

/// Material on both sides bonded: the same solid, or two solids that adhere (App. C). The larger of the two speeds
/// counts for both sides. With mu = 0 on both it is a fluid: no stress, and each side keeps its velocity.
template <class G, class Real>
ShearStar<G, Real> bonded_shear(const SolidFace<G, Real>& l, const SolidFace<G, Real>& r) {
  const Real c = larger(l.cs, r.cs);
  const Real z_l = l.rho * c, z_r = r.rho * c;
  const Real of_sum = inverse_or_zero(z_l + z_r), of_l = inverse_or_zero(z_l), of_r = inverse_or_zero(z_r);
  const auto stress = [&](const auto& tau_l, const auto& tau_r, const auto& w_l, const auto& w_r) {
    return of_sum * (z_r * tau_l + z_l * tau_r + (z_l * z_r) * (w_r - w_l));
  };
  ShearStar<G, Real> star;
  star.tau = {Zero{}, stress(l.tau.y, r.tau.y, l.u.y, r.u.y), stress(l.tau.z, r.tau.z, l.u.z, r.u.z)};
  star.w_l = {Zero{}, l.u.y - of_l * (l.tau.y - star.tau.y), l.u.z - of_l * (l.tau.z - star.tau.z)};
  star.w_r = {Zero{}, r.u.y + of_r * (r.tau.y - star.tau.y), r.u.z + of_r * (r.tau.z - star.tau.z)};
  return star;
}

/// Two solids that rub: bonded where that takes less shear stress than `most` [Pa], Coulomb's bound; else they slip
/// under just that, each through its own wave. Its power, tau·(w_r - w_l), is never negative.
template <class G, class Real>
ShearStar<G, Real> rubbing_shear(const SolidFace<G, Real>& l, const SolidFace<G, Real>& r, const Real& most) {
  const Real z_l = l.rho * l.cs, z_r = r.rho * r.cs;
  const Real of_sum = inverse_or_zero(z_l + z_r), of_l = inverse_or_zero(z_l), of_r = inverse_or_zero(z_r);
  const auto stress = [&](const auto& tau_l, const auto& tau_r, const auto& w_l, const auto& w_r) {
    return of_sum * (z_r * tau_l + z_l * tau_r + (z_l * z_r) * (w_r - w_l));
  };
  const typename ShearStar<G, Real>::Tangential needed{Zero{}, stress(l.tau.y, r.tau.y, l.u.y, r.u.y),
                                                       stress(l.tau.z, r.tau.z, l.u.z, r.u.z)};
  const Real size = square_root(dot(needed, needed));
  const Mask<Real> slips = !(size < most);
  const Real share = most * inverse_or_zero(size);
  ShearStar<G, Real> star = bonded_shear(l, r);
  const auto slip = [&](const auto& tau_l, const auto& tau_r, const auto& u_l, const auto& u_r, const auto& of_needed,
                        auto& tau, auto& w_l, auto& w_r) {
    tau = select(slips, share * of_needed, tau);
    w_l = select(slips, u_l - of_l * (tau_l - tau), w_l);
    w_r = select(slips, u_r + of_r * (tau_r - tau), w_r);
  };
  slip(l.tau.y, r.tau.y, l.u.y, r.u.y, needed.y, star.tau.y, star.w_l.y, star.w_r.y);
  if constexpr (G::dimension == 3) slip(l.tau.z, r.tau.z, l.u.z, r.u.z, needed.z, star.tau.z, star.w_l.z, star.w_r.z);
  return star;
}

/// Tangential velocity of a surface free of shear stress; `side` = +1 where the solid lies left of it, -1 right.
template <class G, class Real>
Vec3<Zero, Real, Third<G, Real>> free_surface_velocity(const SolidFace<G, Real>& s, const Real& side) {
  const Real of_z = side * inverse_or_zero(s.rho * s.cs);
  return {Zero{}, s.u.y - of_z * s.tau.y, s.u.z - of_z * s.tau.z};
}

}  // namespace cobasis
