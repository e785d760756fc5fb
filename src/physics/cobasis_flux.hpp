// The cobasis on unstructured meshes: fluctuations per face instead of the paper's (24), (25), weighted by the phase's
// volume in the cell update. All are written for the normal n from left to right and for the side whose outward normal
// is n; the other side's fluctuation has the opposite sign.
#pragma once

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
