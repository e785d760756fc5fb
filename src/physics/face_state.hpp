// The state of one phase on one side of a face, in the frame of the face: all that the Riemann problems ask for.
// Indices 1, 2, 3 stand for n, t1, t2.
#pragma once

#include "physics/hyperelastic_material.hpp"

namespace cobasis {

/// Primitive state of a phase in a cell; the EOS has been evaluated, so nothing here depends on which it is.
template <class G, class Real>
struct FluidState {
  Real rho;           ///< [kg/m^3]
  Vector<G, Real> u;  ///< [m/s]
  Real p;             ///< [Pa]
  Real ch2;           ///< sound speed of the hydrodynamic part, squared [m^2/s^2]
  Real E;             ///< total energy [J/kg]
};
template <class G, class Real>
struct SolidState : FluidState<G, Real> {
  Symmetric<G, Real> g;  ///< G / |G|^{1/3}
};

template <class G, class Real>
struct FluidFace {
  static constexpr Kind kind = Kind::fluid;
  Real rho;
  Vector<G, Real> u;  ///< (u, v, w) along n, t1, t2
  Real E;
  Real P;   ///< -sigma_11 [Pa]
  Real c1;  ///< longitudinal speed [m/s]
};
template <class G, class Real>
struct SolidFace {
  static constexpr Kind kind = Kind::solid;
  Real rho;
  Vector<G, Real> u;
  Real E;
  Real P;
  Real c1;
  Vec3<Zero, Real, Third<G, Real>> tau;  ///< (0, sigma_12, sigma_13) [Pa]
  Real cs;                               ///< joint shear speed [m/s]
};

template <class G, Kind K, class Real>
struct FaceOf;
template <class G, class Real>
struct FaceOf<G, Kind::fluid, Real> {
  using type = FluidFace<G, Real>;
};
template <class G, class Real>
struct FaceOf<G, Kind::solid, Real> {
  using type = SolidFace<G, Real>;
};
template <class G, Kind K, class Real>
using Face = typename FaceOf<G, K, Real>::type;

template <class G, class Real>
FluidFace<G, Real> face_state(const FluidState<G, Real>& s, const Frame<G, Real>& frame) {
  return {s.rho, into_frame(frame, s.u), s.E, s.p, square_root(s.ch2)};
}

/// Stress (6) and the squared speeds of the three sub-systems from g in the face frame.
template <class G, class Real>
SolidFace<G, Real> face_state(const HyperelasticMaterial& m, const SolidState<G, Real>& s,
                              const Frame<G, Real>& frame) {
  constexpr double third = 1.0 / 3.0;  // products, not divisions: these are the hot lines of a run
  const double a = m.a, kappa = m.kappa();
  const Symmetric<G, Real>& g = s.g;
  const Vec3 gn{g.xx * frame.n.x + g.xy * frame.n.y + g.xz * frame.n.z,
                g.xy * frame.n.x + g.yy * frame.n.y + g.yz * frame.n.z,
                g.xz * frame.n.x + g.yz * frame.n.y + g.zz * frame.n.z};
  const Vec3 gt{g.xx * frame.t1.x + g.xy * frame.t1.y + g.xz * frame.t1.z,
                g.xy * frame.t1.x + g.yy * frame.t1.y + g.yz * frame.t1.z,
                g.xz * frame.t1.x + g.yz * frame.t1.y + g.zz * frame.t1.z};
  const Real j1 = trace(g);
  const Real g11 = dot(frame.n, gn), g12 = dot(frame.t1, gn), g22 = dot(frame.t1, gt);
  const Third<G, Real> g13 = dot(frame.t2, gn), g23 = dot(frame.t2, gt);
  const Real g33 = j1 - g11 - g22;
  const Real off_diagonal = g12 * g12 + g13 * g13 + g23 * g23;
  const Real j2 = g11 * g11 + g22 * g22 + g33 * g33 + 2.0 * off_diagonal;

  // S_1i / rho, (6)
  const Real k = Real(-m.mu / m.rho0);
  const Real S11 = k * (kappa * j1 * (g11 - third * j1) + a * (g11 * g11 + g12 * g12 + g13 * g13 - third * j2));
  const Real S12 = k * (kappa * j1 * g12 + a * (g11 * g12 + g12 * g22 + g13 * g23));
  const Third<G, Real> S13 = k * (kappa * j1 * g13 + a * (g11 * g13 + g12 * g23 + g13 * g33));

  // D1 / rho = d(S11/rho) along da = a at fixed rho
  const Real dj1 = third * (4.0 * g11 - 2.0 * (g22 + g33));
  const Real d11 = 4.0 / 3.0 * (g11 * g11) + third * (g12 * g12 + g13 * g13);  // g_1i dg_1i
  const Real dj2 =
      2.0 * (d11 - 2.0 / 3.0 * (g22 * g22 + g33 * g33) + third * (g12 * g12 + g13 * g13) - 4.0 / 3.0 * (g23 * g23));
  const Real D1 =
      k * (kappa * (dj1 * (g11 - third * j1) + j1 * (4.0 / 3.0 * g11 - third * dj1)) + a * (2.0 * d11 - third * dj2));
  const Real c1_squared = s.ch2 - S11 - D1;

  // joint shear speed: largest eigenvalue of the tangential acoustic tensor (mu / rho0) M
  const Real M22 = kappa * (2.0 * (g12 * g12) + j1 * g22) + a * (2.0 * (g12 * g12) + g22 * g22 + g23 * g23 + g11 * g22);
  const Real M33 = kappa * (2.0 * (g13 * g13) + j1 * g33) + a * (2.0 * (g13 * g13) + g33 * g33 + g23 * g23 + g11 * g33);
  const Third<G, Real> M23 = kappa * (2.0 * (g12 * g13) + j1 * g23) + a * (2.0 * (g12 * g13) + g23 * (g22 + g33 + g11));
  const Real half = 0.5 * (M22 - M33);
  const Real cs_squared = m.mu / m.rho0 * (0.5 * (M22 + M33) + square_root(half * half + M23 * M23));

  return {.rho = s.rho,
          .u = into_frame(frame, s.u),
          .E = s.E,
          .P = s.p - s.rho * S11,
          .c1 = square_root(c1_squared),
          .tau = {Zero{}, s.rho * S12, s.rho * S13},
          .cs = square_root(cs_squared)};
}

/// The state behind a wall or a symmetry plane: normal velocity and shear stress reversed.
template <class G, class Real>
FluidFace<G, Real> mirrored(FluidFace<G, Real> s) {
  s.u.x = -s.u.x;
  return s;
}
template <class G, class Real>
SolidFace<G, Real> mirrored(SolidFace<G, Real> s) {
  s.u.x = -s.u.x;
  s.tau = {Zero{}, -s.tau.y, -s.tau.z};
  return s;
}

/// The state behind a wall that moves with the velocity `wall`, given in the frame of the face, and to which a solid is
/// bonded where `bonded` is 1. Both sides together have the wall's velocity, of a frictionless wall its normal part,
/// and no shear stress there. What is displaced by the wall enters with the state that it has before it. Where `open`
/// is true, there is no wall and the state goes on.
template <class G, class Real>
FluidFace<G, Real> behind_wall(FluidFace<G, Real> s, const Vector<G, Real>& wall, const Real&, const Mask<Real>& open) {
  const Real u = select(open, s.u.x, 2.0 * wall.x - s.u.x);
  s.E = s.E + 0.5 * (u * u - s.u.x * s.u.x);
  s.u.x = u;
  return s;
}
template <class G, class Real>
SolidFace<G, Real> behind_wall(SolidFace<G, Real> s, const Vector<G, Real>& wall, const Real& bonded,
                               const Mask<Real>& open) {
  Vector<G, Real> u;
  u.x = select(open, s.u.x, 2.0 * wall.x - s.u.x);
  u.y = s.u.y + 2.0 * (bonded * (wall.y - s.u.y));
  if constexpr (G::dimension == 3) u.z = s.u.z + 2.0 * (bonded * (wall.z - s.u.z));
  s.E = s.E + 0.5 * (dot(u, u) - dot(s.u, s.u));
  s.u = u;
  const Real shear = select(open, Real(1.0), 2.0 * bonded - 1.0);
  s.tau = {Zero{}, shear * s.tau.y, shear * s.tau.z};
  return s;
}

/// The larger of two speeds; not a number if one of them is not.
template <class Real>
Real faster(const Real& a, const Real& b) {
  return select((a > b) || is_nan(a), a, b);
}

/// |u_n| + the fastest wave: bounds the step.
template <class G, class Real>
Real signal_speed(const FluidFace<G, Real>& s) {
  return magnitude(s.u.x) + s.c1;
}
template <class G, class Real>
Real signal_speed(const SolidFace<G, Real>& s) {
  return magnitude(s.u.x) + faster(s.c1, s.cs);
}

}  // namespace cobasis
