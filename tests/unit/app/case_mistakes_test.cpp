// What is wrong with a case is said with file:line, what was found, what is allowed, and the nearest name.
#include <algorithm>
#include <catch2/catch.hpp>

#include "mistake_checks.hpp"

using namespace cobasis;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

TEST_CASE("a right case has no mistakes") { CHECK(mistakes_in(rest).empty()); }

TEST_CASE("a file that is missing, empty or not TOML is refused") {
  CHECK_THROWS_WITH(read_case("no/such.toml"), Contains("no/such.toml: cannot be read"));
  CHECK_THROWS_AS(read_case("/"), InputError);
  CHECK_THAT(mistakes_in(""), Contains("missing key \"mesh\"") && Contains("missing key \"end_time\""));
  CHECK_THAT(mistakes_in("schema = 1\n\ncfl = = 2\n"), StartsWith("case.toml:3: "));
  CHECK_THAT(mistakes_in("schema = 1\nschema = 1\n"), StartsWith("case.toml:2: ") && Contains("schema"));
}

TEST_CASE("unknown keys are refused in every table, with the nearest name") {
  check_mistake(with(rest, "end_time", "cfll = 1\nend_time"), "cfll",
                {"unknown key \"cfll\"", "allowed: schema, title", "did you mean \"cfl\"?"});
  check_mistake(rest + "[scheme]\nordre = 1\n", "ordre", {"allowed: accuracy, order", "did you mean \"order\"?"});
  check_mistake(with(rest, "material = \"air\"", "materiel = \"air\"\nmaterial = \"air\""), "materiel",
                {"allowed: material, eos, elastic, density, void", "\"material\"?"});
  check_mistake(with(rest, "\"air\"", "\"air\"\neos = { gama = 1.4 }"), "gama", {"allowed: type, gamma", "\"gamma\"?"});
  check_mistake(with(rest, "\"copper\"", "\"copper\"\nelastic = { nu = 1 }"), "nu",
                {"allowed: mu, rho0, a", "\"mu\"?"});
  check_mistake(with(rest, "pressure", "presure = 1\npressure"), "presure", {"allowed: shape, fill", "\"pressure\"?"});
  check_mistake(with(rest, "pressure", "phase.air = { temperature = 300 }\npressure"), "temperature",
                {"allowed: density, pressure, velocity, cobasis"});
  check_mistake(with(rest, "\"wall\"", "{ type = \"wall\", with = \"x\" }"), "with", {"allowed: type"});
  check_mistake(rest + "[output]\nevry = 1\n", "evry", {"allowed: directory, every", "\"every\"?"});
  check_mistake(rest + "[[probe]]\nname = \"a\"\nat = [0, 0]\npoint = 1\n", "point", {"allowed: name, at"});
  check_mistake(
      rest + "[[integral]]\nname = \"a\"\nextent = { phase = \"air\", alpha = 0.5, axs = \"x\", axis = \"x\" }\n",
      "extent", {"unknown key \"axs\"", "did you mean \"axis\"?"});
}

TEST_CASE("keys and words of features that do not exist are refused like unknown ones") {
  for (const char* key : {"stop_when = \"steady\"", "accuracy = \"high\"", "order = 1"})
    check_mistake(with(rest, "end_time", std::string(key) + "\nend_time"), key,
                  {"unknown key", "allowed: schema, title"});
  check_mistake(with(rest, "end_time", "scene = \"spherical\"\nend_time"), "scene",
                {"allowed: plane, axisymmetric, space"});
  check_mistake(rest + "[scheme]\norder = 3\n", "order", {"order = 3; allowed: a whole number"});
  check_mistake(rest + "[scheme]\ninterface = \"blurred\"\n", "interface", {"allowed: sharp, compressed, diffuse"});
  check_mistake(rest + "[scheme]\nlimiter = \"minmod\"\n", "limiter", {"allowed: monotone, none"});
  check_mistake(rest + "[contact]\ndefault = \"glue\"\n", "default", {"allowed: sliding, adherence, friction"});
  CHECK(mistakes_in(rest + "[scheme]\norder = 1\n").empty());
}

