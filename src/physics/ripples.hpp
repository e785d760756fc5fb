// Surfaces that are compressed along themselves tend to buckle.
#pragma once

#include "physics/face_state.hpp"

namespace cobasis {

/// Speed [m/s] of ripples along a surface of a solid, `surface.n` its normal: sqrt((sigma_nn - sigma_tt) / rho), t the
/// tangent along which it is compressed most. The excess of compression counts from a hundredth of rho c_s^2 on, a
/// strain of 0.3 %: below, and where the surface is stretched, 0. It counts up to 3 mu rho / rho0, where surfaces
/// buckle in truth (neo-Hookean in plane strain: at 0.544 of their length, Biot 1963), and ripples are no faster than
/// sound.
///
/// A layer of thickness h above which the surface lies by eta, its stress sigma_tt along it and sigma_nn in what is
/// around, obeys rho h u_t = -(sigma_nn - sigma_tt) eta_x and eta_t = -h u_x: where it is compressed, a wave.
template <class G, class Real>
Real ripple_speed(const HyperelasticMaterial& material, const SolidState<G, Real>& s, const Frame<G, Real>& surface) {
  const auto& [n, t1, t2] = surface;
  const SolidFace<G, Real> along_n = face_state(material, s, surface);
  Real most;  // compression along the surface [Pa]
  if constexpr (G::dimension == 2) {
    most = face_state(material, s, Frame<G, Real>{t1, -1.0 * n, t2}).P;
  } else {
    const SolidFace<G, Real> along_1 = face_state(material, s, Frame<G, Real>{t1, t2, n}),
                             along_2 = face_state(material, s, Frame<G, Real>{t2, n, t1});
    const Real half = 0.5 * (along_1.P - along_2.P);
    most = 0.5 * (along_1.P + along_2.P) + square_root(half * half + along_1.tau.y * along_1.tau.y);
  }
  constexpr double least = 0.01, buckles = 3;
  const Real excess = (most - along_n.P) / s.rho - least * (along_n.cs * along_n.cs);
  const Real counts = smaller(larger(excess, Real(0.0)), Real(buckles * material.mu / material.rho0));
  return smaller(square_root(counts), along_n.c1);
}

}  // namespace cobasis
