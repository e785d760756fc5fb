#include "physics/cobasis_flux.hpp"

#include <catch2/catch.hpp>

#include "physics/longitudinal.hpp"
#include "physics/shear.hpp"
#include "physics/smooth_flow.hpp"
#include "random_states.hpp"

using namespace cobasis;

namespace {

using Numbers = Rows<double>;

double largest(const Numbers& rows) {
  double x = 0;
  for (const auto& row : rows)
    for (const double value : row) x = std::max(x, std::fabs(value));
  return x;
}

template <class F>
Numbers per_entry(F&& f) {
  Numbers result;
  for (int beta = 0; beta < 3; ++beta)
    for (int i = 0; i < 3; ++i) result[beta][i] = f(beta, i);
  return result;
}

double along(const Numbers& e, int beta, const Point& v) {
  return e[beta][0] * v.x + e[beta][1] * v.y + e[beta][2] * v.z;
}

/// A solid on each side, `jump` of everything apart.
struct Contact {
  Frame<Space, double> frame;
  Cobasis<Space, double> e[2];
  Point u[2];
  SolidFace<Space, double> side[2];
  LongitudinalStar<double> star;
  ShearStar<Space, double> shear;

  Contact(Random random, double jump) {
    const HyperelasticMaterial m{92e9, 8900, 0.2};
    frame = random.frame();
    const Rows<double> middle = rows<double>(random.cobasis(0.3)), slope = rows<double>(random.cobasis(0.3));
    const Point mean{random.between(100, 500), random.between(-500, 500), random.between(-500, 500)};
    const Point du{random.between(-500, 500), random.between(-500, 500), random.between(-500, 500)};
    for (int k = 0; k < 2; ++k) {
      const double half = (k - 0.5) * jump;
      e[k] = cobasis_of<double>(per_entry([&](int beta, int i) { return middle[beta][i] + half * slope[beta][i]; }));
      u[k] = mean + half * du;
      SolidState<Space, double> s;
      s.rho = m.rho0 * determinant(e[k]), s.u = u[k], s.p = 1e9, s.ch2 = 2e7, s.E = 1e6, s.g = normalised_metric(e[k]);
      side[k] = face_state(m, s, frame);
    }
    star = longitudinal<double>(side[0], side[1]);
    shear = bonded_shear(side[0], side[1]);
  }
  Cobasis<Space, double> at_face() const { return stretched(upwind(star.from_left, e[0], e[1]), frame, star.r); }
  Numbers fluctuation_of(int k) const {
    const auto& w = k == 0 ? shear.w_l : shear.w_r;
    const Point du = out_of_frame(frame, Vec3{star.u_f - side[k].u.x, w.y - side[k].u.y, w.z - side[k].u.z});
    return rows<double>(fluctuation(star.u_f, at_face(), e[k], du, frame));
  }
};

}  // namespace

TEST_CASE("between equal states the cobasis does not change, to the last bit of the longitudinal part") {
  Random random(1);
  for (int sample = 0; sample < 100; ++sample) {
    const Contact same(Random(sample), 0);
    CHECK(largest(same.fluctuation_of(0)) < 1e-10);  // [m/s]; velocities of 500 m/s
    CHECK(largest(same.fluctuation_of(1)) < 1e-10);
    const Cobasis<Space, double> e = random.cobasis(0.3), f = stretched(e, random.frame(), 1.0);
    CHECK(largest(rows<double>(fluctuation(300.0, f, e, Point{0, 0, 0}, random.frame()))) == 0);
  }
}

TEST_CASE(
    "both sides together change the cobasis by the jumps of (8): u·n [e] + n (e·[u]), to second order in the jump") {
  for (int sample = 0; sample < 50; ++sample) {
    const auto defect = [&](double jump) {
      const Contact c(Random(sample), jump);
      const Numbers left = c.fluctuation_of(0), right = c.fluctuation_of(1);
      const Numbers e0 = rows<double>(c.e[0]), e1 = rows<double>(c.e[1]);
      const Point mean = 0.5 * (c.u[0] + c.u[1]), du = c.u[1] - c.u[0];
      return largest(per_entry([&](int beta, int i) {
        const double e_du = 0.5 * (along(e0, beta, du) + along(e1, beta, du));
        const double law = dot(mean, c.frame.n) * (e1[beta][i] - e0[beta][i]) + list(c.frame.n)[i] * e_du;
        return (left[beta][i] - right[beta][i]) - law;
      }));
    };
    CAPTURE(sample, defect(0.02), defect(0.01));
    CHECK(defect(0.01) < 0.27 * defect(0.02));
    CHECK(defect(0.001) < 1e-2);
    CHECK(defect(0.1) > 0);
  }
}

