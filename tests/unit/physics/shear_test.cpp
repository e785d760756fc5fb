#include "physics/shear.hpp"

#include <catch2/catch.hpp>

#include "physics/cobasis_flux.hpp"
#include "physics/longitudinal.hpp"
#include "random_states.hpp"

using namespace cobasis;

namespace {

using Side = SolidFace<Space, double>;
using Star = ShearStar<Space, double>;

void check_finite(const Star& star) {
  for (const double x : {star.tau.y, star.tau.z, star.w_l.y, star.w_l.z, star.w_r.y, star.w_r.z})
    CHECK(std::isfinite(x));
}

}  // namespace

TEST_CASE("bonded solids take the exact solution of the linear shear problem") {
  // rho dw/dt = dtau/dx, dtau/dt = rho c^2 dw/dx: tau - z w is constant across the left wave, tau + z w across the
  // right
  Random random(1);
  for (int sample = 0; sample < 1000; ++sample) {
    const Side l = random.face(), r = random.face();
    const Star star = bonded_shear(l, r);
    const double c = std::max(l.cs, r.cs), z_l = l.rho * c, z_r = r.rho * c;
    const double velocity = 1e4, stress = (z_l + z_r) * velocity;
    CHECK(std::fabs((star.tau.y - l.tau.y) - z_l * (star.w_l.y - l.u.y)) < 1e-12 * stress);
    CHECK(std::fabs((star.tau.z - l.tau.z) - z_l * (star.w_l.z - l.u.z)) < 1e-12 * stress);
    CHECK(std::fabs((star.tau.y - r.tau.y) + z_r * (star.w_r.y - r.u.y)) < 1e-12 * stress);
    CHECK(std::fabs((star.tau.z - r.tau.z) + z_r * (star.w_r.z - r.u.z)) < 1e-12 * stress);
    const double softer = std::min(z_l, z_r);  // its velocity carries the round-off of the stress
    CHECK(std::fabs(star.w_l.y - star.w_r.y) < 1e-13 * stress / softer);
    CHECK(std::fabs(star.w_l.z - star.w_r.z) < 1e-13 * stress / softer);
  }
}

TEST_CASE("equal states bonded keep stress and velocity, and a mirror leaves no shear stress and no slip of its own") {
  Random random(2);
  for (int sample = 0; sample < 200; ++sample) {
    const Side s = random.face();
    const Star same = bonded_shear(s, s);
    CHECK(same.tau.y == Approx(s.tau.y).epsilon(1e-14));
    CHECK(same.w_l.y == Approx(s.u.y).epsilon(1e-13));
    CHECK(same.w_r.z == Approx(s.u.z).epsilon(1e-13));
    const Star wall = bonded_shear(s, mirrored(s));
    CHECK(wall.tau.y == 0);
    CHECK(wall.tau.z == 0);
    const double slip = s.tau.y / (s.rho * s.cs);  // the scheme multiplies by the reciprocal: an ulp or two
    CHECK(std::fabs(wall.w_l.y - (s.u.y - slip)) <= 5e-16 * (std::fabs(s.u.y) + std::fabs(slip)));
  }
}

TEST_CASE("without shear modulus on either side nothing is stressed and each side keeps its velocity") {
  Random random(3);
  Side l = random.face(), r = random.face();
  l.cs = r.cs = 0;
  l.tau = r.tau = {{}, 0, 0};
  const Star star = bonded_shear(l, r);
  check_finite(star);
  CHECK(star.tau.y == 0);
  CHECK(star.tau.z == 0);
  CHECK(star.w_l.y == l.u.y);
  CHECK(star.w_l.z == l.u.z);
  CHECK(star.w_r.y == r.u.y);
  CHECK(star.w_r.z == r.u.z);
  const auto free = free_surface_velocity(l, 1.0);
  CHECK(free.y == l.u.y);
  CHECK(free.z == l.u.z);
}

TEST_CASE("a solid bonded to one without shear modulus gives numbers") {
  Random random(4);
  const Side l = random.face();
  Side r = random.face();
  r.cs = 0, r.tau = {{}, 0, 0};
  check_finite(bonded_shear(l, r));
  check_finite(bonded_shear(r, l));
}

TEST_CASE("a surface that slides drops its shear stress through its own wave") {
  Random random(5);
  for (int sample = 0; sample < 200; ++sample) {
    const Side s = random.face();
    const auto left = free_surface_velocity(s, 1.0), right = free_surface_velocity(s, -1.0);
    const double z = s.rho * s.cs;
    CHECK(left.y == Approx(s.u.y - s.tau.y / z).epsilon(1e-14));
    CHECK(left.z == Approx(s.u.z - s.tau.z / z).epsilon(1e-14));
    CHECK(right.y == Approx(s.u.y + s.tau.y / z).epsilon(1e-14));
    CHECK(right.z == Approx(s.u.z + s.tau.z / z).epsilon(1e-14));
  }
}

TEST_CASE("exchanging left and right mirrors the bonded solution") {
  Random random(6);
  for (int sample = 0; sample < 200; ++sample) {
    const Side l = random.face(), r = random.face();
    const auto reversed = [](Side s) {  // seen along -n: sigma_1i changes sign with n, the tangents stay
      s.tau = {{}, -s.tau.y, -s.tau.z};
      return s;
    };
    const Star star = bonded_shear(l, r), image = bonded_shear(reversed(r), reversed(l));
    CHECK(image.tau.y == Approx(-star.tau.y).epsilon(1e-12));
    CHECK(image.w_l.y == Approx(star.w_r.y).epsilon(1e-9));
    CHECK(image.w_r.z == Approx(star.w_l.z).epsilon(1e-9));
  }
}

