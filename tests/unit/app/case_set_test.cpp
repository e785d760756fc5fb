// --set key=value and --output.
#include <catch2/catch.hpp>

#include "case_file.hpp"

using namespace cobasis;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

Setup set(const std::string& text, const std::string& key, const std::string& value) {
  return read_text(text, {{{key, value}}, ""});
}

std::string mistakes_of_set(const std::string& text, const std::string& key, const std::string& value) {
  return mistakes_in(text, {{{key, value}}, ""});
}

}  // namespace

TEST_CASE("key by key, --set changes and creates") {
  CHECK(set(rest, "end_time", "2").end_time == 2);
  CHECK(set(rest, "cfl", "0.25").cfl == 0.25);
  CHECK(set(rest, "mesh_parameters.n", "500").mesh_parameters.at("n") == 500);
  CHECK(set(rest, "output.count", "3").output.count == 3);
  CHECK(set(rest, "region.0.pressure", "2e5").regions[0].filling.states[0].pressure.constant() == 2e5);
  CHECK(set(rest, "region.0.phase.air.density", "3").regions[0].filling.states[0].density->constant() == 3.0);
  CHECK(set(rest, "phase.air.eos.gamma", "1.3").phases[0].name == "air");
  CHECK(std::get<IdealGas>(set(rest, "phase.air.eos.gamma", "1.3").phases[0].eos).gamma == 1.3);
}

TEST_CASE("dotted keys of --set reach into inline tables and arrays") {
  const std::string inline_table = "mesh_parameters = { n = 2000, m = 3 }\n" + rest;
  const Setup setup = set(inline_table, "mesh_parameters.n", "500");
  CHECK(setup.mesh_parameters == std::map<std::string, double>{{"n", 500}, {"m", 3}});
  const std::string moving = with(rest, "pressure = 1e5", "pressure = 1e5\nvelocity = [1, 2]");
  CHECK(set(moving, "region.0.velocity.1", "7").regions[0].filling.states[0].velocity[1].constant() == 7);
}

TEST_CASE("bare words are text, and quotes may hold dots and stars") {
  CHECK(set(rest, "scene", "plane").scene == Geometry::plane);
  CHECK(set(rest, "title", "two words").title == "two words");
  CHECK(set(rest, "title", "\"quoted\"").title == "quoted");
  CHECK(set(rest, "mesh", "../meshes/tube.msh").mesh_file.ends_with("meshes/tube.msh"));
  CHECK(std::holds_alternative<Symmetry>(set(rest, "boundary.\"*\"", "symmetry").boundaries[0].boundary));
  CHECK(set(rest, "boundary.\"a.b\"", "symmetry").boundaries[1].group == "a.b");
  CHECK(set(rest, "boundary.*", "{ type = \"symmetry\" }").boundaries.size() == 1);
}

TEST_CASE("a phase that --set makes and nothing is filled with is taken for a misspelt one") {
  CHECK_THAT(
      mistakes_of_set(rest, "phase.coper.material", "copper"),
      StartsWith("--set phase.coper.material: phase \"coper\" fills no region; allowed: air, copper; did you mean "
                 "\"copper\"?"));
  CHECK_THAT(mistakes_of_set(rest, "phase.coper.elastic.mu", "1e9"), Contains("did you mean \"copper\"?"));
  CHECK(read_text(rest, {{{"phase.water.material", "water"}, {"region.0.fill", "water"}}, ""}).phases.size() == 3);
}

TEST_CASE("the later --set wins, and the command line replaces what it excludes in the file") {
  CHECK(read_text(rest, {{{"cfl", "0.1"}, {"cfl", "0.2"}}, ""}).cfl == 0.2);
  const Setup count = set(rest + "[output]\nevery = 1e-4\n", "output.count", "7");
  CHECK(count.output.count == 7);
  CHECK_FALSE(count.output.every);
  const std::string contact = rest + "[contact]\nair-copper = \"sliding\"\n";
  CHECK(set(contact, "contact.copper-air", "adherence").contact(0, 1) == Contact::adherence);
}

TEST_CASE("mistakes of --set are told by its key, like those of the file by their line") {
  CHECK(mistakes_of_set(rest, "cfl", "3") == "--set cfl: cfl = 3; allowed: a number [-], 0 < cfl <= 2");
  CHECK_THAT(mistakes_of_set(rest, "endtime", "3"),
             StartsWith("--set endtime: unknown key \"endtime\"") && Contains("did you mean \"end_time\"?"));
  CHECK_THAT(mistakes_of_set(rest, "region.0.presure", "3"),
             StartsWith("--set region.0.presure: unknown key") && Contains("did you mean \"pressure\"?"));
  CHECK_THAT(mistakes_of_set(rest, "region.0.velocity", "[1, 2, \"x+\"]"), StartsWith("--set region.0.velocity: "));
  CHECK_THAT(mistakes_of_set(rest, "region.1.pressure", "3"),
             StartsWith("--set region.1.pressure: ") && Contains("allowed: 0 to 0"));
  CHECK_THAT(mistakes_of_set(rest, "mesh.x", "3"), StartsWith("--set mesh.x: \"mesh\" is \"../meshes/tube.geo\""));
  CHECK_THAT(mistakes_of_set(rest, "a..b", "3"), Contains("is not a key"));
  CHECK_THAT(mistakes_of_set(rest, "cfl", "[1"), StartsWith("--set cfl: value [1: "));
  CHECK_THAT(mistakes_of_set(rest, "scene", "plain"), Contains("did you mean \"plane\"?"));
  CHECK_THAT(mistakes_of_set(rest, "cfl", "0.1\nmax_steps = 3"), StartsWith("--set cfl: "));
}

TEST_CASE("output goes where the command line, else the case, else the case's name says") {
  const CaseFile file(rest + "[output]\ndirectory = \"../results/impact\"\n");
  CHECK(read_case(file.path()).output.directory == (file.directory() / "results" / "impact").string());
  CHECK(read_case(file.path(), {{}, "elsewhere"}).output.directory == "elsewhere");
  CHECK(read_text(rest).output.directory == "case");
}
