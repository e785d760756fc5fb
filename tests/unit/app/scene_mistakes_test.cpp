// Cases of which every line is right, but not the scene: states, phases and boundaries that do not go together.
#include <catch2/catch.hpp>

#include "mistake_checks.hpp"

using namespace cobasis;
using Catch::Matchers::Contains;

namespace {

const std::string diffuse_scheme = "[scheme]\ninterface = \"diffuse\"\n";

}  // namespace

TEST_CASE("traces of every phase everywhere are refused with sharp") {
  const std::string traces = with(rest, "end_time", "alpha_min = 1e-6\nend_time");
  check_mistake(traces + "[scheme]\ninterface = \"sharp\"\n", "alpha_min",
                {"alpha_min = 1e-06 with sharp or compressed interfaces", "allowed: 0, or interface = \"diffuse\""});
  CHECK(mistakes_in(traces + diffuse_scheme).empty());
}

TEST_CASE("volume fractions sum to one, and with traces every phase has its own") {
  check_replaced("fill = \"air\"", "alpha = { air = 0.3, copper = 0.6 }", {"alpha sums to 0.8999", "allowed: 1"});
  check_replaced("fill = \"air\"", "alpha = { air = 1.5 }", {"alpha.air = 1.5", "0 <= alpha.air <= 1"});
  check_mistake(with(rest, "fill = \"air\"", "fill = \"air\"\nalpha = { air = 1.0 }"), "alpha = {",
                {"both \"fill\" and \"alpha\"", "one of them"});
  const std::string traces = with(rest, "end_time", "alpha_min = 1e-6\nend_time") + diffuse_scheme;
  check_mistake(with(traces, "fill = \"air\"", "alpha = { air = 1.0 }"), "alpha = {",
                {"alpha of \"copper\" is missing", "alpha_min = 1e-06"});
}

TEST_CASE("states that the materials cannot hold are refused") {
  check_replaced("pressure = 1e5", "pressure = 0", {"pressure = 0 of phase \"air\"", "0 < pressure"});
  check_mistake(with(with(rest, "fill = \"air\"", "fill = \"copper\""), "1e5", "-35e9"), "pressure",
                {"pressure = -35000000000 of phase \"copper\"", "-34200000000 < pressure"});
  CHECK(mistakes_in(with(with(rest, "fill = \"air\"", "fill = \"copper\""), "1e5", "-34e9")).empty());
  check_mistake(with(rest, "pressure", "phase.air = { pressure = -1 }\npressure"), "phase.air = {", {"pressure = -1"});
  check_mistake(with(rest, "material = \"air\"", "eos = { type = \"ideal_gas\", gamma = 1.4 }"), "[[region]]",
                {"no density of the fluid \"air\""});
  check_mistake(with(rest, "pressure", "phase.air.cobasis = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\npressure"), "cobasis",
                {"cobasis of the fluid \"air\"", "of a solid"});
  check_mistake(with(rest, "pressure", "phase.copper.cobasis = [[1, 0, 0], [0, -1, 0], [0, 0, 1]]\npressure"),
                "cobasis", {"determinant -1", "0 < det(cobasis)"});
  check_mistake(with(rest, "\"copper\"", "\"copper\"\ndensity = 8000"), "density = 8000", {"rho0"});
  check_mistake(with(rest, "\"everywhere\"", "\"half_space\"\npoint = [0, 0]\nnormal = [0, 0]"), "normal",
                {"length 0"});
  check_mistake(with(rest, "\"everywhere\"", "\"box\"\nlow = [0, 0]\nhigh = [1, 0]"), "high", {"low < high"});
  check_mistake(with(rest, "\"everywhere\"", "\"cylinder\"\nfrom = [0, 0]\nto = [0, 0]\nradius = 1"), "to = [",
                {"two different points"});
}