TEST_CASE("the longitudinal wave carries the jump of the cobasis with its speed: D = S (e* - e)") {
  for (int sample = 0; sample < 100; ++sample) {
    Random random(sample);
    const SolidFace<Space, double> l = random.face(500), r = random.face(500);
    const LongitudinalStar<double> star = longitudinal<double>(l, r);
    const SolidFace<Space, double>& s = star.from_left ? l : r;
    const double S = s.u.x + star.mass_speed / s.rho;
    if (!(star.u_f == star.u_star)) continue;
    const Frame<Space, double> frame = random.frame();
    const Cobasis<Space, double> e = random.cobasis(0.3), e_star = stretched(e, frame, star.r);
    const Numbers D = rows<double>(fluctuation(star.u_f, e_star, e, (star.u_f - s.u.x) * frame.n, frame));
    const Numbers before = rows<double>(e), after = rows<double>(e_star);
    const double scale = (std::fabs(S) + std::fabs(star.u_f)) * (1 + largest(after));
    CHECK(largest(per_entry([&](int beta, int i) { return D[beta][i] - S * (after[beta][i] - before[beta][i]); })) <
          1e-12 * scale);
  }
}

TEST_CASE("the longitudinal stretch multiplies det e, and so the density, by r") {
  Random random(2);
  for (int sample = 0; sample < 100; ++sample) {
    const Cobasis<Space, double> e = random.cobasis(0.5);
    const double r = random.magnitude(0.2, 5);
    CHECK(determinant(stretched(e, random.frame(), r)) == Approx(r * determinant(e)).epsilon(1e-12));
  }
}

TEST_CASE("a phase that enters through a foreign contact brings n [a_f u_f - a_i u*] + u* (e_f,t - e_i,t)") {
  Random random(3);
  for (int sample = 0; sample < 100; ++sample) {
    const Frame<Space, double> frame = random.frame();
    const Cobasis<Space, double> e_f = random.cobasis(0.4), e_i = random.cobasis(0.4);
    const double u_star = random.between(0, 500), u_f = random.between(0, 500);
    const Numbers D = rows<double>(invader_fluctuation(u_star, u_f, e_f, e_i, frame));
    const Numbers f = rows<double>(e_f), i = rows<double>(e_i);
    CHECK(largest(per_entry([&](int beta, int c) {
            const double a_f = along(f, beta, frame.n), a_i = along(i, beta, frame.n), n = list(frame.n)[c];
            const double tangential = (f[beta][c] - a_f * n) - (i[beta][c] - a_i * n);
            return D[beta][c] - (n * (a_f * u_f - a_i * u_star) + u_star * tangential);
          })) < 1e-12 * 500 * 10);
  }
}

TEST_CASE("fluctuations of plane strain are those of space") {
  Random random(4);
  for (int sample = 0; sample < 100; ++sample) {
    const auto [e, h] = plane_strain(random);
    const auto [f, k] = plane_strain(random);
    const double angle = random.between(0, 6.28), nx = std::cos(angle), ny = std::sin(angle);
    const Frame<Plane, double> plane{{nx, ny, {}}, {-ny, nx, {}}, {{}, {}, 1}};
    const Frame<Space, double> space{{nx, ny, 0}, {-ny, nx, 0}, {0, 0, 1}};
    const Cobasis<Plane, double> d = fluctuation(200.0, stretched(f, plane, 1.2), e, Vec3{30.0, -40.0, Zero{}}, plane);
    const Numbers D = rows<double>(fluctuation(200.0, stretched(k, space, 1.2), h, Point{30, -40, 0}, space));
    const Numbers plane_rows{{{d.e1.x, d.e1.y, 0}, {d.e2.x, d.e2.y, 0}, {0, 0, d.e3.z}}};
    CHECK(largest(per_entry([&](int beta, int i) { return D[beta][i] - plane_rows[beta][i]; })) < 1e-12);
  }
}

namespace {

/// e R with the rotation R by `angle` about an axis, as it acts on the numbers of the vectors.
Numbers turned(const Numbers& e, double angle, const Point& axis) {
  const double c = std::cos(angle), s = std::sin(angle);
  const double n[3] = {axis.x, axis.y, axis.z};
  const double cross[3][3] = {{0, -n[2], n[1]}, {n[2], 0, -n[0]}, {-n[1], n[0], 0}};
  return per_entry([&](int beta, int i) {
    double sum = 0;
    for (int a = 0; a < 3; ++a) sum += e[a][i] * ((a == beta ? c : 0) + s * cross[a][beta] + (1 - c) * n[a] * n[beta]);
    return sum;
  });
}

std::array<double, 9> in_a_row(const Numbers& e) {
  std::array<double, 9> row;
  for (int c = 0; c < 9; ++c) row[c] = e[c / 3][c % 3];
  return row;
}

}  // namespace