TEST_CASE("the choice of the tangents does not change what a face does") {
  // momentum, energy and cobasis, in Cartesian components, of a face between two random, strongly sheared solids
  const bool bonded = GENERATE(true, false);
  Random random(7);
  for (int sample = 0; sample < 300; ++sample) {
    const HyperelasticMaterial m[] = {{92e9, 8900, random.between(-1, 0.5)}, {26e9, 2700, random.between(-1, 0.5)}};
    const Cobasis<Space, double> e[] = {random.cobasis(0.3), random.cobasis(0.3)};
    SolidState<Space, double> s[2];
    for (int k = 0; k < 2; ++k) {
      s[k].rho = m[k].rho0 * determinant(e[k]), s[k].p = random.between(-1e9, 1e10), s[k].ch2 = 2e7;
      s[k].u = {random.between(-500, 500), random.between(-500, 500), random.between(-500, 500)};
      s[k].E = 1e6, s[k].g = normalised_metric(e[k]);
    }
    const auto face = [&](const Frame<Space, double>& frame) {
      const Side l = face_state(m[0], s[0], frame), r = face_state(m[1], s[1], frame);
      const LongitudinalStar<double> star = longitudinal<double>(l, r);
      const Flux<Space, double> flux = eulerian_flux<Space>(star, l, r);
      Star shear;
      if (bonded) {
        shear = bonded_shear(l, r);
      } else {
        shear.tau = {{}, 0, 0};
        shear.w_l = free_surface_velocity(l, 1.0), shear.w_r = free_surface_velocity(r, -1.0);
      }
      const Vector<Space, double> momentum = out_of_frame(frame, flux.momentum - shear.tau);
      std::vector<double> result{momentum.x / 1e10, momentum.y / 1e10, momentum.z / 1e10,
                                 (flux.energy - dot(shear.tau, shear.w_l)) / 1e13};
      const Cobasis<Space, double> e_f = stretched(upwind(star.from_left, e[0], e[1]), frame, star.r);
      const auto keep = [&](const Cobasis<Space, double>& change) {
        for (const auto& e_beta : rows<double>(change))
          for (const double x : e_beta) result.push_back(x / 1e3);
      };
      keep(fluctuation(star.u_f, e_f, e[0],
                       out_of_frame(frame, Vec3{star.u_f - l.u.x, shear.w_l.y - l.u.y, shear.w_l.z - l.u.z}), frame));
      keep(fluctuation(star.u_f, e_f, e[1],
                       out_of_frame(frame, Vec3{star.u_f - r.u.x, shear.w_r.y - r.u.y, shear.w_r.z - r.u.z}), frame));
      return result;
    };
    const Frame<Space, double> frame = random.frame();
    const std::vector<double> one = face(frame), other = face(random.turned(frame));
    for (std::size_t i = 0; i < one.size(); ++i) {
      CAPTURE(bonded, sample, i, one[i], other[i]);
      CHECK(std::fabs(one[i] - other[i]) < 1e-12);
    }
  }
}

TEST_CASE("solids that rub are bonded as long as that takes less than Coulomb's bound, and slip freely under none") {
  Random random(8);
  for (int sample = 0; sample < 300; ++sample) {
    const Side l = random.face(), r = random.face();
    const Star bonded = bonded_shear(l, r), held = rubbing_shear(l, r, 1e300), loose = rubbing_shear(l, r, 0.0);
    CHECK((held.tau.y == bonded.tau.y && held.tau.z == bonded.tau.z));
    CHECK((held.w_l.y == bonded.w_l.y && held.w_l.z == bonded.w_l.z));
    CHECK((held.w_r.y == bonded.w_r.y && held.w_r.z == bonded.w_r.z));
    const auto left = free_surface_velocity(l, 1.0), right = free_surface_velocity(r, -1.0);
    CHECK((loose.tau.y == 0 && loose.tau.z == 0));
    CHECK((loose.w_l.y == left.y && loose.w_l.z == left.z));
    CHECK((loose.w_r.y == right.y && loose.w_r.z == right.z));
  }
}

TEST_CASE("solids that slip under friction take its stress against the slip, which the waves of both reduce") {
  Random random(9);
  for (int sample = 0; sample < 300; ++sample) {
    const Side l = random.face(), r = random.face();
    const double z_l = l.rho * l.cs, z_r = r.rho * r.cs;
    // the slip that is left where nothing holds, and the stress that would end it
    const Star loose = rubbing_shear(l, r, 0.0);
    const double slip_y = loose.w_r.y - loose.w_l.y, slip_z = loose.w_r.z - loose.w_l.z,
                 slip = std::hypot(slip_y, slip_z);
    const double needed = slip / (1 / z_l + 1 / z_r), most = needed * random.between(0.01, 0.99);
    const Star star = rubbing_shear(l, r, most);
    CHECK(std::hypot(star.tau.y, star.tau.z) == Approx(most).epsilon(1e-12));
    CHECK(star.tau.y * slip_y + star.tau.z * slip_z == Approx(most * slip).epsilon(1e-9));
    const double left = std::hypot(star.w_r.y - star.w_l.y, star.w_r.z - star.w_l.z);
    CHECK(left == Approx(slip - most * (1 / z_l + 1 / z_r)).epsilon(1e-7));
    CHECK(star.tau.y * (star.w_r.y - star.w_l.y) + star.tau.z * (star.w_r.z - star.w_l.z) >= 0);
  }
}
