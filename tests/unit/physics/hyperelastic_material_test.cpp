#include "physics/hyperelastic_material.hpp"

#include <catch2/catch.hpp>

#include "math/dual.hpp"
#include "random_states.hpp"

using namespace cobasis;

namespace {

HyperelasticMaterial copper(double a) { return {92e9, 8900, a}; }

}  // namespace

TEST_CASE("the stress (6) is the power-conjugate derivative of the stored energy (5)") {
  // rho De^e/Dt = S:grad u with De/Dt = -(grad u)^T e gives S_ij = -rho d e^e / d eps along de_i = eps e_j
  const double a = GENERATE(-1.0, 0.0, 0.5);
  Random random(1);
  for (int sample = 0; sample < 200; ++sample) {
    const Cobasis<Space, double> e = random.cobasis(0.8);
    const double rho = random.magnitude(1e3, 2e4);
    const Rows<double> S = matrix(deviatoric_stress(copper(a), rho, normalised_metric(e)));
    double scale = 0;
    for (const auto& row : S)
      for (const double s : row) scale = std::max(scale, std::fabs(s));
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        Rows<Dual> turned = rows<Dual>(e);
        for (auto& e_beta : turned) e_beta[i].slope = e_beta[j].value;
        const Dual energy = elastic_energy(copper(a), normalised_metric(cobasis_of(turned)));
        CAPTURE(a, sample, i, j);
        CHECK(std::fabs(S[i][j] + rho * energy.slope) < 1e-12 * scale);
      }
    }
  }
}

TEST_CASE("a solid without deformation, or purely compressed, stores no elastic energy and bears no stress") {
  const double a = GENERATE(-1.0, 0.0, 0.3, 0.5), stretch = GENERATE(1.0, 0.7, 1.9);
  const Cobasis<Space, double> e{{stretch, 0, 0}, {0, stretch, 0}, {0, 0, stretch}};
  const Symmetric<Space, double> g = normalised_metric(e);
  const double unit = copper(a).mu / copper(a).rho0;
  CHECK(std::fabs(elastic_energy(copper(a), g)) < 1e-15 * unit);
  for (const auto& row : matrix(deviatoric_stress(copper(a), 8900.0, g)))
    for (const double s : row) CHECK(std::fabs(s) < 1e-15 * copper(a).mu);
}

TEST_CASE("the metric has determinant one and does not feel a change of volume or a turn of the reference") {
  Random random(2);
  for (int sample = 0; sample < 200; ++sample) {
    const Cobasis<Space, double> e = random.cobasis(1.0);
    const Symmetric<Space, double> g = normalised_metric(e);
    const double det =
        g.xx * (g.yy * g.zz - g.yz * g.yz) - g.xy * (g.xy * g.zz - g.yz * g.xz) + g.xz * (g.xy * g.yz - g.yy * g.xz);
    CHECK(det == Approx(1).epsilon(1e-12));

    const Frame<Space, double> q = random.frame();
    const Rows<double> r = rows<double>(e);
    Rows<double> other{};
    for (int beta = 0; beta < 3; ++beta)
      for (int i = 0; i < 3; ++i)
        other[beta][i] = 1.3 * (list(q.n)[beta] * r[0][i] + list(q.t1)[beta] * r[1][i] + list(q.t2)[beta] * r[2][i]);
    const Rows<double> before = matrix(g), after = matrix(normalised_metric(cobasis_of(other)));
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) CHECK(std::fabs(before[i][j] - after[i][j]) < 1e-13 * trace(g));
  }
}

TEST_CASE("the stress has no trace and turns with the solid") {
  Random random(3);
  for (int sample = 0; sample < 200; ++sample) {
    const double a = random.between(-1, 0.5), rho = 9000;
    const Cobasis<Space, double> e = random.cobasis(0.7);
    const Frame<Space, double> q = random.frame();
    const auto turn = [&](const Point& v) { return out_of_frame(q, v); };
    const Symmetric<Space, double> S = deviatoric_stress(copper(a), rho, normalised_metric(e));
    const Symmetric<Space, double> turned = deviatoric_stress(
        copper(a), rho, normalised_metric(Cobasis<Space, double>{turn(e.e1), turn(e.e2), turn(e.e3)}));
    const double scale = std::fabs(S.xx) + std::fabs(S.yy) + std::fabs(S.zz) + copper(a).mu;
    CHECK(std::fabs(trace(S)) < 1e-13 * scale);
    const Rows<double> m = matrix(turned);
    const Point axes[] = {q.n, q.t1, q.t2};
    const Rows<double> before = matrix(S);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        double component = 0;
        for (int k = 0; k < 3; ++k)
          for (int l = 0; l < 3; ++l) component += list(axes[i])[k] * m[k][l] * list(axes[j])[l];
        CHECK(std::fabs(component - before[i][j]) < 1e-12 * scale);
      }
    }
  }
}

TEST_CASE("metric, energy and stress of a plane scene are those of space under plane strain") {
  Random random(4);
  for (int sample = 0; sample < 100; ++sample) {
    const HyperelasticMaterial m = copper(random.between(-1, 0.5));
    const auto [plane, space] = plane_strain(random);
    const Symmetric<Plane, double> g = normalised_metric(plane);
    const Symmetric<Space, double> h = normalised_metric(space);
    CHECK(determinant(plane) == determinant(space));
    CHECK(g.xx == h.xx);
    CHECK(g.yy == h.yy);
    CHECK(g.zz == h.zz);
    CHECK(g.xy == h.xy);
    CHECK(h.xz == 0);
    CHECK(h.yz == 0);
    CHECK(elastic_energy(m, g) == elastic_energy(m, h));
    const Symmetric<Plane, double> S = deviatoric_stress(m, 9000.0, g);
    const Symmetric<Space, double> T = deviatoric_stress(m, 9000.0, h);
    CHECK(S.xx == T.xx);
    CHECK(S.yy == T.yy);
    CHECK(S.zz == T.zz);
    CHECK(S.xy == T.xy);
  }
}