TEST_CASE("values of the wrong type are refused with the type that is allowed") {
  check_replaced("schema = 1", "schema = \"1\"", {"schema = \"1\"", "a whole number"});
  check_replaced("end_time = 1e-3", "end_time = \"long\"", {"end_time = \"long\"", "a number [s]"});
  check_replaced("end_time = 1e-3", "end_time = true", {"end_time = true", "a number [s]"});
  check_replaced("end_time = 1e-3", "end_time = 2026-01-01", {"a date or time", "a number [s]"});
  check_replaced("end_time = 1e-3", "end_time = [1]", {"an array of 1", "a number [s]"});
  check_replaced("mesh = \"../meshes/tube.geo\"", "mesh = 3", {"mesh = 3", "text"});
  check_replaced("[[region]]", "[region]", {"region = a table", "an array of tables"});
  check_replaced("material = \"air\"", "eos = \"ideal_gas\"", {"eos = \"ideal_gas\"", "a table"});
  check_replaced("pressure = 1e5", "velocity = 3\npressure = 1e5", {"velocity = 3", "2 or 3 numbers or formulas"});
  check_replaced("pressure = 1e5", "velocity = [1]\npressure = 1e5", {"an array of 1", "2 or 3"});
  check_replaced("pressure = 1e5", "velocity = [1, true]\npressure = 1e5", {"velocity = true"});
  check_mistake(with(rest, "fill = \"air\"", "fill = \"air\"\nphase.copper.cobasis = [[1, 0, 0], [0, 1, 0]]"),
                "cobasis", {"an array of 2", "3 arrays of 3 numbers"});
  check_mistake(rest + "left = 3\n", "left", {"left = 3", "or a table with one of these as type"});
  check_mistake("phase = 3\n" + with(with(rest, "[phase.air]\nmaterial = \"air\"\n", ""),
                                     "[phase.copper]\nmaterial = \"copper\"\n", ""),
                "phase", {"phase = 3", "a table"});
}

TEST_CASE("numbers out of range, NaN and infinity are refused with the range") {
  check_replaced("schema = 1", "schema = 2", {"schema = 2", "1"});
  for (const char* value : {"0", "-1", "nan", "inf", "-inf"})
    check_replaced("end_time = 1e-3", std::string("end_time = ") + value, {"0 < end_time"});
  for (const char* value : {"0", "2.1", "nan", "-1"})
    check_mistake(with(rest, "end_time", std::string("cfl = ") + value + "\nend_time"), "cfl", {"0 < cfl <= 2"});
  for (const char* value : {"1e-13", "0.2", "-1e-3", "nan"})
    check_mistake(with(rest, "end_time", std::string("alpha_min = ") + value + "\nend_time"), "alpha_min",
                  {"0, or 1e-12 <= alpha_min <= 0.1"});
  for (const char* value : {"0", "2.5", "-3"})
    check_mistake(with(rest, "end_time", std::string("max_steps = ") + value + "\nend_time"), "max_steps",
                  {"a whole number, 1 <= max_steps"});
  check_mistake(with(rest, "\"air\"", "\"air\"\neos = { gamma = 1.0 }"), "eos", {"gamma = 1;", "1 < gamma"});
  check_mistake(with(rest, "\"copper\"", "\"copper\"\nelastic = { a = 0.6 }"), "elastic",
                {"a = 0.6", "-1 <= a <= 0.5"});
  check_mistake(with(rest, "\"copper\"", "\"copper\"\nelastic = { mu = -1 }"), "elastic", {"mu = -1", "0 <= mu"});
  check_mistake(with(rest, "\"air\"", "\"air\"\ndensity = 0"), "density", {"0 < density"});
  check_replaced("pressure = 1e5", "pressure = inf", {"pressure = inf"});
  check_replaced("pressure = 1e5", "velocity = [nan, 0]\npressure = 1e5", {"velocity = nan"});
  check_mistake(rest + "[output]\ncount = 0\n", "count", {"1 <= count"});
  check_mistake(rest + "[output]\nevery = 0\n", "every = 0", {"0 < every"});
  check_mistake(rest + "[[line]]\nname = \"a\"\nfrom = [0, 0]\nto = [1, 0]\npoints = 1\n", "points", {"2 <= points"});
}

TEST_CASE("a wrong formula is refused with its text and position") {
  check_mistake(with(rest, "pressure", "velocity = [\"x +\", 0]\npressure"), "velocity", {"\"x +\"", "position"});
  check_mistake(with(rest, "pressure", "velocity = [\"x = 1\", 0]\npressure"), "velocity", {"assignment"});
  check_mistake(with(rest, "pressure", "velocity = [\"1/0\", 0]\npressure"), "velocity", {"\"1/0\"", "allowed"});
  check_mistake(with(rest, "\"everywhere\"", "\"expression\"\ninside = \"x < foo\""), "inside", {"foo", "position"});
}

