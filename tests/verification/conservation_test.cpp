// What is in a closed box stays in it: mass of each phase, momentum less the impulse of the walls, energy.
#include <catch2/catch.hpp>
#include <cmath>

#include "measures.hpp"

using namespace cobasis;
using namespace cobasis::test;

namespace {

struct Contents {
  std::string name, phases, regions;
};

const std::string solid = R"([phase.aluminium]
material = "aluminium"
)";
const std::string gas_around = R"([phase.air]
material = "air"
)";
const std::string second = R"([phase.copper]
material = "copper"
)";
const std::string nothing = R"([phase.surroundings]
void = { pressure = 1e5 }
)";

std::string everywhere(const std::string& phase) {
  return "[[region]]\nshape = \"everywhere\"\nfill = \"" + phase + "\"\n" +
         (phase == "air" ? "pressure = 1e5\nvelocity = [20.0, 10.0]\n" : "");
}
std::string body(const std::string& shape, const std::string& phase, const std::string& velocity) {
  return "[[region]]\n" + shape + "fill = \"" + phase + "\"\npressure = 1e5\nvelocity = " + velocity + "\n";
}
const std::string ball = "shape = \"sphere\"\ncenter = [0.42, 0.5, 0.5]\nradius = 0.22\n";
const std::string slab = "shape = \"half_space\"\npoint = [0.8, 0.5]\nnormal = [0.96, 0.28]\n";

void check_closed_box(const Contents& contents, bool space) {
  const std::string mesh = space ? "mesh = \"@box_space.geo\"\nmesh_parameters = { n = 6, element = 4 }\n"
                                 : "mesh = \"@box.geo\"\nmesh_parameters = { n = 16, element = 3 }\n";
  Scene scene = make_scene(mesh + "end_time = 1\n" + contents.phases + contents.regions + "[boundary]\n\"*\" = \"wall\"\n",
                           ranks());
  const auto energy = [&] {
    double sum = balance_of_phases(scene, "energy");
    for (const PhaseSetup& phase : scene.setup.phases)
      if (phase.is_void()) sum -= *phase.void_pressure * total(*scene.solver, "volume." + phase.name);
    return sum;
  };
  std::vector<double> masses, momenta;
  double momentum = 0;  // what moves, whatever its direction
  const double energy_before = energy();
  const Result before(scene);
  for (const PhaseSetup& phase : scene.setup.phases)
    if (!phase.is_void()) masses.push_back(balance(*scene.solver, "mass." + phase.name));
  const std::vector<std::string> axes = space ? std::vector<std::string>{"x", "y", "z"} : std::vector<std::string>{"x", "y"};
  double volume = 0;
  for (const double v : scene.mesh.volume) volume += v;
  for (const std::string& axis : axes) momenta.push_back(balance_of_phases(scene, "momentum." + axis));
  momentum = volume * mean(scene, [&](std::int32_t cell) {
    const auto& u = before.mixture.velocity;
    return before.mixture.density[cell] * std::hypot(u[0][cell], u[1][cell], u[2][cell]);
  });

  scene.run(1000);
  CHECK(scene.solver->step() == 1000);
  std::size_t i = 0;
  for (const PhaseSetup& phase : scene.setup.phases) {
    if (phase.is_void()) continue;
    const double gained = balance(*scene.solver, "mass." + phase.name) / masses[i++] - 1;
    INFO(contents.name << ": " << phase.name << " gained " << gained << " of its mass");
    CHECK(std::fabs(gained) < 1e-12);
  }
  for (std::size_t axis = 0; axis < axes.size(); ++axis) {
    const double gained = (balance_of_phases(scene, "momentum." + axes[axis]) - momenta[axis]) / momentum;
    INFO(contents.name << ": momentum along " << axes[axis] << " gained " << gained);
    CHECK(std::fabs(gained) < 1e-12);
  }
  const double gained = energy() / energy_before - 1;
  INFO(contents.name << ": energy gained " << gained << ", time " << scene.solver->time() << " s, exchanges "
                     << scene.solver->exchange_counters().exchanges);
  CHECK(std::fabs(gained) < 1e-12);
}

const Contents in_gas{"a solid in a gas", solid + gas_around,
                      everywhere("air") + body(ball, "aluminium", "[100.0, 50.0]")};
const Contents two_in_gas{"two solids in a gas", solid + gas_around + second,
                          everywhere("air") + body(ball, "aluminium", "[100.0, 50.0]") +
                              body(slab, "copper", "[-20.0, 0.0]")};
const Contents in_void{"a solid in a void", solid + nothing,
                       everywhere("surroundings") + body(ball, "aluminium", "[100.0, 50.0]")};
const Contents two_in_void{"two solids in a void", solid + second + nothing,
                           everywhere("surroundings") + body(ball, "aluminium", "[100.0, 50.0]") +
                               body(slab, "copper", "[-20.0, 0.0]")};

}  // namespace

TEST_CASE("mass, momentum and energy are conserved in a closed box of triangles with a gas") {
  check_closed_box(GENERATE(in_gas, two_in_gas), false);
}
TEST_CASE("mass, momentum and energy are conserved in a closed box of tetrahedra with a gas") {
  check_closed_box(GENERATE(in_gas, two_in_gas), true);
}
TEST_CASE("mass, momentum and energy less the work of a void are conserved in a closed box of triangles") {
  check_closed_box(GENERATE(in_void, two_in_void), false);
}
TEST_CASE("mass, momentum and energy less the work of a void are conserved in a closed box of tetrahedra") {
  check_closed_box(GENERATE(in_void, two_in_void), true);
}
