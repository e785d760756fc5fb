// What the keys of a case mean, beyond the example.
#include <catch2/catch.hpp>

#include "case_file.hpp"

using namespace cobasis;

namespace {

Shape shape_of(const std::string& keys) {
  return read_text(with(rest, "shape = \"everywhere\"", keys)).regions.at(0).shape;
}

Filling filling_of(const std::string& keys, const std::string& top = "") {
  return read_text(with(top + rest, "fill = \"air\"\npressure = 1e5", keys)).regions.at(0).filling;
}

std::vector<std::string> names_of(const std::vector<PhaseSetup>& phases) {
  std::vector<std::string> names;
  for (const PhaseSetup& phase : phases) names.push_back(phase.name);
  return names;
}

}  // namespace

TEST_CASE("phases keep the order of the file") {
  const std::string tables = with(rest, "[phase.copper]", "[phase.zinc]\nmaterial = \"copper\"\n[phase.copper]");
  CHECK(names_of(read_text(tables).phases) == std::vector<std::string>{"air", "zinc", "copper"});
  const std::string head = "schema = 1\nmesh = \"../meshes/tube.geo\"\nend_time = 1\n";
  const std::string tail = rest.substr(rest.find("[[region]]"));
  const std::string in_one_line =
      "phase = { z = { material = \"air\" }, a = { material = \"air\" }, air = { material = \"air\" } }\n";
  CHECK(names_of(read_text(head + in_one_line + tail).phases) == std::vector<std::string>{"z", "a", "air"});
}

TEST_CASE("keys of a phase override its material") {
  const std::string keys = "material = \"copper\"\neos = { p_inf = 1e9 }\nelastic = { rho0 = 8000 }";
  const PhaseSetup copper = read_text(with(rest, "material = \"copper\"", keys)).phases.at(1);
  CHECK(std::get<StiffenedGas>(copper.eos).gamma == 4.2);
  CHECK(std::get<StiffenedGas>(copper.eos).p_inf == 1e9);
  CHECK(copper.elastic->mu == 92e9);
  CHECK(copper.elastic->rho0 == 8000);
  CHECK(copper.density == 8000.0);

  const PhaseSetup air = read_text(with(rest, "material = \"air\"", "material = \"air\"\ndensity = 2.5")).phases.at(0);
  CHECK(air.density == 2.5);
  CHECK(read_text(rest).phases.at(0).density == 1.19);
}

TEST_CASE("another type of equation of state replaces the material's") {
  const std::string keys = "material = \"air\"\neos = { type = \"stiffened_gas\", gamma = 2, p_inf = 3 }";
  const PhaseSetup phase = read_text(with(rest, "material = \"air\"", keys)).phases.at(0);
  CHECK(std::get<StiffenedGas>(phase.eos).gamma == 2);
  CHECK(phase.density == 1.19);
}

TEST_CASE("every equation of state is read with its own keys") {
  const auto eos_of = [](const std::string& keys) {
    return read_text(with(rest, "material = \"air\"", "density = 900\neos = { type = " + keys + " }")).phases.at(0).eos;
  };
  const auto gas = std::get<NobleAbelStiffenedGas>(
      eos_of("\"noble_abel_stiffened_gas\", gamma = 1.19, p_inf = 7.028e8, b = 6.61e-4"));
  CHECK(gas.p_inf == 7.028e8);
  CHECK(gas.b == 6.61e-4);
  const auto law =
      std::get<MieGruneisen>(eos_of("\"mie_gruneisen\", rho0 = 8930, c0 = 3940, s = 1.489, gamma0 = 2.02"));
  CHECK(law.rho0 == 8930);
  CHECK(law.gamma0 == 2.02);
}

TEST_CASE("a phase without a material is what its own keys say") {
  const std::string keys = "eos = { type = \"ideal_gas\", gamma = 1.3 }\nelastic = { mu = 5, rho0 = 7 }";
  const PhaseSetup phase = read_text(with(rest, "material = \"copper\"", keys)).phases.at(1);
  CHECK(std::get<IdealGas>(phase.eos).gamma == 1.3);
  CHECK(phase.elastic->mu == 5);
  CHECK(phase.elastic->a == 0.5);
  CHECK(phase.density == 7.0);
}