TEST_CASE("missing keys are told at their table") {
  check_mistake(with(rest, "end_time = 1e-3\n", ""), "schema", {"missing key \"end_time\"", "[s]"});
  check_mistake(with(rest, "shape = \"everywhere\"\n", ""), "[[region]]", {"missing key \"shape\"", "half_space"});
  check_mistake(with(rest, "\"everywhere\"", "\"sphere\"\ncenter = [0, 0]"), "[[region]]", {"missing key \"radius\""});
  check_mistake(with(rest, "material = \"air\"", "eos = { type = \"stiffened_gas\", gamma = 4.4 }\ndensity = 1"), "eos",
                {"missing key \"p_inf\"", "0 <= p_inf"});
  check_mistake(with(rest, "material = \"air\"", "eos = { gamma = 1.4 }\ndensity = 1"), "eos",
                {"missing key \"type\"", "stiffened_gas, ideal_gas"});
  check_mistake(with(rest, "material = \"copper\"", "eos = { type = \"ideal_gas\", gamma = 2 }\nelastic = { mu = 3 }"),
                "elastic", {"missing key \"rho0\""});
  check_mistake(with(rest, "pressure = 1e5\n", ""), "[[region]]", {"missing key \"pressure\"", "\"air\""});
  check_mistake(with(rest, "fill = \"air\"\n", ""), "[[region]]", {"neither fill nor alpha"});
  check_mistake(with(rest, "material = \"air\"\n", ""), "[phase.air]", {"neither material nor eos nor void"});
  check_replaced("\"wall\"", "{ type = \"periodic\" }", {"missing key \"with\""});
  check_mistake(rest + "[[integral]]\nname = \"a\"\n", "[[integral]]", {"neither extent nor quantile"});
}

TEST_CASE("a case without phases, regions or boundaries is refused") {
  const std::string head = "schema = 1\nmesh = \"../meshes/tube.geo\"\nend_time = 1\n";
  CHECK_THAT(mistakes_in(head), Contains("missing key \"phase\"") && Contains("missing key \"region\"") &&
                                    Contains("missing key \"boundary\""));
  const std::string region = rest.substr(rest.find("[[region]]"), rest.find("[boundary]") - rest.find("[[region]]"));
  check_mistake("region = []\n" + with(rest, region, ""), "region = []", {"no region", "at least one"});
}

TEST_CASE("unknown names of materials, phases, shapes and boundaries are refused with the nearest") {
  check_replaced("material = \"copper\"", "material = \"coper\"", {"aluminium, copper", "did you mean \"copper\"?"});
  check_replaced("fill = \"air\"", "fill = \"aire\"", {"unknown phase \"aire\"; allowed: air, copper", "\"air\"?"});
  check_replaced("fill = \"air\"", "alpha = { air = 0.5, cooper = 0.5 }", {"unknown phase \"cooper\"", "\"copper\"?"});
  check_mistake(with(rest, "pressure", "phase.cupper.pressure = 1\npressure"), "cupper",
                {"unknown phase", "\"copper\"?"});
  check_replaced("shape = \"everywhere\"", "shape = \"spere\"\ncenter = [0, 0]\nradius = 1",
                 {"everywhere, half_space, box, sphere", "did you mean \"sphere\"?"});
  check_replaced("\"wall\"", "\"wal\"", {"wall, no_slip, symmetry", "did you mean \"wall\"?"});
  check_replaced("\"wall\"", "{ type = \"transmisive\" }", {"did you mean \"transmissive\"?"});
  check_mistake(with(rest, "material = \"air\"", "eos = { type = \"ideal\", gamma = 1.4 }\ndensity = 1"), "eos",
                {"stiffened_gas, ideal_gas", "did you mean \"ideal_gas\"?"});
  check_mistake(rest + "[contact]\n\"air-coper\" = \"sliding\"\n", "air-coper",
                {"allowed: default, air-copper", "did you"});
  check_mistake(rest + "[contact]\n\"air-air\" = \"sliding\"\n", "air-air", {"not between two phases"});
  check_mistake(rest + "[[integral]]\nname = \"a\"\nextent = { phase = \"cop\", alpha = 0.5, axis = \"x\" }\n",
                "extent", {"unknown phase \"cop\"", "\"copper\"?"});
  check_mistake(rest +
                    "[[integral]]\nname = \"a\"\nextent = { phase = \"air\", alpha = 0.5, axis = \"x\", "
                    "box = { low = [0, 0], high = [0, 1] } }\n",
                "extent", {"box with high not above low"});
  check_mistake(rest + "[output]\nfields = [\"alpha\", \"presure\"]\n", "fields", {"alpha, density", "\"pressure\"?"});
}

TEST_CASE("names that become file names or columns are safe and unique") {
  const auto probe = [](const std::string& name) { return "[[probe]]\nname = \"" + name + "\"\nat = [0, 0]\n"; };
  for (const char* name : {"../a", "a/b", "..", ".hidden", "", "a,b", "a b", "/abs"})
    check_mistake(rest + probe(name), "name = \"" + std::string(name) + "\"", {"text of letters, digits"});
  check_mistake(rest + probe("history"), "name = \"history\"", {"is taken in the output directory"});
  CHECK_THAT(mistakes_in(rest + probe("a") + probe("a")), Contains("\"a\" is taken"));
  check_mistake(rest + "[[integral]]\nname = \"time\"\nextent = { phase = \"air\", alpha = 0.5, axis = \"x\" }\n",
                "name = \"time\"", {"is taken in history.csv"});
  check_mistake(with(rest, "[phase.copper]", "[phase.\"a/b\"]"), "[phase.\"a/b\"]", {"letters, digits, _ and -"});
}

