#include "physics/face_state.hpp"

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>

#include "math/dual.hpp"
#include "physics/material_library.hpp"
#include "random_states.hpp"

using namespace cobasis;

namespace {

template <class Real>
Real traction(const Symmetric<Space, Real>& S, const Point& along, const Point& normal) {
  const Rows<Real> m = matrix(S);
  Real sum(0.0);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) sum = sum + list(along)[i] * list(normal)[j] * m[i][j];
  return sum;
}

/// e with slope e_i' = -n_i (e·w): what a gradient of the velocity along n with direction w does, (8).
Cobasis<Space, Dual> sheared(const Cobasis<Space, double>& e, const Point& n, const Point& w) {
  Rows<Dual> r = rows<Dual>(e);
  for (auto& e_beta : r) {
    const double along = e_beta[0].value * w.x + e_beta[1].value * w.y + e_beta[2].value * w.z;
    for (int i = 0; i < 3; ++i) e_beta[i].slope = -list(n)[i] * along;
  }
  return cobasis_of(r);
}

/// (1/rho) d sigma_1i / d(gradient of velocity k along n), i and k tangential.
struct AcousticTensor {
  double smallest, largest;  ///< eigenvalues [m^2/s^2]
  double asymmetry;
};
AcousticTensor acoustic_tensor(const HyperelasticMaterial& m, const Cobasis<Space, double>& e, double rho,
                               const Frame<Space, double>& frame) {
  const Point tangents[] = {frame.t1, frame.t2};
  Eigen::Matrix2d A;
  for (int k = 0; k < 2; ++k) {
    const Symmetric<Space, Dual> S =
        deviatoric_stress(m, Dual(rho), normalised_metric(sheared(e, frame.n, tangents[k])));
    for (int i = 0; i < 2; ++i) A(i, k) = traction(S, tangents[i], frame.n).slope / rho;
  }
  const Eigen::Vector2d eigenvalues =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(0.5 * (A + A.transpose()), Eigen::EigenvaluesOnly).eigenvalues();
  return {eigenvalues[0], eigenvalues[1], A(0, 1) - A(1, 0)};
}

SolidState<Space, double> solid_state(const Cobasis<Space, double>& e, double rho, double p, double ch2) {
  SolidState<Space, double> s;
  s.rho = rho, s.u = {30, -20, 10}, s.p = p, s.ch2 = ch2, s.E = 1e6;
  s.g = normalised_metric(e);
  return s;
}

const HyperelasticMaterial& elastic(const char* name) { return *find_material(name)->elastic; }

}  // namespace

TEST_CASE("traction on a face is the stress (6) seen in its frame") {
  Random random(1);
  for (int sample = 0; sample < 200; ++sample) {
    const HyperelasticMaterial m{92e9, 8900, random.between(-1, 0.5)};
    const Frame<Space, double> frame = random.frame();
    const SolidState<Space, double> s = solid_state(random.cobasis(0.8), 9100, 3e9, 1e7);
    const SolidFace<Space, double> f = face_state(m, s, frame);
    const Symmetric<Space, double> S = deviatoric_stress(m, s.rho, s.g);
    const double scale = std::fabs(S.xx) + std::fabs(S.yy) + std::fabs(S.zz) + m.mu;
    CHECK(std::fabs(f.P - (s.p - traction(S, frame.n, frame.n))) < 1e-12 * scale);
    CHECK(std::fabs(f.tau.y - traction(S, frame.t1, frame.n)) < 1e-12 * scale);
    CHECK(std::fabs(f.tau.z - traction(S, frame.t2, frame.n)) < 1e-12 * scale);
    CHECK(f.u.x == Approx(dot(frame.n, s.u)));
    CHECK(f.rho == s.rho);
    CHECK(f.E == s.E);
  }
}