TEST_CASE("pressure and density are numbers or formulas, and a formula that is a number is checked like one") {
  CHECK(mistakes_in(with(rest, "pressure = 1e5", "pressure = \"1e5 - 9.81*y\"\ndensity = \"1 + x\"")).empty());
  check_replaced("pressure = 1e5", "pressure = \"-2*3\"", {"pressure = -6 of phase \"air\"", "0 < pressure"});
  check_replaced("pressure = 1e5", "pressure = \"1e5 - 9.81*h\"", {"\"1e5 - 9.81*h\"", "a formula in x, y, z"});
  check_replaced("pressure = 1e5", "pressure = [1e5]", {"allowed: a number, or a formula in x, y, z [Pa]"});
  check_mistake(with(rest, "pressure = 1e5", "pressure = 1e5\ndensity = \"0*2\""),
                "density = ", {"density = \"0*2\"", "0 < density"});
}

TEST_CASE("a void is one, alone in its table, has no state and goes with no traces") {
  const std::string free =
      with(rest, "[phase.copper]\nmaterial = \"copper\"\n", "[phase.free]\nvoid = { pressure = 2e5 }\n");
  CHECK(mistakes_in(free).empty());
  check_mistake(with(free, "void =", "material = \"air\"\nvoid ="), "material = \"air\"\nvoid", {"both \"void\" and"});
  check_mistake(with(free, "void =", "elastic = { mu = 1, rho0 = 1 }\nvoid ="), "elastic", {"\"elastic\" of the void"});
  check_mistake(with(free, "{ pressure = 2e5 }", "{}"), "void", {"missing key \"pressure\"", "0 <= pressure"});
  check_mistake(with(free, "[[region]]", "[phase.other]\nvoid = { pressure = 1 }\n[[region]]"),
                "void = { pressure = 1 }", {"second void beside \"free\""});
  check_mistake(with(free, "end_time", "alpha_min = 1e-6\nend_time") + diffuse_scheme, "alpha_min",
                {"void \"free\"", "allowed: 0"});
  check_mistake(with(free, "pressure = 1e5", "pressure = 1e5\nphase.free.pressure = 1"), "phase.free.p",
                {"state of the void"});
  const std::string filled = with(free, "fill = \"air\"\npressure = 1e5", "fill = \"free\"");
  CHECK(mistakes_in(filled).empty());
  CHECK(mistakes_in(with(filled, "\"free\"", "\"free\"\npressure = 2e5")).empty());
  check_mistake(with(filled, "\"free\"", "\"free\"\npressure = 1e5"), "pressure = 1e5", {"none, or 200000"});
  check_mistake(with(filled, "\"free\"", "\"free\"\nvelocity = [1, 0]"), "velocity", {"which has no state"});
  check_mistake(with(free, "\"wall\"", "{ type = \"inflow\", fill = \"free\" }"), "inflow", {"inflow of the void"});
  check_mistake(with(filled, "[phase.air]\nmaterial = \"air\"\n", ""), "[phase.free]", {"no phase but a void"});
}

TEST_CASE("periodic groups are two, and each the other's partner") {
  const auto boundaries = [](const std::string& lines) { return with(rest, "\"*\" = \"wall\"", lines); };
  const std::string a = "a = { type = \"periodic\", with = \"b\" }\n";
  CHECK(mistakes_in(boundaries(a)).empty());
  CHECK(mistakes_in(boundaries(a + "b = { type = \"periodic\", with = \"a\" }\n")).empty());
  check_mistake(boundaries(a + "b = \"wall\"\n"), "a = {", {"\"b\" is another boundary"});
  check_mistake(boundaries("a = { type = \"periodic\", with = \"a\" }\n"), "a = {", {"two different physical groups"});
  check_mistake(boundaries("\"*\" = { type = \"periodic\", with = \"a\" }\n"), "\"*\"",
                {"two different physical groups"});
  CHECK_THAT(mistakes_in(boundaries(a + "b = { type = \"periodic\", with = \"c\" }\n")),
             Contains("\"b\" is periodic with \"c\""));
}