TEST_CASE("output is by every or by count, not both") {
  check_mistake(rest + "[output]\nevery = 1e-4\ncount = 3\n", "count", {"both \"every\" and \"count\""});
  CHECK(read_text(rest).output.count == 20);
}

TEST_CASE("only names phases, a slice has a plane, its own name and either every or count") {
  check_mistake(rest + "[output]\nonly = \"coper\"\n", "only", {"unknown phase \"coper\"", "\"copper\"?"});
  check_mistake(rest + "[output]\nonly = [\"air\", 3]\n", "only", {"3", "text, or an array of texts"});
  check_mistake(rest + "[output]\nonly_above = 0.5\n", "only_above", {"without only"});
  check_mistake(rest + "[output]\nonly = \"air\"\nonly_above = 1\n", "only_above", {"0 <= only_above < 1"});
  const Setup only = read_text(rest + "[output]\nonly = [\"copper\", \"air\"]\nonly_above = 0.25\n");
  CHECK(only.output.only == std::vector<int>{1, 0});
  CHECK(only.output.only_above == 0.25);

  const std::string slice =
      rest + "[output]\nevery = 2e-5\n[[slice]]\nname = \"a\"\npoint = [0.5, 0]\nnormal = [1, 0]\n";
  CHECK(read_text(slice).slices[0].every == 2e-5);
  CHECK_FALSE(read_text(slice).slices[0].count);
  CHECK(read_text(slice + "count = 3\n").slices[0].count == 3);
  CHECK_FALSE(read_text(slice + "count = 3\n").slices[0].every);
  check_mistake(slice + "count = 3\nevery = 1\n", "count = 3", {"both \"every\" and \"count\""});
  check_mistake(with(slice, "normal = [1, 0]", "normal = [0, 0]"), "normal", {"length 0"});
  check_mistake(with(slice, "name = \"a\"", "name = \"case\""), "name = \"case\"", {"is taken"});
  CHECK_THAT(mistakes_in("scene = \"plane\"\n" + with(slice, "[1, 0]", "[0, 0, 1]")),
             Contains("slice \"a\": normal = [0, 0, 1] in a plane scene"));
}

TEST_CASE("the mesh is an existing .geo or .msh, and only a .geo takes parameters") {
  check_replaced("mesh = \"../meshes/tube.geo\"", "mesh = \"../meshes/tub.geo\"", {"there is no file", "tub.geo"});
  check_replaced("mesh = \"../meshes/tube.geo\"", "mesh = \"../meshes/tube.stl\"", {"a .geo or .msh file"});
  check_mistake(with(rest, "tube.geo\"", "tube.msh\"\nmesh_parameters = { n = 3 }"), "mesh_parameters", {"of a .geo"});
  check_mistake(with(rest, "tube.geo\"", "tube.geo\"\nmesh_parameters = { n = \"3\" }"), "mesh_parameters",
                {"mesh_parameters.n = \"3\"; allowed: a number"});
}

TEST_CASE("checkpoints come after steps from 1 on, or after minutes, not both and not neither") {
  const auto every = [](const std::string& value, const std::vector<std::string>& says) {
    check_mistake(with(rest, "end_time", "checkpoint_every = " + value + "\nend_time"), "checkpoint_every", says);
  };
  every("0", {"checkpoint_every = 0", "a whole number; or a table [steps], 1 <= checkpoint_every"});
  every("2.5", {"checkpoint_every = 2.5", "a whole number"});
  every("{ minutes = -1 }", {"minutes = -1", "0 < minutes"});
  every("{ steps = 1, seconds = 1 }", {"unknown key \"seconds\"", "allowed: steps, minutes"});
  every("{ steps = 1, minutes = 1 }", {"both \"steps\" and \"minutes\""});
  every("{}", {"neither steps nor minutes"});
}

TEST_CASE("all mistakes of a case are told together, in the order of the file") {
  std::string text = with(rest, "end_time = 1e-3", "end_time = -1");
  text = with(text, "material = \"copper\"", "material = \"coper\"");
  text = with(text, "\"wall\"", "\"wal\"");
  const std::string said = mistakes_in(text);
  CHECK(std::count(said.begin(), said.end(), '\n') == 2);
  const auto end_time = said.find("case.toml:3: end_time"), copper = said.find("case.toml:8: material"),
             wall = said.find("case.toml:16: * = \"wal\"");
  REQUIRE(wall != std::string::npos);
  CHECK(end_time < copper);
  CHECK(copper < wall);
}
