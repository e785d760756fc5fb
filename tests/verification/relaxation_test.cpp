// Phases that are mixed: drag and stiff limits against exact laws. The mixtures are uniform, so that nothing but
// relaxation happens in them.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "measures.hpp"

using namespace cobasis;
using namespace cobasis::test;

namespace {

/// 30 % water and 70 % air, unless `states` says otherwise.
Scene mixture(const std::string& relaxation, const std::string& states, double end_time, double cfl = 0.8,
              const std::string& mesh = "box.geo") {
  return make_scene(fmt::format("mesh = \"@{}\"\nmesh_parameters = {{ n = 4, element = {} }}\nend_time = {}\n"
                                "cfl = {}\n[phase.water]\nmaterial = \"water\"\n[phase.air]\nmaterial = \"air\"\n"
                                "[relaxation]\n\"water-air\" = {}\n"
                                "[[region]]\nshape = \"everywhere\"\nalpha = {{ water = 0.3, air = 0.7 }}\n{}\n"
                                "[boundary]\n\"*\" = \"transmissive\"\n",
                                mesh, mesh == "box.geo" ? 3 : 4, end_time, cfl, relaxation, states),
                    ranks());
}

const std::string slipping =
    "phase.water = { density = 1000.0, pressure = 2e5, velocity = [3.0, -1.0] }\n"
    "phase.air = { density = 1.2, pressure = 1e5, velocity = [-40.0, 20.0] }\n";

struct Sums {
  double mass, momentum_x, momentum_y, energy;
};
/// Of all phases in a cell, per volume.
Sums sums(const Scene& scene, std::int32_t cell) {
  Sums sums{};
  for (const Phase& phase : scene.solver->fields().phases) {
    sums.mass += phase.conserved[0][cell];
    sums.energy += phase.conserved[1 + scene.solver->fields().dimension][cell];
    sums.momentum_x += phase.conserved[1][cell], sums.momentum_y += phase.conserved[2][cell];
  }
  return sums;
}
void check_conserved(const Sums& now, const Sums& before) {
  CHECK(now.mass == Approx(before.mass).epsilon(1e-14));
  CHECK(now.momentum_x == Approx(before.momentum_x).epsilon(1e-13).margin(1e-9 * now.mass));
  CHECK(now.momentum_y == Approx(before.momentum_y).epsilon(1e-13).margin(1e-9 * now.mass));
  CHECK(now.energy == Approx(before.energy).epsilon(1e-14));
}

/// e - u^2 / 2 of a phase [J/kg].
double internal(const PhaseSnapshot& phase, std::int32_t cell) {
  const double u = phase.velocity[0][cell], v = phase.velocity[1][cell];
  return phase.energy[cell] - 0.5 * (u * u + v * v);
}

}  // namespace

TEST_CASE("drag lets the slip of two phases decay exponentially, exactly in steps of any length") {
  const double drag = 2e4, time = 2e-4, cfl = GENERATE(0.8, 0.05);
  const std::string mesh = GENERATE(as<std::string>{}, "box.geo", "box_space.geo");
  Scene scene = mixture(fmt::format("{{ velocity = {} }}", drag), slipping, time, cfl, mesh);
  const Sums before = sums(scene, 0);
  const double e_water = internal(Result(scene).phase("water"), 0), e_air = internal(Result(scene).phase("air"), 0);
  scene.run();
  CAPTURE(mesh, cfl, scene.solver->step());
  const Result result(scene);
  const PhaseSnapshot &water = result.phase("water"), &air = result.phase("air");
  const double m_w = 0.3 * 1000, m_a = 0.7 * 1.2, kept = std::exp(-drag * 0.3 * 0.7 * (1 / m_w + 1 / m_a) * time);
  CHECK(kept < 0.5);
  const double u_0 = -43, v_0 = 21;
  for (const std::int32_t cell : {0, result.cells() / 2, result.cells() - 1}) {
    CHECK(air.velocity[0][cell] - water.velocity[0][cell] == Approx(u_0 * kept).epsilon(1e-11));
    CHECK(air.velocity[1][cell] - water.velocity[1][cell] == Approx(v_0 * kept).epsilon(1e-11));
    check_conserved(sums(scene, cell), before);
    // each phase keeps what it loses of its kinetic energy in the frame of the common velocity
    const double lost = 0.5 * (u_0 * u_0 + v_0 * v_0) * (1 - kept * kept);
    const double of_water = m_a / (m_w + m_a), of_air = m_w / (m_w + m_a);
    CHECK(internal(air, cell) - e_air == Approx(of_air * of_air * lost).epsilon(1e-9));
    CHECK(internal(water, cell) - e_water == Approx(of_water * of_water * lost).margin(1e-9 * e_water));
    CHECK(water.alpha[cell] == Approx(0.3).epsilon(1e-14));
  }
}