TEST_CASE("rho c1^2 is the derivative of -sigma_11 along the longitudinal family da = a, drho = rho, dp = c_h^2 rho") {
  const double a = GENERATE(-1.0, 0.0, 0.5);
  Random random(2);
  for (int sample = 0; sample < 300; ++sample) {
    const HyperelasticMaterial m{92e9, 8900, a};
    const Frame<Space, double> frame = random.frame();
    const Cobasis<Space, double> e = random.cobasis(0.6);
    const double rho = random.magnitude(5e3, 2e4), ch2 = random.magnitude(1e7, 1e8);
    const SolidFace<Space, double> f = face_state(m, solid_state(e, rho, 3e9, ch2), frame);

    Point minus_n = -1.0 * frame.n;
    const Symmetric<Space, Dual> g = normalised_metric(sheared(e, frame.n, minus_n));
    const Dual S11 = traction(deviatoric_stress(m, Dual(rho, rho), g), frame.n, frame.n);
    const double c1_squared = ch2 - S11.slope / rho;
    CAPTURE(a, sample);
    CHECK(f.c1 * f.c1 == Approx(c1_squared).epsilon(1e-12));
  }
}

TEST_CASE("c_s^2 is the largest eigenvalue of the tangential acoustic tensor") {
  const double a = GENERATE(-1.0, 0.0, 0.5);
  Random random(3);
  for (int sample = 0; sample < 300; ++sample) {
    const HyperelasticMaterial m{92e9, 8900, a};
    const Frame<Space, double> frame = random.frame();
    const Cobasis<Space, double> e = random.cobasis(0.8);
    const double rho = random.magnitude(5e3, 2e4);
    const AcousticTensor A = acoustic_tensor(m, e, rho, frame);
    CAPTURE(a, sample);
    CHECK(std::fabs(A.asymmetry) < 1e-11 * A.largest);
    const SolidFace<Space, double> f = face_state(m, solid_state(e, rho, 3e9, 1e7), frame);
    CHECK(f.cs * f.cs == Approx(A.largest).epsilon(1e-11));
  }
}

