// What a kernel is compiled for: the geometry of the scene and the kind of a phase. A plane scene has no third velocity
// and keeps of the cobasis what plane strain needs: e^1 and e^2 in the plane, e^3 along z.
#pragma once

#include "math/vec3.hpp"

namespace cobasis {

struct Plane {
  static constexpr int dimension = 2;
  static constexpr int n_cobasis = 5;  ///< e^1_x e^1_y e^2_x e^2_y e^3_z
  template <class Real>
  using Third = Zero;
};

struct Space {
  static constexpr int dimension = 3;
  static constexpr int n_cobasis = 9;  ///< e^1_x e^1_y e^1_z e^2_x … e^3_z
  template <class Real>
  using Third = Real;
};

enum class Kind { fluid, solid };

template <class G, class Real>
using Third = typename G::template Third<Real>;

/// A vector in the scene's own dimensions.
template <class G, class Real>
using Vector = Vec3<Real, Real, Third<G, Real>>;

/// Symmetric tensor; what shears out of the plane is Zero in a plane scene.
template <class G, class Real>
struct Symmetric {
  Real xx, yy, zz, xy;
  Third<G, Real> xz, yz;
};

/// e^1, e^2, e^3; F^{-T} = (e^1 e^2 e^3).
template <class G, class Real>
struct Cobasis {
  Vec3<Real, Real, Third<G, Real>> e1, e2;
  Vec3<Third<G, Real>, Third<G, Real>, Real> e3;
};

/// Face frame: unit normal and two unit tangents.
template <class G, class Real>
struct Frame;

template <class Real>
struct Frame<Plane, Real> {
  Vec3<Real, Real, Zero> n, t1;
  Vec3<Zero, Zero, Real> t2;
};
template <class Real>
struct Frame<Space, Real> {
  Vec3<Real, Real, Real> n, t1, t2;
};

template <class G, class Real, class A, class B, class C>
auto into_frame(const Frame<G, Real>& frame, const Vec3<A, B, C>& v) {
  return Vec3{dot(frame.n, v), dot(frame.t1, v), dot(frame.t2, v)};
}
template <class G, class Real, class A, class B, class C>
auto out_of_frame(const Frame<G, Real>& frame, const Vec3<A, B, C>& v) {
  return v.x * frame.n + v.y * frame.t1 + v.z * frame.t2;
}

}  // namespace cobasis