TEST_CASE("stiff drag gives two phases their common velocity in a step, and what is lost heats them") {
  Scene scene = mixture("{ velocity = \"stiff\" }", slipping, 1);
  const Sums before = sums(scene, 0);
  const double e_water = internal(Result(scene).phase("water"), 0), e_air = internal(Result(scene).phase("air"), 0);
  scene.run(1);
  const Result result(scene);
  const PhaseSnapshot &water = result.phase("water"), &air = result.phase("air");
  const Sums now = sums(scene, 3);
  check_conserved(now, before);
  CHECK(water.velocity[0][3] == Approx(before.momentum_x / before.mass).epsilon(1e-13));
  CHECK(air.velocity[0][3] == Approx(before.momentum_x / before.mass).epsilon(1e-12));
  CHECK(air.velocity[1][3] == Approx(before.momentum_y / before.mass).epsilon(1e-12));
  const double m_w = 300, m_a = 0.84, square = 43 * 43 + 21 * 21;
  CHECK(internal(air, 3) - e_air == Approx(0.5 * square * m_w * m_w / ((m_w + m_a) * (m_w + m_a))).epsilon(1e-9));
  CHECK(m_w * (internal(water, 3) - e_water) + m_a * (internal(air, 3) - e_air) ==
        Approx(0.5 * square * m_w * m_a / (m_w + m_a)).margin(1e-13 * m_w * e_water));
}

namespace {

/// A stiffened gas that fills alpha at the pressure p, as its pressure comes to p_I by work of that pressure.
struct Filled {
  double gamma, p_inf, alpha, p;
  /// From rho e = (p + gamma p_inf) / (gamma - 1) and e + p_I v constant.
  double at(double p_I) const { return alpha * (p + gamma * p_inf + (gamma - 1) * p_I) / (gamma * (p_I + p_inf)); }
  /// Own pressure where it fills `filled`.
  double pressure(double filled, double p_I) const {
    const double energy = alpha * (p + gamma * p_inf) / (gamma - 1) - p_I * (filled - alpha);
    return (gamma - 1) * energy / filled - gamma * p_inf;
  }
};

/// Both at one pressure and the same volume as before: A p^2 + B p + C = 0.
double common_pressure(const Filled& a, const Filled& b) {
  const auto part = [](const Filled& g) {  // filled = (first + second p_I) / (p_I + p_inf)
    return std::pair(g.alpha * (g.p + g.gamma * g.p_inf) / g.gamma, g.alpha * (g.gamma - 1) / g.gamma);
  };
  const auto [a_1, a_2] = part(a);
  const auto [b_1, b_2] = part(b);
  const double sum = a.alpha + b.alpha;
  const double A = sum - a_2 - b_2, B = sum * (a.p_inf + b.p_inf) - a_1 - b_1 - a_2 * b.p_inf - b_2 * a.p_inf,
               C = sum * a.p_inf * b.p_inf - a_1 * b.p_inf - b_1 * a.p_inf;
  return B > 0 ? -2 * C / (B + std::sqrt(B * B - 4 * A * C)) : (-B + std::sqrt(B * B - 4 * A * C)) / (2 * A);
}

const std::string squeezed =
    "phase.water = { density = 1000.0, pressure = 5e8 }\nphase.air = { density = 50.0, pressure = 1e5 }\n";
const Filled water_filled{4.4, 6e8, 0.3, 5e8}, air_filled{1.4, 0, 0.7, 1e5};

}  // namespace

TEST_CASE("stiff relaxation of pressures gives two phases the mixed cell's equilibrium in a step") {
  Scene scene = mixture("{ pressure = \"stiff\" }", squeezed, 1);
  const Sums before = sums(scene, 0);
  scene.run(1);
  const double p = common_pressure(water_filled, air_filled);
  const Result result(scene);
  const PhaseSnapshot &water = result.phase("water"), &air = result.phase("air");
  INFO("common pressure " << p << ", of water " << water.pressure[5] << ", of air " << air.pressure[5]);
  CHECK(p > 1e5);
  CHECK(air.pressure[5] == Approx(p).epsilon(1e-10));
  CHECK(std::fabs(water.pressure[5] - p) < 1e-10 * (p + 6e8));
  CHECK(water.alpha[5] == Approx(water_filled.at(p)).epsilon(1e-12));
  CHECK(air.alpha[5] == Approx(air_filled.at(p)).epsilon(1e-12));
  check_conserved(sums(scene, 5), before);
  scene.run(5);  // at rest it stays
  CHECK(Result(scene).phase("water").alpha[5] == Approx(water_filled.at(p)).epsilon(1e-12));
}