TEST_CASE("what a plane cannot hold is refused when the scene is a plane, else when the geometry is known") {
  const auto check_both = [](const std::string& text, const std::string& says) {
    INFO(text);
    const std::string plane = with(text, "end_time", "scene = \"plane\"\nend_time");
    CHECK_THAT(mistakes_in(plane), Contains(says) && Contains("case.toml"));
    const Setup setup = read_text(text);
    CHECK_THROWS_WITH(check_for_geometry(setup, Geometry::plane), Contains(says));
    CHECK_THROWS_AS(check_for_geometry(setup, Geometry::plane), InputError);
    CHECK_NOTHROW(check_for_geometry(setup, Geometry::space));
  };
  check_both(with(rest, "pressure", "velocity = [0, 0, 1]\npressure"), "velocity of phase \"air\"");
  check_both(with(rest, "pressure", "velocity = [0, 0, \"x\"]\npressure"), "velocity of phase \"air\"");
  check_both(with(rest, "\"wall\"", "{ type = \"inflow\", fill = \"air\", pressure = 1e5, velocity = [0, 0, 1] }"),
             "velocity of phase \"air\"");
  check_both(with(rest, "\"everywhere\"", "\"cylinder\"\nfrom = [0, 0]\nto = [1, 0]\nradius = 1"), "cylinder");
  check_both(with(rest, "\"everywhere\"", "\"sphere\"\ncenter = [0, 0, 1]\nradius = 1"), "center");
  check_both(rest + "[[probe]]\nname = \"a\"\nat = [0, 0, 1]\n", "probe \"a\"");
  check_both(rest + "[[integral]]\nname = \"a\"\nextent = { phase = \"air\", alpha = 0.5, axis = \"z\" }\n", "axis");
  const std::string solid = with(rest, "fill = \"air\"", "fill = \"copper\"");
  for (const char* cobasis : {"[[1, 0, 0.1], [0, 1, 0], [0, 0, 1]]", "[[1, 0, 0], [0, 1, 0.1], [0, 0, 1]]",
                              "[[1, 0, 0], [0, 1, 0], [0.1, 0, 1]]", "[[1, 0, 0], [0, 1, 0], [0, 0.1, 1]]"})
    check_both(with(solid, "pressure", std::string("phase.copper.cobasis = ") + cobasis + "\npressure"), "cobasis");

  const std::string in_plane = "phase.copper.cobasis = [[1, 0.1, 0], [0.2, 1, 0], [0, 0, 0.9]]\npressure";
  CHECK_NOTHROW(check_for_geometry(read_text(with(solid, "pressure", in_plane)), Geometry::plane));
  CHECK_NOTHROW(
      check_for_geometry(read_text(with(rest, "pressure", "velocity = [1, \"y\", \"0\"]\npressure")), Geometry::plane));
  const Setup flat_box = read_text(with(rest, "\"everywhere\"", "\"box\"\nlow = [0, 0]\nhigh = [1, 1]"));
  CHECK_NOTHROW(check_for_geometry(flat_box, Geometry::plane));
  CHECK_THROWS_WITH(check_for_geometry(flat_box, Geometry::space), Contains("box"));
}

TEST_CASE("an axis is one of an axisymmetric scene, which holds no more than a plane does") {
  const std::string axis = with(rest, "\"*\" = \"wall\"", "low = \"axis\"\n\"*\" = \"wall\"");
  const auto in = [&](const std::string& scene) {
    return with(axis, "end_time", "scene = \"" + scene + "\"\nend_time");
  };
  CHECK(mistakes_in(in("axisymmetric")).empty());
  check_mistake(in("plane"), "low", {"boundary \"low\" = \"axis\" in a plane scene", "scene = \"axisymmetric\""});
  check_mistake(in("space"), "low", {"boundary \"low\" = \"axis\" in a space scene"});
  CHECK_THROWS_WITH(check_for_geometry(read_text(axis), Geometry::plane), Contains("in a plane scene"));
  check_mistake(with(in("axisymmetric"), "pressure", "velocity = [0, 0, 1]\npressure"), "[[region]]",
                {"velocity of phase \"air\" has a third component in an axisymmetric scene"});
}

TEST_CASE("an outlet needs a pressure that all phases can have, no slip a solid, a plane wall a plane velocity") {
  check_replaced("\"*\" = \"wall\"", "\"*\" = \"outlet\"", {"missing key \"pressure\""});
  check_replaced("\"*\" = \"wall\"", "\"*\" = { type = \"outlet\", pressure = 0 }",
                 {"pressure = 0 outside phase \"air\"; allowed: 0 < pressure [Pa]"});
  check_replaced("\"*\" = \"wall\"", "\"*\" = { type = \"outlet\", velocity = [1, 2], pressure = 1 }",
                 {"unknown key \"velocity\"", "allowed: type, pressure"});
  check_mistake(with(with(rest, "\"*\" = \"wall\"", "\"*\" = \"no_slip\""), "\"copper\"", "\"water\""), "\"*\"",
                {"\"no_slip\" in a scene of fluids", "allowed: wall"});
  CHECK_THAT(mistakes_in("scene = \"plane\"\n" +
                         with(rest, "\"*\" = \"wall\"", "\"*\" = { type = \"wall\", velocity = [0, 0, 1] }")),
             Contains("velocity of boundary \"*\" has a third component in a plane scene"));
}

