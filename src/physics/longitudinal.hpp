// Sub-system 1: the longitudinal Riemann problem between a phase on the left and a phase on the right of a face, by
// HLLC with Davis' wave speeds. No sigma_12, sigma_13 here: they belong to the shear problem.
#pragma once

#include "physics/face_state.hpp"

namespace cobasis {

template <class Real>
struct LongitudinalStar {
  Real u_star, P_star;   ///< of the contact; the Lagrangian part always uses these
  Mask<Real> from_left;  ///< u* > 0: the left phase is at the face. Complementary: at u* = 0 it is the right one
  Real u_f, P_f;         ///< at the face: the star values, or the upwind side's own where the flow is supersonic
  Real r;                ///< stretch rho*/rho of the state at the face
  Real mass_speed;       ///< rho_s (S - u_s) of the upwind side
  Real fastest;          ///< larger magnitude of the two wave speeds; bounds the step
};

/// Thornber's correction, J. Comput. Phys. 227 (2008) 4873: where the flow is slow, HLLC dissipates jumps of the normal
/// velocity at the rate of sound waves that are not there. The jump is reduced to theta of itself, at constant pressure
/// and internal energy. In a sound wave or shock |dP| = rho c |du|: theta is 1 there, and nothing changes.
/// `strength`: 0 or 1.
template <class Real, class FaceL, class FaceR>
void reduce_slow_jump(FaceL& l, FaceR& r, const Real& strength) {
  const Real one(1.0), tiny(1e-300);
  const Real mean = 0.5 * (l.u.x + r.u.x), half_jump = 0.5 * (r.u.x - l.u.x);
  const Real c = larger(l.c1, r.c1), z = larger(l.rho * l.c1, r.rho * r.c1);
  const Real mach = larger(magnitude(l.u.x), magnitude(r.u.x)) / c;
  const Real acoustic = magnitude(r.P - l.P) / (2.0 * (z * magnitude(half_jump)) + tiny);
  const Real theta = one - strength * (one - smaller(one, mach + acoustic));
  const auto move = [&](auto& side, const Real& u) {
    side.E = side.E + 0.5 * (u * u - side.u.x * side.u.x);
    side.u.x = u;
  };
  move(l, mean - theta * half_jump);
  move(r, mean + theta * half_jump);
}

template <class Real, class FaceL, class FaceR>
LongitudinalStar<Real> longitudinal(const FaceL& l, const FaceR& r) {
  const Real u_l = l.u.x, u_r = r.u.x;
  Real S_l = smaller(u_l - l.c1, u_r - r.c1);
  Real S_r = larger(u_l + l.c1, u_r + r.c1);

  // u* in the form that is exact for uniform and for mirrored states
  const Real mean = 0.5 * (u_l + u_r), half_jump = 0.5 * (u_r - u_l);
  Real m_l = l.rho * (S_l - u_l), m_r = r.rho * (S_r - u_r);
  Real u_star = mean + ((r.P - l.P) - (m_l + m_r) * half_jump) / (m_l - m_r);

  // In tension against a soft neighbour Davis' speeds do not enclose the contact: widen them by the side's own
  // traction.
  const Mask<Real> outside = !((S_l < u_star) && (u_star < S_r));
  if (any(outside)) {
    const Real c_l = square_root(larger(l.c1 * l.c1, 1.2 * (r.P - l.P) / l.rho));
    const Real c_r = square_root(larger(r.c1 * r.c1, 1.2 * (l.P - r.P) / r.rho));
    S_l = select(outside, smaller(u_l - c_l, u_r - c_r), S_l);
    S_r = select(outside, larger(u_l + c_l, u_r + c_r), S_r);
    m_l = l.rho * (S_l - u_l);
    m_r = r.rho * (S_r - u_r);
    u_star = mean + ((r.P - l.P) - (m_l + m_r) * half_jump) / (m_l - m_r);
  }
  const Real P_star = l.P + m_l * (u_star - u_l);

  const Mask<Real> from_left = u_star > Real(0.0);
  const Real u_s = select(from_left, u_l, u_r), P_s = select(from_left, l.P, r.P);
  const Real S = select(from_left, S_l, S_r);
  const Mask<Real> supersonic = (S_l >= Real(0.0)) || (S_r <= Real(0.0));
  return {.u_star = u_star,
          .P_star = P_star,
          .from_left = from_left,
          .u_f = select(supersonic, u_s, u_star),
          .P_f = select(supersonic, P_s, P_star),
          .r = select(supersonic, Real(1.0), (S - u_s) / (S - u_star)),
          .mass_speed = select(from_left, m_l, m_r),
          .fastest = larger(magnitude(S_l), magnitude(S_r))};
}

/// A material with a void at pressure p0 in front of it (outside its outward normal): acoustic, the void gives no wave.
template <class Real, class FaceL>
LongitudinalStar<Real> free_surface(const FaceL& l, const Real& p0) {
  const Real u = l.u.x;
  const Real c = square_root(larger(l.c1 * l.c1, 1.2 * (p0 - l.P) / l.rho));  // keeps r > 0 in strong tension
  const Real z = l.rho * c;
  const Real u_star = u + (l.P - p0) / z;
  const Mask<Real> supersonic = u >= c;
  return {.u_star = u_star,
          .P_star = p0,
          .from_left = u_star > Real(0.0),
          .u_f = select(supersonic, u, u_star),
          .P_f = select(supersonic, l.P, p0),
          .r = select(supersonic, Real(1.0), c / (c + u_star - u)),
          .mass_speed = -z,
          .fastest = magnitude(u) + c};
}

/// Flux through a face per unit area, in the face frame. The convected parts are those without pressure.
template <class G, class Real>
struct Flux {
  Real mass;
  Vector<G, Real> convected_momentum, momentum;
  Real convected_energy, energy;
};

/// Eulerian flux of the phase that is at the face, (19).
template <class G, class Real, class FaceL, class FaceR>
Flux<G, Real> eulerian_flux(const LongitudinalStar<Real>& star, const FaceL& l, const FaceR& r) {
  const Real rho = select(star.from_left, l.rho, r.rho), E = select(star.from_left, l.E, r.E);
  const Real u = select(star.from_left, l.u.x, r.u.x), v = select(star.from_left, l.u.y, r.u.y);
  const Real P = select(star.from_left, l.P, r.P);
  const Real E_f = E + (star.P_f * star.u_f - P * u) / star.mass_speed;
  Flux<G, Real> flux;
  flux.mass = rho * star.r * star.u_f;
  flux.convected_momentum.x = flux.mass * star.u_f;
  flux.convected_momentum.y = flux.mass * v;
  if constexpr (G::dimension == 3) flux.convected_momentum.z = flux.mass * select(star.from_left, l.u.z, r.u.z);
  flux.momentum = flux.convected_momentum;
  flux.momentum.x = flux.momentum.x + star.P_f;
  flux.convected_energy = flux.mass * E_f;
  flux.energy = flux.convected_energy + star.P_f * star.u_f;
  return flux;
}

}  // namespace cobasis