TEST_CASE("what turns between two cobases is undone by the turns along a few faces") {
  Random random(3);
  for (int i = 0; i < 20; ++i) {
    const Numbers l = rows<double>(random.cobasis(0.2));
    const Numbers r = turned(l, 0.5, random.frame().n);
    const Frame<Space, double> frame = random.frame();
    auto e = in_a_row(l);
    for (int pass = 0; pass < 40; ++pass)
      for (const Point& n : {frame.n, frame.t1, frame.t2}) {
        const auto present = make_cobasis<Space>([&](int c) { return e[c]; });
        const auto omega = turn(present, cobasis_of<double>(r), n), back = turn(cobasis_of<double>(r), present, n);
        for (int c = 0; c < 3; ++c) CHECK(omega[c] == Approx(-back[c]).margin(1e-15));
        turn_by<3>(e, omega);
      }
    const auto wanted = in_a_row(r);
    for (int c = 0; c < 9; ++c) CHECK(e[c] == Approx(wanted[c]).margin(1e-12));
  }
}

TEST_CASE("the two sides of a wave, whose cobases differ along its normal alone, do not turn") {
  Random random(3);
  for (int i = 0; i < 20; ++i) {
    const Numbers l = rows<double>(random.cobasis(0.2));
    const Point n = random.frame().n;
    const double by[3] = {random.between(-0.5, 0.5), random.between(-0.5, 0.5), random.between(-0.5, 0.5)};
    const double normal[3] = {n.x, n.y, n.z};
    const Numbers r = per_entry([&](int beta, int d) { return l[beta][d] + by[beta] * normal[d]; });
    for (const double w : turn(cobasis_of<double>(l), cobasis_of<double>(r), n)) CHECK(std::fabs(w) < 1e-15);
  }
}

TEST_CASE("a turn of any size leaves the metric of a cobasis, and no two cobases make more than a bounded one") {
  Random random(3);
  for (int i = 0; i < 50; ++i) {
    const Numbers l = rows<double>(random.cobasis(0.4)), r = rows<double>(random.cobasis(0.4));
    const Numbers far = turned(r, random.between(0, 3.1), random.frame().n);
    const auto omega = turn(cobasis_of<double>(l), cobasis_of<double>(far), random.frame().n);
    for (const double w : omega) CHECK(std::fabs(w) <= 1);
    for (const double size : {0.1, 1.0, 100.0}) {
      auto e = in_a_row(l);
      std::array<double, 3> by{size * omega[0], size * omega[1], size * omega[2]};
      turn_by<3>(e, by);
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) {
          double before = 0, after = 0;
          for (int beta = 0; beta < 3; ++beta) {
            before += l[beta][a] * l[beta][b];
            after += e[3 * beta + a] * e[3 * beta + b];
          }
          CHECK(after == Approx(before).margin(1e-12));
        }
    }
  }
}

TEST_CASE("turns in plane strain are those of space about the third vector") {
  Random random(3);
  for (int i = 0; i < 20; ++i) {
    Numbers l = rows<double>(random.cobasis(0.2));
    l[0][2] = l[1][2] = l[2][0] = l[2][1] = 0;
    const double angle = random.between(-0.5, 0.5);
    const Numbers r = turned(l, angle, {0, 0, 1});
    const auto in_plane = [](const Numbers& e) {
      return make_cobasis<Plane>([&](int c) { return c == 4 ? e[2][2] : e[c / 2][c % 2]; });
    };
    const auto omega = turn(in_plane(l), in_plane(r), Vector<Plane, double>{0.6, -0.8, {}});
    CHECK(omega[0] == Approx(-std::sin(angle)).epsilon(1e-12));
    std::array<double, 5> e{l[0][0], l[0][1], l[1][0], l[1][1], l[2][2]};
    auto whole = in_a_row(l);
    turn_by<2>(e, omega);
    turn_by<3>(whole, std::array<double, 3>{omega[0], 0, 0});
    for (int c = 0; c < 5; ++c) CHECK(e[c] == Approx(whole[c == 4 ? 8 : 3 * (c / 2) + c % 2]).margin(1e-14));
  }
}