TEST_CASE("a density beyond what an equation of state can hold is refused") {
  const std::string dense =
      with(rest, "material = \"air\"",
           "density = 1600\neos = { type = \"noble_abel_stiffened_gas\", gamma = 1.19, p_inf = 7.028e8, b = 6.61e-4 }");
  check_mistake(dense, "[[region]]", {"density 1600 of phase \"air\"; allowed: below 1512.8"});
  CHECK(mistakes_in(with(dense, "1600", "1000")).empty());
}

TEST_CASE("relaxation is between two phases with a state, at a rate or stiff, and not at sharp interfaces") {
  const auto relaxed = [](const std::string& entry) { return rest + "[relaxation]\n" + entry + "\n"; };
  check_mistake(relaxed("\"air-coper\" = { velocity = \"stiff\" }"), "air-coper",
                {"not between two phases", "allowed: air-copper", "did you mean \"air-copper\"?"});
  check_mistake(relaxed("\"air-copper\" = { velocity = \"stif\" }"), "air-copper", {"allowed: stiff; did you mean"});
  check_mistake(relaxed("\"air-copper\" = { pressure = -1 }"), "air-copper", {"pressure = -1", "stiff, or a number"});
  check_mistake(relaxed("\"air-copper\" = { presure = 1 }"), "air-copper", {"unknown key", "\"pressure\"?"});
  check_mistake(relaxed("\"air-copper\" = \"stiff\""), "air-copper", {"allowed: a table"});
  check_mistake(relaxed("\"air-copper\" = {}"), "air-copper", {"of nothing", "velocity and / or pressure"});
  check_mistake(relaxed("\"air-copper\" = { velocity = 1 }\n\"copper-air\" = { velocity = 2 }"), "\"copper-air\"",
                {"given twice"});
  check_mistake(with(relaxed("\"air-copper\" = { velocity = 1 }"), "material = \"air\"", "void = { pressure = 1e5 }"),
                "\"air-copper\"", {"not between two phases with a state"});
  for (const char* interface : {"sharp", "compressed"})
    check_mistake(relaxed("\"air-copper\" = { velocity = 1 }") + "[scheme]\ninterface = \"" + interface + "\"\n",
                  "[relaxation]", {"with sharp or compressed interfaces", "allowed: interface = \"diffuse\""});
}

TEST_CASE("friction needs a coefficient, and two solids") {
  check_mistake(rest + "[contact]\ndefault = \"friction\"\n", "default", {"missing key \"coefficient\""});
  check_mistake(rest + "[contact]\ndefault = { type = \"friction\", coefficient = -1 }\n", "default",
                {"coefficient = -1", "0 <= coefficient"});
  check_mistake(rest + "[contact]\ndefault = { type = \"sliding\", coefficient = 1 }\n", "default",
                {"unknown key \"coefficient\"", "allowed: type"});
  check_mistake(rest + "[contact]\n\"air-copper\" = { type = \"friction\", coefficient = 1 }\n", "\"air-copper\"",
                {"friction of \"air-copper\", of which one is a fluid; allowed: sliding"});
}

TEST_CASE("gravity across the axis, or out of the plane, is refused") {
  CHECK_THAT(mistakes_in("scene = \"axisymmetric\"\ngravity = [9.81, 1]\n" + rest),
             Contains("gravity = [9.81, 1] in an axisymmetric scene; allowed: second number 0"));
  CHECK_THAT(mistakes_in("scene = \"plane\"\ngravity = [0, 0, -9.81]\n" + rest),
             Contains("gravity = [0, 0, -9.81] in a plane scene; allowed: third number 0 or none"));
  CHECK(mistakes_in("scene = \"axisymmetric\"\ngravity = [-9.81, 0]\n" + rest).empty());
}
