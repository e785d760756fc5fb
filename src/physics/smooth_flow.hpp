// Rates of change of a phase's state where it is smooth, from its gradients: the equations (8) in primitive form.
#pragma once

#include <array>

#include "math/dual.hpp"
#include "physics/hyperelastic_material.hpp"

namespace cobasis {

/// Numbering of the primitive state as a plain array: rho, u, p and of a solid e.
template <class G, Kind K>
struct Primitives {
  static constexpr int D = G::dimension;
  static constexpr int rho = 0, u = 1, p = 1 + D, e = 2 + D;
  static constexpr int n_cobasis = K == Kind::solid ? G::n_cobasis : 0;
  static constexpr int size = e + n_cobasis;

  template <class Real>
  using State = std::array<Real, size>;
  template <class Real>
  using Gradients = std::array<std::array<Real, D>, size>;  ///< [quantity][direction]
};

/// A cobasis from its components: e^1_x e^1_y (e^1_z) e^2_x …, see Plane and Space.
template <class G, class Component>
auto make_cobasis(const Component& component) {
  using Real = decltype(component(0));
  if constexpr (G::dimension == 2) {
    return Cobasis<G, Real>{{component(0), component(1), {}}, {component(2), component(3), {}}, {{}, {}, component(4)}};
  } else {
    return Cobasis<G, Real>{{component(0), component(1), component(2)},
                            {component(3), component(4), component(5)},
                            {component(6), component(7), component(8)}};
  }
}

/// div S [Pa/m]: along each direction the derivative of the stress of a state that varies with its gradient.
template <class G, class Real>
std::array<Real, G::dimension> stress_divergence(
    const HyperelasticMaterial& material, const typename Primitives<G, Kind::solid>::template State<Real>& w,
    const typename Primitives<G, Kind::solid>::template Gradients<Real>& gradient) {
  using P = Primitives<G, Kind::solid>;
  using Number = DualNumber<Real>;
  std::array<Real, G::dimension> force;
  force.fill(Real(0.0));
  for (int d = 0; d < G::dimension; ++d) {
    const auto along = [&](int v) { return Number(w[v], gradient[v][d]); };
    const Symmetric<G, Number> g = normalised_metric(make_cobasis<G>([&](int c) { return along(P::e + c); }));
    const Symmetric<G, Number> S = deviatoric_stress<G, Number>(material, along(P::rho), g);
    const auto add = [&](const auto& S_xd, const auto& S_yd, [[maybe_unused]] const auto& S_zd) {
      force[0] = force[0] + S_xd.slope;
      force[1] = force[1] + S_yd.slope;
      if constexpr (G::dimension == 3) force[2] = force[2] + S_zd.slope;
    };
    if (d == 0) add(S.xx, S.xy, S.xz);
    if (d == 1) add(S.xy, S.yy, S.yz);
    if constexpr (G::dimension == 3)
      if (d == 2) add(S.xz, S.yz, S.zz);
  }
  return force;
}

/// d/dt of (rho, u, p, e) [SI units per s]; ch2: squared sound speed of the hydrodynamic part.
template <class G, Kind K, class Real>
typename Primitives<G, K>::template State<Real> rates_of_change(
    const HyperelasticMaterial& material, const typename Primitives<G, K>::template State<Real>& w,
    const typename Primitives<G, K>::template Gradients<Real>& gradient, const Real& ch2) {
  using P = Primitives<G, K>;
  constexpr int D = G::dimension;
  typename P::template State<Real> rate;
  Real divergence(0.0);
  for (int d = 0; d < D; ++d) divergence = divergence + gradient[P::u + d][d];
  for (int v = 0; v < P::size; ++v) {
    rate[v] = Real(0.0);
    for (int d = 0; d < D; ++d) rate[v] = rate[v] - w[P::u + d] * gradient[v][d];
  }
  rate[P::rho] = rate[P::rho] - w[P::rho] * divergence;
  rate[P::p] = rate[P::p] - w[P::rho] * ch2 * divergence;
  std::array<Real, D> force;
  for (int d = 0; d < D; ++d) force[d] = -gradient[P::p][d];
  if constexpr (K == Kind::solid) {
    const auto elastic = stress_divergence<G, Real>(material, w, gradient);
    for (int d = 0; d < D; ++d) force[d] = force[d] + elastic[d];
    for (int beta = 0; beta < D; ++beta)  // in a plane e^3 is only convected
      for (int i = 0; i < D; ++i)
        for (int j = 0; j < D; ++j)
          rate[P::e + beta * D + i] = rate[P::e + beta * D + i] - gradient[P::u + j][i] * w[P::e + beta * D + j];
  }
  const Real volume = 1.0 / w[P::rho];
  for (int d = 0; d < D; ++d) rate[P::u + d] = rate[P::u + d] + volume * force[d];
  return rate;
}

/// What an axisymmetric scene adds to the rates of a plane one: y is the distance r from the axis, and e^3, the hoop's
/// component R / r, is stretched by u_r / r.
template <Kind K, class Real>
void add_hoop_rates(const HyperelasticMaterial& material, const typename Primitives<Plane, K>::template State<Real>& w,
                    const Real& ch2, const Real& inverse_radius,
                    typename Primitives<Plane, K>::template State<Real>& rate) {
  using P = Primitives<Plane, K>;
  const Real stretching = w[P::u + 1] * inverse_radius;
  rate[P::rho] = rate[P::rho] - w[P::rho] * stretching;
  rate[P::p] = rate[P::p] - w[P::rho] * ch2 * stretching;
  if constexpr (K == Kind::solid) {
    const Symmetric<Plane, Real> g = normalised_metric(make_cobasis<Plane>([&](int c) { return w[P::e + c]; }));
    const Symmetric<Plane, Real> S = deviatoric_stress<Plane, Real>(material, w[P::rho], g);
    const Real lever = inverse_radius / w[P::rho];
    rate[P::u] = rate[P::u] + lever * S.xy;
    rate[P::u + 1] = rate[P::u + 1] + lever * (S.yy - S.zz);
    rate[P::e + 4] = rate[P::e + 4] - stretching * w[P::e + 4];
  }
}

/// -sigma_zz [Pa], what presses along the hoop of an axisymmetric scene.
template <Kind K, class Real>
Real hoop_pressure(const HyperelasticMaterial& material, const typename Primitives<Plane, K>::template State<Real>& w) {
  using P = Primitives<Plane, K>;
  if constexpr (K == Kind::fluid) {
    return w[P::p];
  } else {
    const Symmetric<Plane, Real> g = normalised_metric(make_cobasis<Plane>([&](int c) { return w[P::e + c]; }));
    return w[P::p] - deviatoric_stress<Plane, Real>(material, w[P::rho], g).zz;
  }
}

}  // namespace cobasis