TEST_CASE("pressures relax at a finite rate as their equation says, in steps of any length, to the same equilibrium") {
  const double time = 2e-4, p_I = common_pressure(water_filled, air_filled), cfl = GENERATE(0.8, 0.1);
  const double rate = GENERATE(4e-6, 2e-3);
  // d alpha / dt = R alpha_l alpha_m (p_l - p_m), by Runge and Kutta
  double filled = 0.3;
  const auto slope = [&](double x) {
    return rate * x * (1 - x) * (water_filled.pressure(x, p_I) - air_filled.pressure(1 - x, p_I));
  };
  constexpr int steps = 20000;
  for (int i = 0; i < steps; ++i) {
    const double h = time / steps, a = slope(filled), b = slope(filled + 0.5 * h * a), c = slope(filled + 0.5 * h * b),
                 d = slope(filled + h * c);
    filled += h / 6 * (a + 2 * b + 2 * c + d);
  }
  Scene scene = mixture(fmt::format("{{ pressure = {} }}", rate), squeezed, time, cfl);
  const Sums before = sums(scene, 0);
  scene.run();
  const Result result(scene);
  const double alpha = result.phase("water").alpha[5], rest = water_filled.at(p_I);
  INFO(fmt::format("cfl {}, rate {}, {} steps: alpha {:.9f}, expected {:.9f}, at rest {:.9f}", cfl, rate,
                   scene.solver->step(), alpha, filled, rest));
  CHECK(std::fabs(alpha - filled) < 1e-4 * (rest - 0.3));
  if (rate > 1e-3) CHECK(result.phase("air").pressure[5] == Approx(p_I).epsilon(1e-3));
  check_conserved(sums(scene, 5), before);
}

TEST_CASE("solids take part with their volume: shape, elastic energy and rho / (rho0 det e) stay") {
  Scene scene = make_scene(R"(mesh = "@box.geo"
mesh_parameters = { n = 4, element = 4 }
end_time = 1
scheme = { order = 1 }
[phase.copper]
material = "copper"
[phase.air]
material = "air"
[phase.iron]
eos = { type = "mie_gruneisen", rho0 = 7850.0, c0 = 4570.0, s = 1.5, gamma0 = 1.7 }
elastic = { mu = 80e9, rho0 = 7850.0, a = 0.5 }
[relaxation]
"copper-air" = { pressure = "stiff", velocity = "stiff" }
"iron-copper" = { pressure = "stiff" }
[[region]]
shape = "everywhere"
alpha = { copper = 0.5, air = 0.2, iron = 0.3 }
phase.copper = { pressure = 2e9, velocity = [1.0, 0.0], cobasis = [[1.02, 0.1, 0.0], [0.03, 0.99, 0.0], [0.0, 0.0, 1.01]] }
phase.air = { pressure = 1e6, density = 10.0, velocity = [1.0, 0.0] }
phase.iron = { pressure = 1e9, velocity = [1.0, 0.0], density = 7900.0 }
[boundary]
"*" = "transmissive"
)",
                           ranks());
  const auto elastic_energy_of = [](const Scene& of, int k) {
    const auto& phase = of.solver->fields().phases[k];
    const auto& e = phase.conserved;
    const double det = (e[4][0] * e[7][0] - e[5][0] * e[6][0]) * e[8][0];
    return std::pair(det * phase.alpha[0] * phase.material.rho0 / e[0][0],
                     (e[4][0] * e[4][0] + e[6][0] * e[6][0]) / std::pow(det, 2.0 / 3));
  };
  const Sums before = sums(scene, 0);
  const auto copper = elastic_energy_of(scene, 0), iron = elastic_energy_of(scene, 2);
  scene.run(1);
  const Result result(scene);
  check_conserved(sums(scene, 0), before);
  CHECK(elastic_energy_of(scene, 0).first == Approx(copper.first).epsilon(1e-14));
  CHECK(elastic_energy_of(scene, 0).second == Approx(copper.second).epsilon(1e-13));
  CHECK(elastic_energy_of(scene, 2).first == Approx(iron.first).epsilon(1e-14));
  CHECK(elastic_energy_of(scene, 2).second == Approx(iron.second).epsilon(1e-13));
  CHECK(result.phase("copper").pressure[0] == Approx(result.phase("iron").pressure[0]).epsilon(1e-9));
  // pairs one after the other: nothing of iron and air is relaxed
  CHECK(result.phase("copper").alpha[0] + result.phase("air").alpha[0] + result.phase("iron").alpha[0] ==
        Approx(1).epsilon(1e-15));
  CHECK(std::fabs(result.phase("air").pressure[0] / result.phase("iron").pressure[0] - 1) > 1e-3);
}