TEST_CASE("every shape is read with its own keys") {
  CHECK(std::holds_alternative<Everywhere>(shape_of("shape = \"everywhere\"")));
  const auto half = std::get<HalfSpace>(shape_of("shape = \"half_space\"\npoint = [1, 2]\nnormal = [0, 0, 3]"));
  CHECK(half.point.y == 2);
  CHECK(half.point.z == 0);
  CHECK(half.normal.z == 3);
  const auto box = std::get<Box>(shape_of("shape = \"box\"\nlow = [0, 1, 2]\nhigh = [3, 4.5, 5]"));
  CHECK(box.low.z == 2);
  CHECK(box.high.y == 4.5);
  const auto sphere = std::get<Sphere>(shape_of("shape = \"sphere\"\ncenter = [1, 2, 3]\nradius = 4"));
  CHECK(sphere.center.z == 3);
  CHECK(sphere.radius == 4);
  const auto rod = std::get<Cylinder>(shape_of("shape = \"cylinder\"\nfrom = [0, 0, 0]\nto = [0, 0, 2]\nradius = 0.1"));
  CHECK(rod.to.z == 2);
  CHECK(rod.radius == 0.1);
  CHECK(std::get<PhysicalGroup>(shape_of("shape = \"physical_group\"\nname = \"core\"")).name == "core");
  const auto inside = std::get<Inside>(shape_of("shape = \"expression\"\ninside = \"x^2 + y^2 < 0.25 && x > 0\""));
  CHECK(inside.condition({0.1, 0.1, 0}) == 1);
  CHECK(inside.condition({-0.1, 0.1, 0}) == 0);
}

TEST_CASE("a filling is one phase, or fractions of several, with traces where the case has them") {
  CHECK(filling_of("fill = \"copper\"\npressure = 1").alpha == std::vector<double>{0, 1});
  CHECK(filling_of("alpha = { copper = 0.3, air = 0.7 }\npressure = 1").alpha == std::vector<double>{0.7, 0.3});
  CHECK(filling_of("alpha = { copper = 1 }\npressure = 1").alpha == std::vector<double>{0, 1});
  const Filling traces = filling_of("fill = \"copper\"\npressure = 3\nvelocity = [5, 6]\ndensity = 9000",
                                    "alpha_min = 1e-6\nscheme.interface = \"diffuse\"\n");
  CHECK(traces.alpha == std::vector<double>{1e-6, 1 - 1e-6});
  CHECK(traces.states[0].pressure.constant() == 3);
  CHECK(traces.states[0].velocity[1].constant() == 6);
  CHECK_FALSE(traces.states[0].density);
  CHECK(traces.states[1].density->constant() == 9000.0);
}

TEST_CASE("states of single phases override the common one") {
  const Filling filling = filling_of(
      "alpha = { copper = 0.5, air = 0.5 }\npressure = 1\ndensity = 2\nvelocity = [\"-4000*y\", \"4000*x\", \"0\"]\n"
      "phase.copper = { pressure = 3, velocity = [7, 8, 9], cobasis = [[1, 2, 3], [0, 5, 6], [0, 0, 9]] }");
  const PhaseState &air = filling.states[0], &copper = filling.states[1];
  CHECK(air.pressure.constant() == 1);
  CHECK(air.density->constant() == 2.0);
  CHECK(air.velocity[0]({0, 0.5, 0}) == -2000);
  CHECK(air.velocity[2].is_constant());
  CHECK_FALSE(air.cobasis);
  CHECK(copper.pressure.constant() == 3);
  CHECK(copper.density->constant() == 2.0);
  CHECK(copper.velocity[2].constant() == 9);
  REQUIRE(copper.cobasis);
  CHECK((*copper.cobasis)[0] == std::array<double, 3>{1, 2, 3});
  CHECK((*copper.cobasis)[1] == std::array<double, 3>{0, 5, 6});
  CHECK((*copper.cobasis)[2] == std::array<double, 3>{0, 0, 9});
}

TEST_CASE("boundaries are words or tables") {
  const std::string text = with(rest, "\"*\" = \"wall\"",
                                "a = \"wall\"\nb = { type = \"wall\" }\nc = \"symmetry\"\nd = \"transmissive\"\n"
                                "e = { type = \"inflow\", fill = \"air\", pressure = 2e5, velocity = [\"y\", 1] }");
  const auto boundaries = read_text(text).boundaries;
  REQUIRE(boundaries.size() == 5);
  CHECK(std::holds_alternative<Wall>(boundaries[0].boundary));
  CHECK(std::holds_alternative<Wall>(boundaries[1].boundary));
  CHECK(std::holds_alternative<Symmetry>(boundaries[2].boundary));
  CHECK(std::holds_alternative<Transmissive>(boundaries[3].boundary));
  const auto& inflow = std::get<Inflow>(boundaries[4].boundary).filling;
  CHECK(inflow.alpha == std::vector<double>{1, 0});
  CHECK(inflow.states[0].pressure.constant() == 2e5);
  CHECK(inflow.states[0].velocity[0]({0, 3, 0}) == 3);
}

