// Appendices A and B of the paper: the sub-systems are hyperbolic, with the closed-form speeds that the program uses.
// The matrices of the quasi-linear forms come from dual numbers. Units in which mu and rho0 are one.
#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <iomanip>
#include <sstream>

#include "math/dual.hpp"
#include "physics/eos.hpp"
#include "random_states.hpp"

using namespace cobasis;

namespace {

// alpha, rho, u, v, w, a^1 a^2 a^3, b^1 ..., c^1 ..., p
constexpr int n = 15, alpha = 0, rho = 1, u = 2, a = 5, p = 14;
using Matrix = Eigen::Matrix<double, n, n>;

/// A phase and what it meets at an interface.
struct State {
  HyperelasticMaterial material{1, 1, 0.5};
  StiffenedGas eos{3.4, 1.2};
  double alpha = 0.6, rho = 1.1, p = 0.3;
  Point u{0.2, -0.4, 0.3};
  Cobasis<Space, double> e{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  ///< components (a^beta, b^beta, c^beta)
  double u_I = 0.7;
  std::array<double, 3> sigma_I{-0.5, 0.1, 0.2};  ///< sigma_11, sigma_12, sigma_13 there
};

State random_state(Random& random, double strain) {
  State s;
  s.material.a = random.between(-1, 0.5);
  s.alpha = random.between(0.1, 0.9), s.rho = random.magnitude(0.5, 2), s.p = random.between(-0.5, 2);
  s.u = {random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
  s.e = random.cobasis(strain);
  s.u_I = random.between(5, 6);  // another speed than all waves have
  return s;
}

/// sigma_11, sigma_12, sigma_13 and their derivatives: [i][variable].
struct Stress {
  std::array<double, 3> value;
  std::array<std::array<double, n>, 3> slope{};
};
Stress stress(const State& s) {
  Stress result{};
  for (int j = 0; j < n; ++j) {
    Rows<Dual> e = rows<Dual>(s.e);
    if (j >= a && j < p) e[(j - a) % 3][(j - a) / 3].slope = 1;
    const Dual density(s.rho, j == rho), pressure(s.p, j == p);
    const Symmetric<Space, Dual> S = deviatoric_stress(s.material, density, normalised_metric(cobasis_of(e)));
    const Dual sigma[] = {S.xx - pressure, S.xy, S.xz};
    for (int i = 0; i < 3; ++i) result.value[i] = sigma[i].value, result.slope[i][j] = sigma[i].slope;
  }
  return result;
}

/// The parts of W_t + A W_x = 0: what moves with the phase, and what the gradient of each velocity and each of the
/// stresses do.
struct Parts {
  bool transport;
  std::array<bool, 3> direction;  ///< 1: sub-system 1; 2, 3: the others
};
constexpr Parts sub_system_1{true, {true, false, false}}, sub_system_2{false, {false, true, false}},
    sub_system_3{false, {false, false, true}}, sub_systems_2_and_3{false, {false, true, true}},
    whole{true, {true, true, true}};

Matrix jacobian(const State& s, const Parts& parts) {
  Matrix A = Matrix::Zero();
  const Stress sigma = stress(s);
  const Rows<double> e = rows<double>(s.e);
  const double ch2 = s.eos.sound_speed_squared(s.rho, s.p);
  if (parts.transport) {
    A.diagonal().setConstant(s.u.x);
    A(alpha, alpha) = s.u_I;
  }
  for (int i = 0; i < 3; ++i) {
    if (!parts.direction[i]) continue;
    for (int j = 0; j < n; ++j) A(u + i, j) -= sigma.slope[i][j] / s.rho;
    A(u + i, alpha) -= (sigma.value[i] - s.sigma_I[i]) / (s.alpha * s.rho);
    for (int beta = 0; beta < 3; ++beta) A(a + beta, u + i) += e[beta][i];  // (8)
  }
  if (parts.direction[0]) {  // mass, and p at constant entropy: with u_x goes (u - u_I) alpha_x / alpha
    const double jump = (s.u.x - s.u_I) / s.alpha;
    A(rho, u) += s.rho, A(rho, alpha) += s.rho * jump;
    A(p, u) += s.rho * ch2, A(p, alpha) += s.rho * ch2 * jump;
    for (int beta = 0; beta < 3; ++beta) A(a + beta, alpha) += e[beta][0] * jump;
  }
  return A;
}

/// Ascending; `largest_imaginary` of all.
struct Spectrum {
  std::vector<double> values;
  double largest_imaginary = 0;
};
Spectrum spectrum(const Matrix& A) {
  Spectrum result;
  const Eigen::EigenSolver<Matrix> solver(A, false);
  for (int i = 0; i < n; ++i) {
    result.values.push_back(solver.eigenvalues()[i].real());
    result.largest_imaginary = std::max(result.largest_imaginary, std::fabs(solver.eigenvalues()[i].imag()));
  }
  std::ranges::sort(result.values);
  return result;
}

/// Independent eigenvectors of an eigenvalue.
int multiplicity(const Matrix& A, double value) {
  const Matrix difference = A - value * Matrix::Identity();
  const auto singular = Eigen::JacobiSVD<Matrix>(difference).singularValues();
  int count = 0;
  for (int i = 0; i < n; ++i) count += singular[i] < 1e-10 * singular[0];
  return count;
}

/// c2^2 and c3^2 of Appendix B.
std::array<double, 2> shear_speeds(const State& s) {
  const Symmetric<Space, double> g = normalised_metric(s.e);
  const double kappa = s.material.kappa(), A = s.material.a, j1 = trace(g);
  return {std::sqrt(kappa * (2 * g.xy * g.xy + j1 * g.yy) +
                    A * (2 * g.xy * g.xy + g.xx * g.yy + g.yy * g.yy + g.yz * g.yz)),
          std::sqrt(kappa * (2 * g.xz * g.xz + j1 * g.zz) +
                    A * (2 * g.xz * g.xz + g.xx * g.zz + g.zz * g.zz + g.yz * g.yz))};
}

SolidFace<Space, double> face(const State& s) {
  SolidState<Space, double> state;
  state.rho = s.rho, state.u = s.u, state.p = s.p, state.ch2 = s.eos.sound_speed_squared(s.rho, s.p), state.E = 1;
  state.g = normalised_metric(s.e);
  return face_state(s.material, state, Frame<Space, double>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
}

void check_equal(const std::vector<double>& found, std::vector<double> expected) {
  std::ranges::sort(expected);
  REQUIRE(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    CAPTURE(i);
    CHECK(std::fabs(found[i] - expected[i]) < 1e-7 * (1 + std::fabs(expected[i])));
  }
}

}  // namespace

TEST_CASE("sub-system 1 is hyperbolic: u twelve times, u_I, and u +- c1, with 15 eigenvectors (Appendix A)") {
  Random random(21);
  for (int sample = 0; sample < 200; ++sample) {
    const State s = random_state(random, 0.6);
    const Matrix A = jacobian(s, sub_system_1);
    const double c1 = face(s).c1;
    const Spectrum found = spectrum(A);
    CAPTURE(sample, s.material.a);
    CHECK(found.largest_imaginary < 1e-6);
    std::vector<double> expected(12, s.u.x);
    expected.insert(expected.end(), {s.u_I, s.u.x - c1, s.u.x + c1});
    check_equal(found.values, expected);
    CHECK(multiplicity(A, s.u.x) == 12);
    CHECK(multiplicity(A, s.u_I) == 1);
    // the formula of the appendix: dp/drho - dS11/drho - (1/rho) dS11/da . a
    const Stress sigma = stress(s);
    double c1_squared = s.eos.sound_speed_squared(s.rho, s.p) - sigma.slope[0][rho];
    for (int beta = 0; beta < 3; ++beta) c1_squared -= rows<double>(s.e)[beta][0] * sigma.slope[0][a + beta] / s.rho;
    CHECK(c1 * c1 == Approx(c1_squared).epsilon(1e-12));
  }
}

TEST_CASE("sub-systems 2 and 3 are hyperbolic: zero 13 times and +- c2, or +- c3, with 15 eigenvectors (Appendix B)") {
  Random random(22);
  for (int sample = 0; sample < 200; ++sample) {
    const State s = random_state(random, 0.6);
    const auto speeds = shear_speeds(s);
    for (const int i : {0, 1}) {
      CAPTURE(sample, s.material.a, i);
      const Matrix A = jacobian(s, i == 0 ? sub_system_2 : sub_system_3);
      const Spectrum found = spectrum(A);
      CHECK(found.largest_imaginary < 1e-6);
      std::vector<double> expected(13, 0.0);
      expected.insert(expected.end(), {-speeds[i], speeds[i]});
      check_equal(found.values, expected);
      CHECK(multiplicity(A, 0) == 13);
    }
  }
}

TEST_CASE("sub-systems 2 and 3 together have the joint shear speed as their fastest, which bounds c2 and c3") {
  Random random(23);
  for (int sample = 0; sample < 200; ++sample) {
    const State s = random_state(random, 0.6);
    const Spectrum found = spectrum(jacobian(s, sub_systems_2_and_3));
    const auto speeds = shear_speeds(s);
    const double cs = face(s).cs;
    CAPTURE(sample, s.material.a);
    CHECK(found.largest_imaginary < 1e-6);
    CHECK(found.values.back() == Approx(cs).epsilon(1e-9));
    CHECK(found.values.front() == Approx(-cs).epsilon(1e-9));
    CHECK(std::max(speeds[0], speeds[1]) <= cs * (1 + 1e-12));
    CHECK(multiplicity(jacobian(s, sub_systems_2_and_3), 0) == 11);
  }
}

namespace {

/// Of the whole system: fastest, middle and slowest wave, relative to the phase.
struct Waves {
  double fast, middle, slow, largest_imaginary;
};
Waves waves_of_whole(State s) {
  s.u_I = 1e3;  // the largest eigenvalue
  Spectrum found = spectrum(jacobian(s, whole));
  REQUIRE(found.values.back() == Approx(s.u_I));
  const auto speed = [&](int i) { return found.values[n - 1 - i] - s.u.x; };
  return {speed(1), speed(2), speed(3), found.largest_imaginary};
}

}  // namespace

TEST_CASE("the whole system is hyperbolic, its fastest wave between max(c1, c_s) and sqrt(c1^2 + c_s^2)") {
  Random random(24);
  double imaginary = 0;
  for (int sample = 0; sample < 500; ++sample) {
    State s = random_state(random, 1.0);
    s.p = random.magnitude(1e-3, 2);
    const SolidFace<Space, double> split = face(s);
    const Waves whole_waves = waves_of_whole(s);
    CAPTURE(sample, s.material.a, split.c1, split.cs, whole_waves.fast, whole_waves.slow);
    CHECK(std::max(split.c1, split.cs) <= whole_waves.fast * (1 + 1e-9));
    CHECK(whole_waves.fast <= std::hypot(split.c1, split.cs) * (1 + 1e-9));
    CHECK(whole_waves.slow > 0);
    const auto shear = shear_speeds(s);
    CHECK(whole_waves.slow <= std::min(shear[0], shear[1]) * (1 + 1e-9));
    imaginary = std::max(imaginary, whole_waves.largest_imaginary);
  }
  CHECK(imaginary < 1e-5);
}

TEST_CASE("how far the split speeds bound those of the whole system under simple shear across the face") {
  for (const double parameter : {0.5, 0.0, -1.0}) {
    std::ostringstream table;
    table << "a = " << parameter << ", aluminium; speeds over sqrt(mu / rho0), two over the fast one\n"
          << "shear     c1    c_s   fast middle   slow  max(c1,c_s)  hypot(c1,c_s)\n"
          << std::fixed;
    for (const double shear : {0.0, 0.1, 0.2, 0.5, 1.0, 1.5, 2.0}) {
      State s;
      s.material.a = parameter;
      s.eos = {3.4, 21.5 / 26};
      s.rho = 1, s.p = 0, s.u = {0, 0, 0};
      s.e = {{1, 0, 0}, {-shear, 1, 0}, {0, 0, 1}};  // of y = Y + shear X
      const SolidFace<Space, double> split = face(s);
      const Waves whole_waves = waves_of_whole(s);
      const double larger_one = std::max(split.c1, split.cs), below = larger_one / whole_waves.fast,
                   above = std::hypot(split.c1, split.cs) / whole_waves.fast;
      table << std::setprecision(1) << std::setw(5) << shear << std::setprecision(3);
      for (const double value : {split.c1, split.cs, whole_waves.fast, whole_waves.middle, whole_waves.slow})
        table << std::setw(7) << value;
      table << std::setw(13) << below << std::setw(15) << above << "\n";
      CAPTURE(parameter, shear);
      if (shear == 0) CHECK(below == Approx(1).epsilon(1e-9));
      CHECK(below <= 1 + 1e-9);
      CHECK(below > 0.9);  // a CFL number, which counts max(c1, c_s), is at most 1.1 times as large by the fastest wave
      CHECK(above >= 1 - 1e-9);
    }
    WARN(table.str());
  }
}