TEST_CASE("water and air bursting into each other with stiff relaxation move as one in every cell and conserve all") {
  Scene scene = make_case("water_air",
                          {{"mesh_parameters.n", "200"},
                           {"end_time", "1e-4"},
                           {"relaxation.water-air", "{ velocity = \"stiff\", pressure = \"stiff\" }"}},
                          ranks());
  CHECK(scene.setup.scheme.interface == InterfaceTreatment::diffuse);
  const double water = balance(*scene.solver, "mass.water"), air = balance(*scene.solver, "mass.air"),
               energy = balance_of_phases(scene, "energy");
  scene.run();
  const Result result(scene);
  int mixed = 0;
  for (std::int32_t cell = 0; cell < result.cells(); ++cell) {
    const PhaseSnapshot &w = result.phase("water"), &a = result.phase("air");
    if (!(w.alpha[cell] > 1e-6 && a.alpha[cell] > 1e-6)) continue;
    ++mixed;
    CHECK(std::fabs(w.velocity[0][cell] - a.velocity[0][cell]) < 1e-9 * 500);
    CHECK(std::fabs(w.pressure[cell] - a.pressure[cell]) < 1e-6 * (w.pressure[cell] + 6e8));
  }
  CHECK(mixed > 2);
  CHECK(balance(*scene.solver, "mass.water") == Approx(water).epsilon(1e-13));
  CHECK(balance(*scene.solver, "mass.air") == Approx(air).epsilon(1e-13));
  CHECK(balance_of_phases(scene, "energy") == Approx(energy).epsilon(1e-13));
}

// 1 / (rho c^2) = sum of alpha_k / (rho_k c_k^2), rho the mixture's
TEST_CASE("weak waves in a mixture with stiff relaxation are Wood's") {
  const int order = GENERATE(1, 2);
  const double p = 5e8, rho = 0.5 * 1000 + 0.5 * 500, stiffness = 1 / (0.5 / (4.4 * (p + 6e8)) + 0.5 / (1.4 * p)),
               c = std::sqrt(stiffness / rho), time = 1.6e-4;
  Scene scene = make_scene(fmt::format(R"(mesh = "@tube.geo"
mesh_parameters = {{ n = 400 }}
end_time = {}
scheme = {{ order = {} }}
[phase.water]
material = "water"
[phase.air]
material = "air"
density = 500
[relaxation]
"water-air" = {{ velocity = "stiff", pressure = "stiff" }}
[[region]]
shape = "everywhere"
alpha = {{ water = 0.5, air = 0.5 }}
pressure = 5e8
velocity = ["x < 0.5 ? 1 : -1", 0]
[boundary]
left = "transmissive"
right = "transmissive"
"*" = "symmetry"
)",
                                       time, order),
                           ranks());
  scene.run();
  const Result result(scene);
  const double behind = mean(
      scene, [&](auto cell) { return result.mixture.pressure[cell]; },
      [&](auto cell) { return std::fabs(result.centre(cell).x - 0.5) < 0.5 * c * time; });
  double low = 1, high = 0;  // where the pressure has risen by half
  for (std::int32_t cell = 0; cell < result.cells(); ++cell)
    if (result.mixture.pressure[cell] > p + 0.5 * rho * c) {
      low = std::min(low, result.centre(cell).x);
      high = std::max(high, result.centre(cell).x);
    }
  INFO("order " << order << ": rise of pressure " << behind - p << ", by Wood's speed " << rho * c << "; waves at "
                << low << " and " << high << ", by Wood's speed " << c << " m/s at " << 0.5 - c * time << " and "
                << 0.5 + c * time);
  CHECK(behind - p == Approx(rho * c).epsilon(5e-3));
  CHECK(high - low == Approx(2 * c * time).epsilon(1e-2));
}
