// The stored energy (5) of an isotropic hyperelastic solid, its stress (6) and its wave speeds, as functions of
// g = G / |G|^{1/3}, G_ij = sum over beta of e^beta_i e^beta_j.
#pragma once

#include <array>
#include <string_view>

#include "math/field_info.hpp"
#include "math/pack.hpp"
#include "physics/scene_types.hpp"

namespace cobasis {

struct HyperelasticMaterial {
  double mu = 0;    ///< shear modulus [Pa]
  double rho0 = 1;  ///< density of the undeformed solid [kg/m^3]
  double a = 0.5;   ///< parameter of the stored energy [-]; the splitting is hyperbolic for a in [-1, 0.5]

  static constexpr std::array<FieldInfo<HyperelasticMaterial>, 3> fields() {
    return {
        {{"mu", "Pa", &HyperelasticMaterial::mu, 0, infinity, true, false, "shear modulus"},
         {"rho0", "kg/m^3", &HyperelasticMaterial::rho0, 0, infinity, false, false, "density of the undeformed solid"},
         {"a", "-", &HyperelasticMaterial::a, -1, 0.5, true, true, "parameter of the stored energy"}}};
  }

  double kappa() const { return (1 - 2 * a) / 3; }
};

template <class G, class Real>
Real trace(const Symmetric<G, Real>& g) {
  return g.xx + g.yy + g.zz;
}

/// j2 = tr g^2
template <class G, class Real>
Real trace_of_square(const Symmetric<G, Real>& g) {
  return g.xx * g.xx + g.yy * g.yy + g.zz * g.zz + 2.0 * (g.xy * g.xy + g.xz * g.xz + g.yz * g.yz);
}

/// det F^{-T} = det(e^1 e^2 e^3) = rho / rho0
template <class G, class Real>
Real determinant(const Cobasis<G, Real>& e) {
  return dot(cross(e.e1, e.e2), e.e3);
}

/// |G|^{-1/3}, |G| = det(e)^2
template <class G, class Real>
Real metric_scale(const Cobasis<G, Real>& e) {
  const Real root = cube_root(determinant(e));
  return 1.0 / (root * root);
}

/// g = G / |G|^{1/3} from e and its metric_scale.
template <class G, class Real>
Symmetric<G, Real> scaled_metric(const Cobasis<G, Real>& e, const Real& scale) {
  return {.xx = scale * (e.e1.x * e.e1.x + e.e2.x * e.e2.x + e.e3.x * e.e3.x),
          .yy = scale * (e.e1.y * e.e1.y + e.e2.y * e.e2.y + e.e3.y * e.e3.y),
          .zz = scale * (e.e1.z * e.e1.z + e.e2.z * e.e2.z + e.e3.z * e.e3.z),
          .xy = scale * (e.e1.x * e.e1.y + e.e2.x * e.e2.y + e.e3.x * e.e3.y),
          .xz = scale * (e.e1.x * e.e1.z + e.e2.x * e.e2.z + e.e3.x * e.e3.z),
          .yz = scale * (e.e1.y * e.e1.z + e.e2.y * e.e2.z + e.e3.y * e.e3.z)};
}

template <class G, class Real>
Symmetric<G, Real> normalised_metric(const Cobasis<G, Real>& e) {
  return scaled_metric(e, metric_scale(e));
}

/// e^e [J/kg]; zero, with the stress, at g = I.
template <class G, class Real>
Real elastic_energy(const HyperelasticMaterial& m, const Symmetric<G, Real>& g) {
  const Real j1 = trace(g), j2 = trace_of_square(g);
  return m.mu / (4 * m.rho0) * (m.kappa() * j1 * j1 + m.a * j2 + 3 * (m.a - 1));  // (5)
}

/// S, the deviatoric stress [Pa].
template <class G, class Real>
Symmetric<G, Real> deviatoric_stress(const HyperelasticMaterial& m, const Real& rho, const Symmetric<G, Real>& g) {
  const Real j1 = trace(g), j2 = trace_of_square(g);
  const Real scale = -m.mu * rho / m.rho0;
  const auto component = [&](const auto& g_ij, const auto& g2_ij) {
    return scale * (m.kappa() * j1 * g_ij + m.a * g2_ij);
  };
  const Real mean = scale * (m.kappa() * j1 * j1 + m.a * j2) / 3.0;
  return {.xx = component(g.xx, g.xx * g.xx + g.xy * g.xy + g.xz * g.xz) - mean,  // (6)
          .yy = component(g.yy, g.xy * g.xy + g.yy * g.yy + g.yz * g.yz) - mean,
          .zz = component(g.zz, g.xz * g.xz + g.yz * g.yz + g.zz * g.zz) - mean,
          .xy = component(g.xy, g.xx * g.xy + g.xy * g.yy + g.xz * g.yz),
          .xz = component(g.xz, g.xx * g.xz + g.xy * g.yz + g.xz * g.zz),
          .yz = component(g.yz, g.xy * g.xz + g.yy * g.yz + g.yz * g.zz)};
}

}  // namespace cobasis
