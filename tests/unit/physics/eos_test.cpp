#include "physics/eos.hpp"

#include <catch2/catch.hpp>

#include "math/dual.hpp"
#include "random_states.hpp"

using namespace cobasis;

namespace {

template <class EquationOfState>
void check_laws(const EquationOfState& eos, double highest_pressure) {
  Random random(1);
  for (int sample = 0; sample < 200; ++sample) {
    const double rho = random.magnitude(0.1, 1e4);
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