TEST_CASE("walls may move, solids cling to walls without slip, outlets have a pressure") {
  const std::string text =
      with(rest, "\"*\" = \"wall\"",
           "a = \"wall\"\nb = { type = \"wall\", velocity = [\"y\", 2] }\nc = \"no_slip\"\n"
           "d = { type = \"no_slip\", velocity = [0, 3] }\ne = { type = \"outlet\", pressure = 5 }");
  const auto boundaries = read_text(text).boundaries;
  REQUIRE(boundaries.size() == 5);
  CHECK_FALSE(std::get<Wall>(boundaries[0].boundary).velocity);
  CHECK((*std::get<Wall>(boundaries[1].boundary).velocity)[0]({0, 4, 0}) == 4);
  CHECK(std::get<NoSlip>(boundaries[2].boundary).velocity[1].constant() == 0);
  CHECK(std::get<NoSlip>(boundaries[3].boundary).velocity[1].constant() == 3);
  CHECK(std::get<Outlet>(boundaries[4].boundary).pressure == 5);
}

TEST_CASE("a periodic pair named twice is one pair") {
  const std::string text = with(rest, "\"*\" = \"wall\"",
                                "a = { type = \"periodic\", with = \"b\" }\nb = { type = \"periodic\", with = \"a\" }");
  const Setup setup = read_text(text);
  CHECK(setup.boundaries.size() == 2);
  CHECK(periodic_pairs(setup) == std::vector<std::pair<std::string, std::string>>{{"a", "b"}});
}

TEST_CASE("contacts hold for a pair in either order, the default for the others") {
  const Setup setup = read_text(rest + "[contact]\ndefault = \"adherence\"\n\"copper-air\" = \"sliding\"\n");
  CHECK(setup.contact(0, 1) == Contact::sliding);
  CHECK(setup.contact(1, 0) == Contact::sliding);
  CHECK(setup.default_contact == Contact::adherence);
  CHECK(read_text(rest).contact(0, 1) == Contact::sliding);
}

TEST_CASE("relaxation has rates or is stiff, for a pair in either order, and makes interfaces diffuse") {
  const Setup setup = read_text(rest + "[relaxation]\n\"copper-air\" = { velocity = 1e4, pressure = \"stiff\" }\n");
  CHECK(setup.relaxations ==
        std::map<std::pair<int, int>, Relaxation>{{{0, 1}, {.velocity = 1e4, .pressure = infinity}}});
  CHECK(setup.scheme.interface == InterfaceTreatment::diffuse);
  CHECK(read_text(rest).relaxations.empty());
  CHECK(read_text(rest).scheme.interface == InterfaceTreatment::sharp);
}

TEST_CASE("contacts with friction have a coefficient") {
  const std::string two = with(rest, "material = \"air\"", "material = \"aluminium\"");
  const auto contact = [&](const std::string& keys) { return read_text(two + "[contact]\n" + keys).contact(1, 0); };
  CHECK(contact("default = { type = \"friction\", coefficient = 0.3 }") == Contact(Contact::friction, 0.3));
  CHECK(contact("\"copper-air\" = { type = \"friction\", coefficient = 0 }") == Contact(Contact::friction, 0));
  CHECK(contact("\"air-copper\" = { type = \"adherence\" }") == Contact::adherence);
}

TEST_CASE("all optional keys of the top level and the output are read") {
  const Setup setup =
      read_text("scene = \"space\"\ngravity = [1, -9.81, 3]\ncfl = 2\nalpha_min = 1e-12\nmax_steps = 1e6\n" + rest +
                "[scheme]\norder = 2\ninterface = \"diffuse\"\nlimiter = \"none\"\nlow_mach = \"on\"\n[output]\nfields "
                "= \"all\"\nprecision = \"float64\"\nhistory_every = 3\ncount = 4\n");
  CHECK(setup.scene == Geometry::space);
  CHECK(setup.gravity.y == -9.81);
  CHECK(setup.gravity.z == 3);
  CHECK(setup.cfl == 2);
  CHECK(setup.alpha_min == 1e-12);
  CHECK(setup.scheme.order == 2);
  CHECK(setup.scheme.interface == InterfaceTreatment::diffuse);
  CHECK_FALSE(setup.scheme.limited);
  CHECK(setup.scheme.low_mach);
  CHECK(read_text(rest + "[scheme]\ninterface = \"sharp\"\n").scheme.interface == InterfaceTreatment::sharp);
  CHECK(setup.max_steps == 1000000);
  CHECK(setup.output.fields ==
        std::vector<std::string>{"alpha", "density", "velocity", "pressure", "stress", "cobasis", "energy"});
  CHECK(setup.output.float64);
  CHECK(setup.output.count == 4);
  CHECK(setup.history_every == 3);
  CHECK_FALSE(read_text(rest).scene);
  CHECK(read_text(rest + "[output]\nfields = [\"all\"]\n").output.fields.size() == 7);
}
