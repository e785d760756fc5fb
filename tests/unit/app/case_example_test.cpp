// The example of the case format, in full.
#include <catch2/catch.hpp>
#include <locale>
#include <regex>
#include <set>

#include "app/case_keys.hpp"
#include "case_file.hpp"

using namespace cobasis;

namespace {

const std::string example = R"toml(schema   = 1
title    = "Impact between two elastic solids (section 5.2)"
mesh     = "../meshes/tube.geo"
mesh_parameters = { n = 2000 }
scene    = "plane"

end_time = 50e-6
cfl      = 0.8
alpha_min = 0.0

[scheme]
order    = 1

[phase.copper]
eos     = { type = "stiffened_gas", gamma = 4.2, p_inf = 34.2e9 }
elastic = { mu = 92e9, rho0 = 8900.0, a = 0.5 }
[phase.aluminium]
material = "aluminium"

[phase.surroundings]
void = { pressure = 1e5 }

[contact]
default = "sliding"
"copper-aluminium" = "sliding"

[[region]]
shape    = "everywhere"
fill     = "aluminium"
pressure = 1e5
velocity = [-200.0, 0.0, 0.0]
[[region]]
shape    = "half_space"
point    = [0.5, 0.0]
normal   = [-1.0, 0.0]
fill     = "copper"
pressure = 1e5
velocity = [400.0, 0.0, 0.0]

[boundary]
left   = "transmissive"
right  = "transmissive"
bottom = { type = "periodic", with = "top" }
"*"    = "symmetry"

[output]
directory = "impact"
every     = 5e-6
fields    = ["alpha", "density", "velocity", "pressure", "stress"]

[[line]]
name = "axis"
from = [0.0, 0.0]
to   = [1.0, 0.0]
points = 2000
[[probe]]
name = "gauge"
at   = [0.7, 0.0]
[[integral]]
name = "spread"
extent = { phase = "copper", alpha = 0.5, axis = "y" }
[[integral]]
name = "r95"
quantile = { phase = "copper", fraction = 0.95, axis = "radial" }
)toml";

void check_velocity(const PhaseState& state, double u) {
  CHECK(state.velocity[0].is_constant());
  CHECK(state.velocity[0].constant() == u);
  CHECK(state.velocity[1].constant() == 0);
  CHECK(state.velocity[2].constant() == 0);
}

void check_point(const Point& x, double a, double b, double c) {
  CHECK(x.x == a);
  CHECK(x.y == b);
  CHECK(x.z == c);
}

}  // namespace

TEST_CASE("the example's top level, phases and contacts are read as they are written") {
  const CaseFile file(example);
  const Setup setup = read_case(file.path());
  CHECK(setup.case_file == file.path());
  CHECK(setup.title == "Impact between two elastic solids (section 5.2)");
  CHECK(setup.mesh_file == (file.directory() / "meshes" / "tube.geo").string());
  CHECK(setup.mesh_parameters == std::map<std::string, double>{{"n", 2000}});
  CHECK(setup.scene == Geometry::plane);
  CHECK(setup.end_time == 50e-6);
  CHECK(setup.cfl == 0.8);
  CHECK(setup.alpha_min == 0);
  CHECK_FALSE(setup.max_steps);

  REQUIRE(setup.phases.size() == 3);
  const PhaseSetup &copper = setup.phases[0], &aluminium = setup.phases[1], &surroundings = setup.phases[2];
  CHECK(copper.name == "copper");
  CHECK(std::get<StiffenedGas>(copper.eos).gamma == 4.2);
  CHECK(std::get<StiffenedGas>(copper.eos).p_inf == 34.2e9);
  REQUIRE(copper.is_solid());
  CHECK(copper.elastic->mu == 92e9);
  CHECK(copper.elastic->rho0 == 8900);
  CHECK(copper.elastic->a == 0.5);
  CHECK(copper.density == 8900.0);
  CHECK(aluminium.name == "aluminium");
  CHECK(std::get<StiffenedGas>(aluminium.eos).gamma == 3.4);
  REQUIRE(aluminium.is_solid());
  CHECK(aluminium.elastic->mu == 26e9);
  CHECK(surroundings.name == "surroundings");
  REQUIRE(surroundings.is_void());
  CHECK(*surroundings.void_pressure == 1e5);
  CHECK_FALSE(surroundings.is_solid());

  CHECK(setup.default_contact == Contact::sliding);
  CHECK(setup.contacts == std::map<std::pair<int, int>, Contact>{{{0, 1}, Contact::sliding}});
}

