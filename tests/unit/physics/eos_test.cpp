#include "physics/eos.hpp"

#include <catch2/catch.hpp>

#include "math/dual.hpp"
#include "random_states.hpp"

using namespace cobasis;

namespace {

template <class EquationOfState>
void check_laws(const EquationOfState& eos, double highest_pressure, double low_density = 0.1,
                double high_density = 1e4) {
  Random random(1);
  for (int sample = 0; sample < 200; ++sample) {
    const double rho = random.magnitude(low_density, high_density);
    const double p = eos.lowest_pressure() + random.magnitude(1, highest_pressure - eos.lowest_pressure());
    const double scale = std::fabs(p) - eos.lowest_pressure();
    CAPTURE(rho, p);
    const double e = eos.energy(rho, p);
    CHECK(std::fabs(eos.pressure(rho, e) - p) < 1e-14 * scale);
    // along an isentrope de = p / rho^2 drho
    const Dual isentrope = eos.pressure(Dual(rho, 1), Dual(e, p / (rho * rho)));
    CHECK(std::fabs(eos.sound_speed_squared(rho, p) - isentrope.slope) < 1e-13 * scale / rho);
    CHECK(eos.sound_speed_squared(rho, p) > 0);
  }
}

}  // namespace

TEST_CASE("pressure and energy of an equation of state are inverse, its sound speed is sqrt(dp/drho) on an isentrope") {
  SECTION("ideal gas") { check_laws(IdealGas{GENERATE(1.1, 1.4, 5.0 / 3)}, 1e10); }
  SECTION("gas of Noble and Abel") {
    const NobleAbelStiffenedGas water{1.19, 7.028e8, 6.61e-4};
    check_laws(water, 1e10, 0.1, 0.9 * water.densest());
    check_laws(NobleAbelStiffenedGas{1.3, 0, 1e-3}, 1e10, 0.1, 900);
  }
  SECTION("Mie and Grueneisen, compressed and stretched") {
    const MieGruneisen copper{8930, 3940, 1.489, 2.02};
    check_laws(copper, 1e12, 8930, 0.7 * copper.densest());
    check_laws(copper, 1e12, 4000, 8930);
    check_laws(MieGruneisen{1000, 1500, 0.25, 0.5}, 1e10, 500, 2000);
  }
  SECTION("stiffened gas") { check_laws(StiffenedGas{GENERATE(2.2, 4.4), GENERATE(1e6, 21.5e9)}, 1e11); }
}

TEST_CASE("a stiffened gas with p_inf = 0 is an ideal gas") {
  const StiffenedGas stiffened{1.4, 0};
  const IdealGas ideal{1.4};
  CHECK(stiffened.energy(1.2, 1e5) == ideal.energy(1.2, 1e5));
  CHECK(stiffened.pressure(1.2, 2e5) == ideal.pressure(1.2, 2e5));
  CHECK(stiffened.sound_speed_squared(1.2, 1e5) == ideal.sound_speed_squared(1.2, 1e5));
  CHECK(ideal.lowest_pressure() == 0);
  CHECK(stiffened.lowest_pressure() == 0);
}

TEST_CASE("a stiffened gas bears tension down to -p_inf, where its sound speed vanishes") {
  const StiffenedGas water{4.4, 6e8};
  CHECK(water.lowest_pressure() == -6e8);
  CHECK(water.sound_speed_squared(1000.0, -6e8) == 0);
  CHECK(water.pressure(1000.0, water.energy(1000.0, -5e8)) == Approx(-5e8));
}

TEST_CASE("kernels find a gas without covolume to be the ideal or stiffened one, to the last bit") {
  Random random(2);
  for (int sample = 0; sample < 200; ++sample) {
    const double rho = random.magnitude(0.1, 1e4), p = random.magnitude(1, 1e10), e = random.magnitude(1, 1e8);
    const auto check = [&](const auto& law) {
      visit_compiled(law, [&](const auto& compiled) {
        CHECK(compiled.pressure(rho, e) == law.pressure(rho, e));
        CHECK(compiled.energy(rho, p) == law.energy(rho, p));
        CHECK(compiled.sound_speed_squared(rho, p) == law.sound_speed_squared(rho, p));
        CHECK(compiled.lowest_pressure() == law.lowest_pressure());
        CHECK(compiled.densest() == law.densest());
      });
    };
    check(IdealGas{random.between(1.05, 5)});
    check(StiffenedGas{random.between(1.05, 5), random.magnitude(1, 1e11)});
  }
}

TEST_CASE("a gas of Noble and Abel becomes infinitely stiff as its density approaches 1 / b") {
  const NobleAbelStiffenedGas gas{1.3, 0, 1e-3};
  CHECK(gas.densest() == Approx(1000));
  CHECK(gas.sound_speed_squared(999.0, 1e8) > 100 * gas.sound_speed_squared(500.0, 1e8));
  CHECK(gas.pressure(1001.0, 1e5) < gas.lowest_pressure());
}

TEST_CASE("shocks of Mie and Grueneisen's material lie on its line u_s = c0 + s u_p") {
  const MieGruneisen copper{8930, 3940, 1.489, 2.02};
  for (const double u_p : {1.0, 100.0, 1000.0, 3000.0}) {
    const double u_s = copper.c0 + copper.s * u_p, rho = copper.rho0 * u_s / (u_s - u_p);
    CHECK(copper.pressure(rho, 0.5 * u_p * u_p) == Approx(copper.rho0 * u_s * u_p).epsilon(1e-10));
  }
}

TEST_CASE(
    "Mie and Grueneisen's material at rest has p = e = 0 and its c0 and is continuous there") {
  const MieGruneisen copper{8930, 3940, 1.489, 2.02};
  CHECK(copper.pressure(8930.0, 0.0) == 0);
  CHECK(copper.energy(8930.0, 0.0) == 0);
  CHECK(copper.sound_speed_squared(8930.0, 0.0) == Approx(3940.0 * 3940).epsilon(1e-14));
  const double below = 8930 * (1 - 1e-9), above = 8930 * (1 + 1e-9);
  CHECK(copper.sound_speed_squared(below, 0.0) == Approx(copper.sound_speed_squared(above, 0.0)).epsilon(1e-7));
  CHECK(copper.pressure(8000.0, 0.0) < 0);
  // stretched without heat: the cold isentrope de = p / rho^2 drho
  const double rho = 8000, e = 0.5 * std::pow(3940 * (1 - 8930 / rho), 2);
  CHECK(copper.pressure(rho, e) == Approx(8930 * 3940 * 3940.0 * (1 - 8930 / rho)).epsilon(1e-12));
}

TEST_CASE("where Mie and Grueneisen's material is admissible, its sound speed is real") {
  Random random(3);
  for (int sample = 0; sample < 1000; ++sample) {
    MieGruneisen law{random.between(500, 2e4), random.between(500, 9000), random.between(0.5, 2), 0};
    law.gamma0 = random.between(0.1, 2 * law.s);
    const double rho = law.rho0 * random.between(0.3, std::min(3.0, 0.999 * law.densest() / law.rho0));
    CHECK(law.sound_speed_squared(rho, law.lowest_pressure() * (1 - 1e-9)) > 0);
  }
}
