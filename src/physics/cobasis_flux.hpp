// The cobasis on unstructured meshes: fluctuations per face instead of the paper's (24), (25), weighted by the phase's
// volume in the cell update. All are written for the normal n from left to right and for the side whose outward normal
// is n; the other side's fluctuation has the opposite sign.
#pragma once

#include <array>

#include "math/pack.hpp"
#include "physics/scene_types.hpp"

namespace cobasis {

/// e* = e_s + (r - 1) (e_s·n) n: only the normal component is stretched by sub-system 1.
template <class G, class Real>
Cobasis<G, Real> stretched(const Cobasis<G, Real>& e, const Frame<G, Real>& frame, const Real& r) {
  const auto stretch = [&](const auto& e_beta) { return e_beta + ((r - 1.0) * dot(e_beta, frame.n)) * frame.n; };
  return {stretch(e.e1), stretch(e.e2), stretch(e.e3)};
}

template <class G, class Real>
Cobasis<G, Real> upwind(const Mask<Real>& from_left, const Cobasis<G, Real>& l, const Cobasis<G, Real>& r) {
  const auto pick = [&]<class T>(const T& a, const T& b) {
    if constexpr (std::is_same_v<T, Zero>)
      return Zero{};
    else
      return select(from_left, a, b);
  };
  const auto vector = [&](const auto& a, const auto& b) {
    return Vec3{pick(a.x, b.x), pick(a.y, b.y), pick(a.z, b.z)};
  };
  return {vector(l.e1, r.e1), vector(l.e2, r.e2), vector(l.e3, r.e3)};
}

template <class G, class Real>
Cobasis<G, Real> operator*(const Real& s, const Cobasis<G, Real>& e) {
  return {s * e.e1, s * e.e2, s * e.e3};
}

/// How the vectors of one cobasis are turned among themselves against those of another, as seen along a face: the
/// components 12 (, 13, 23) of R - 1 where r is l times a rotation R by little, in space only half of what turns out of
/// the face. Nothing for the two sides of a wave, whose difference is normal to the face. Bounded for any two.
template <class G, class Real>
std::array<Real, G::dimension == 2 ? 1 : 3> turn(const Cobasis<G, Real>& l, const Cobasis<G, Real>& r,
                                                 const Vector<G, Real>& n) {
  const auto along_face = [&](const auto& a, const auto& b) { return dot(a, b) - dot(a, n) * dot(b, n); };
  const auto part = [&](const auto& l_a, const auto& l_b, const auto& r_a, const auto& r_b) {
    return along_face(l_a, r_b) - along_face(l_b, r_a);
  };
  const auto square = [&](const Cobasis<G, Real>& e) {
    const Real in_plane = along_face(e.e1, e.e1) + along_face(e.e2, e.e2);
    if constexpr (G::dimension == 2)
      return in_plane;
    else
      return in_plane + along_face(e.e3, e.e3);
  };
  const Real scale = 2.0 / larger(square(l) + square(r), Real(1e-300));
  if constexpr (G::dimension == 2)
    return {scale * part(l.e1, l.e2, r.e1, r.e2)};
  else
    return {scale * part(l.e1, l.e2, r.e1, r.e2), scale * part(l.e1, l.e3, r.e1, r.e3),
            scale * part(l.e2, l.e3, r.e2, r.e3)};
}

/// Turns the vectors of a cobasis among themselves, by the rotation (1 + Omega / 2) / (1 - Omega / 2): its metric, and
/// so stress and energy, stay.
template <int D, class Real, std::size_t N, std::size_t T>
void turn_by(std::array<Real, N>& e, const std::array<Real, T>& omega) {
  const auto times = [&](const std::array<Real, N>& v) {  // v Omega
    std::array<Real, N> w;
    if constexpr (D == 2) w[4] = Real(0.0);
    for (int d = 0; d < D; ++d) {
      if constexpr (D == 2) {
        w[d] = -(v[2 + d] * omega[0]);
        w[2 + d] = v[d] * omega[0];
      } else {
        w[d] = -(v[3 + d] * omega[0] + v[6 + d] * omega[1]);
        w[3 + d] = v[d] * omega[0] - v[6 + d] * omega[2];
        w[6 + d] = v[d] * omega[1] + v[3 + d] * omega[2];
      }
    }
    return w;
  };
  Real square(0.0);
  for (const Real& w : omega) square = square + w * w;
  const Real scale = 1.0 / (1.0 + 0.25 * square);
  const auto once = times(e), again = times(once);
  for (std::size_t c = 0; c < N; ++c) e[c] = e[c] + scale * (once[c] + 0.5 * again[c]);
}

/// u (e_f - e_i): transport with the velocity u through the face.
/// + n (e_i·du): deformation by the difference du = u* - u_i of the face's and the cell's velocity.
template <class G, class Real>
Cobasis<G, Real> fluctuation(const Real& u, const Cobasis<G, Real>& e_f, const Cobasis<G, Real>& e_i,
                             const Vector<G, Real>& du, const Frame<G, Real>& frame) {
  const auto term = [&](const auto& f, const auto& i) { return u * (f - i) + dot(i, du) * frame.n; };
  return {term(e_f.e1, e_i.e1), term(e_f.e2, e_i.e2), term(e_f.e3, e_i.e3)};
}

/// Phase that enters a cell it does not own here: u* (e_f - e_i) + n (e_f·n) (u_f - u*), where u_f differs from u* only
/// if the flow is supersonic.
template <class G, class Real>
Cobasis<G, Real> invader_fluctuation(const Real& u_star, const Real& u_f, const Cobasis<G, Real>& e_f,
                                     const Cobasis<G, Real>& e_i, const Frame<G, Real>& frame) {
  const auto term = [&](const auto& f, const auto& i) {
    return u_star * (f - i) + ((u_f - u_star) * dot(f, frame.n)) * frame.n;
  };
  return {term(e_f.e1, e_i.e1), term(e_f.e2, e_i.e2), term(e_f.e3, e_i.e3)};
}

}  // namespace cobasis