TEST_CASE("the example's regions and boundaries are read as they are written") {
  const Setup setup = read_text(example);
  REQUIRE(setup.regions.size() == 2);
  CHECK(std::holds_alternative<Everywhere>(setup.regions[0].shape));
  CHECK(setup.regions[0].filling.alpha == std::vector<double>{0, 1, 0});
  CHECK(setup.regions[0].filling.states.at(1).pressure.constant() == 1e5);
  CHECK_FALSE(setup.regions[0].filling.states[1].density);
  CHECK_FALSE(setup.regions[0].filling.states[1].cobasis);
  check_velocity(setup.regions[0].filling.states[1], -200);

  const auto& half = std::get<HalfSpace>(setup.regions[1].shape);
  check_point(half.point, 0.5, 0, 0);
  check_point(half.normal, -1, 0, 0);
  CHECK(setup.regions[1].filling.alpha == std::vector<double>{1, 0, 0});
  CHECK(setup.regions[1].filling.states.size() == 3);
  check_velocity(setup.regions[1].filling.states[0], 400);
  CHECK_THAT(setup.regions[1].where, Catch::Matchers::EndsWith("case.toml:32"));

  REQUIRE(setup.boundaries.size() == 5);
  CHECK(setup.boundaries[0].group == "left");
  CHECK(std::holds_alternative<Transmissive>(setup.boundaries[0].boundary));
  CHECK_THAT(setup.boundaries[0].where, Catch::Matchers::EndsWith("case.toml:41"));
  CHECK(setup.boundaries[1].group == "right");
  CHECK(std::holds_alternative<Transmissive>(setup.boundaries[1].boundary));
  CHECK(setup.boundaries[2].group == "bottom");
  CHECK(std::get<Periodic>(setup.boundaries[2].boundary).with == "top");
  CHECK(setup.boundaries[3].group == "*");
  CHECK(std::holds_alternative<Symmetry>(setup.boundaries[3].boundary));
  CHECK(setup.boundaries[4].group == "top");
  CHECK(std::get<Periodic>(setup.boundaries[4].boundary).with == "bottom");
  CHECK(periodic_pairs(setup) == std::vector<std::pair<std::string, std::string>>{{"bottom", "top"}});
}

TEST_CASE("the example's output, line, probe and integrals are read as they are written") {
  const CaseFile file(example);
  const Setup setup = read_case(file.path());
  CHECK(setup.output.directory == (file.directory() / "cases" / "impact").string());
  CHECK(setup.output.every == 5e-6);
  CHECK_FALSE(setup.output.count);
  CHECK(setup.output.fields == std::vector<std::string>{"alpha", "density", "velocity", "pressure", "stress"});
  CHECK_FALSE(setup.output.float64);
  CHECK_FALSE(setup.history_every);

  REQUIRE(setup.lines.size() == 1);
  CHECK(setup.lines[0].name == "axis");
  check_point(setup.lines[0].from, 0, 0, 0);
  check_point(setup.lines[0].to, 1, 0, 0);
  CHECK(setup.lines[0].points == 2000);
  REQUIRE(setup.probes.size() == 1);
  CHECK(setup.probes[0].name == "gauge");
  check_point(setup.probes[0].at, 0.7, 0, 0);
  REQUIRE(setup.integrals.size() == 2);
  CHECK(setup.integrals[0].name == "spread");
  const auto& extent = std::get<Extent>(setup.integrals[0].what);
  CHECK(extent.phase == 0);
  CHECK(extent.alpha == 0.5);
  CHECK(extent.axis == Axis::y);
  CHECK(setup.integrals[1].name == "r95");
  const auto& quantile = std::get<Quantile>(setup.integrals[1].what);
  CHECK(quantile.phase == 0);
  CHECK(quantile.fraction == 0.95);
  CHECK(quantile.axis == Axis::radial);
}

TEST_CASE("the help on cases names every key of the example") {
  std::set<std::string> given{"copper", "aluminium", "surroundings", "n", "left", "right", "bottom"};
  const std::string help = describe_case_keys();
  const std::regex key_at_start("(?:^|[{,\\n])\\s*([a-z_0-9]+)\\s*=");
  int keys = 0;
  for (std::sregex_iterator match(example.begin(), example.end(), key_at_start), end; match != end; ++match) {
    const std::string key = (*match)[1];
    if (given.contains(key)) continue;
    INFO(key);
    CHECK(std::regex_search(help, std::regex("\\n  " + key + " ")));
    ++keys;
  }
  CHECK(keys > 40);
  for (const char* table : {"[scheme]", "[phase.NAME]", "[contact]", "[relaxation]", "[[region]]", "[boundary]",
                            "[output]", "[[line]]", "[[probe]]", "[[integral]]", "[mesh_parameters]"})
    CHECK_THAT(help, Catch::Matchers::Contains(table));
}

TEST_CASE("numbers of a case do not depend on the locale") {
  struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
  const std::string said = mistakes_in(example, {{{"cfl", "2.5"}}, ""});
  const Setup setup = read_text(
      example, {{{"end_time", "1234.5"}, {"output.every", "0.5"}, {"region.0.velocity", "[\"1.5\", 0]"}}, ""});
  std::locale::global(before);
  CHECK(setup.end_time == 1234.5);
  CHECK(setup.cfl == 0.8);
  CHECK(setup.regions[0].filling.states[1].velocity[0].constant() == 1.5);
  CHECK(said == "--set cfl: cfl = 2.5; allowed: a number [-], 0 < cfl <= 2");
}