TEST_CASE("wave speeds at rest are those of the paper's materials") {
  struct Row {
    const char* name;
    double c1, cs;
  };
  for (const Row& row :
       {Row{"aluminium", 6317.7, 3103.2}, Row{"copper", 5470.1, 3215.1}, Row{"carbopol", 48.710, 0.2887}}) {
    CAPTURE(row.name);
    const Material& material = *find_material(row.name);
    const auto& eos = std::get<StiffenedGas>(material.eos);
    Random random(4);
    const Cobasis<Space, double> identity{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const double ch2 = eos.sound_speed_squared(material.rho0, 1e5);
    const SolidFace<Space, double> f =
        face_state(elastic(row.name), solid_state(identity, material.rho0, 1e5, ch2), random.frame());
    CHECK(f.c1 == Approx(row.c1).epsilon(1e-5));
    CHECK(f.cs == Approx(row.cs).epsilon(2e-4));
    CHECK(f.P == Approx(1e5).margin(1e-4 * material.elastic->mu * 1e-10));
    CHECK(f.c1 * f.c1 ==
          Approx((eos.gamma * (1e5 + eos.p_inf) + 4.0 / 3 * material.elastic->mu) / material.rho0).epsilon(1e-13));
    CHECK(f.cs * f.cs == Approx(material.elastic->mu / material.rho0).epsilon(1e-13));
  }
}

TEST_CASE("the elastic parts of the squared speeds are positive for a in [-1, 0.5], and not far beyond") {
  Random random(5);
  const auto undefined = [&](double a) {
    const HyperelasticMaterial m{92e9, 8900, a};
    int count = 0;
    for (int sample = 0; sample < 5000; ++sample) {
      const Cobasis<Space, double> e = random.cobasis(1.5);
      const Frame<Space, double> frame = random.frame();
      const SolidFace<Space, double> f = face_state(m, solid_state(e, 8900, 0, 0), frame);
      const AcousticTensor A = acoustic_tensor(m, e, 8900, frame);
      if (!(f.c1 > 0) || !(A.smallest > -1e-12 * A.largest)) ++count;
    }
    return count;
  };
  for (const double a : {-1.0, -0.5, 0.0, 0.25, 0.5}) {
    CAPTURE(a);
    CHECK(undefined(a) == 0);
  }
  for (const double a : {-1.1, 0.6}) {
    CAPTURE(a);
    CHECK(undefined(a) > 0);
  }
}

TEST_CASE("a plane face sees what a space face sees under plane strain") {
  Random random(6);
  for (int sample = 0; sample < 200; ++sample) {
    const HyperelasticMaterial m{26e9, 2700, random.between(-1, 0.5)};
    const auto [e, h] = plane_strain(random);
    const double angle = random.between(0, 6.28), nx = std::cos(angle), ny = std::sin(angle);
    const Frame<Plane, double> plane_frame{{nx, ny, {}}, {-ny, nx, {}}, {{}, {}, 1}};
    const Frame<Space, double> space_frame{{nx, ny, 0}, {-ny, nx, 0}, {0, 0, 1}};
    SolidState<Plane, double> s;
    s.rho = 2800, s.u = {30, -20, {}}, s.p = 3e9, s.ch2 = 4e7, s.E = 1e6, s.g = normalised_metric(e);
    const SolidFace<Plane, double> f = face_state(m, s, plane_frame);
    SolidState<Space, double> t = solid_state(h, 2800, 3e9, 4e7);
    t.u = {30, -20, 0};
    const SolidFace<Space, double> k = face_state(m, t, space_frame);
    CHECK(f.P == Approx(k.P).epsilon(1e-14));
    CHECK(f.c1 == Approx(k.c1).epsilon(1e-14));
    CHECK(f.cs == Approx(k.cs).epsilon(1e-14));
    CHECK(std::fabs(f.tau.y - k.tau.y) < 1e-14 * m.mu);
    CHECK(k.tau.z == 0);
    CHECK(f.u.x == Approx(k.u.x));
    CHECK(f.u.y == Approx(k.u.y));
  }
}

TEST_CASE("a solid with mu = 0 has the traction and speeds of a fluid") {
  Random random(7);
  const SolidState<Space, double> s = solid_state(random.cobasis(0.5), 1000, 2e5, 2.25e6);
  const Frame<Space, double> frame = random.frame();
  const SolidFace<Space, double> f = face_state(HyperelasticMaterial{0, 1000, 0.5}, s, frame);
  const FluidFace<Space, double> fluid = face_state(static_cast<const FluidState<Space, double>&>(s), frame);
  CHECK(f.P == fluid.P);
  CHECK(f.c1 == fluid.c1);
  CHECK(f.cs == 0);
  CHECK(f.tau.y == 0);
  CHECK(f.tau.z == 0);
  CHECK(signal_speed(f) == signal_speed(fluid));
}

TEST_CASE("a mirrored face state is that of the mirrored solid") {
  Random random(8);
  for (int sample = 0; sample < 50; ++sample) {
    const HyperelasticMaterial m{26e9, 2700, 0.5};
    const Frame<Space, double> frame = random.frame();
    const auto reflect = [&](const Point& v) { return v - (2 * dot(v, frame.n)) * frame.n; };
    const Cobasis<Space, double> e = random.cobasis(0.5);
    SolidState<Space, double> s = solid_state(e, 2800, 3e9, 4e7);
    const SolidFace<Space, double> image = mirrored(face_state(m, s, frame));
    s.u = reflect(s.u);
    // the reflection has determinant -1; the metric is that of -e as well
    s.g = normalised_metric(Cobasis<Space, double>{-1.0 * reflect(e.e1), -1.0 * reflect(e.e2), -1.0 * reflect(e.e3)});
    const SolidFace<Space, double> reflected = face_state(m, s, frame);
    CHECK(image.P == Approx(reflected.P).epsilon(1e-13));
    CHECK(image.c1 == Approx(reflected.c1).epsilon(1e-13));
    CHECK(image.cs == Approx(reflected.cs).epsilon(1e-13));
    CHECK(std::fabs(image.tau.y - reflected.tau.y) < 1e-12 * m.mu);
    CHECK(std::fabs(image.tau.z - reflected.tau.z) < 1e-12 * m.mu);
    CHECK(std::fabs(image.u.x - reflected.u.x) < 1e-12);
    CHECK(std::fabs(image.u.y - reflected.u.y) < 1e-12);
  }
}

TEST_CASE("a wave speed that is not a number makes the signal speed one that is not") {
  Random random(9);
  SolidFace<Space, double> s = random.face();
  s.c1 = std::nan("");
  CHECK(std::isnan(signal_speed(s)));
  s = random.face();
  s.cs = std::nan("");
  CHECK(std::isnan(signal_speed(s)));
}
