// `cobasis new`, and what `cobasis check` foretells.
#include <algorithm>
#include <catch2/catch.hpp>
#include <regex>

#include "program.hpp"

using namespace cobasis::test;
using Catch::Matchers::Contains;

TEST_CASE("a new case runs as it is written, wherever that is") {
  const Folder folder;
  const Outcome made = shell(program_with("new first"), folder);
  INFO(made.err);
  REQUIRE(made.status == 0);
  CHECK(folder.contents() == std::vector<std::string>{"first.geo", "first.toml"});
  CHECK_THAT(contents_of(folder.path("first.toml")), Contains("mesh = \"first.geo\""));
  CHECK_THAT(made.out, Contains("cobasis run first.toml"));
  const Outcome run = shell(program_with("run first.toml --quiet"), folder);
  INFO(run.err);
  CHECK(run.status == 0);
  CHECK(std::filesystem::exists(folder.path("first/first.pvd")));

  REQUIRE(shell("mkdir deep && " + program_with("new deep/second.toml"), folder).status == 0);
  CHECK(shell(program_with("run deep/second.toml --quiet --set max_steps=2"), folder).status == 0);
}

TEST_CASE("every case of the project can be the start of a new one, and loses nothing but its way to the mesh") {
  int cases = 0;
  for (const auto& entry : std::filesystem::directory_iterator(SOURCE_DIR "/cases")) {
    if (entry.path().extension() != ".toml") continue;
    const std::string like = entry.path().stem();
    CAPTURE(like);
    ++cases;
    const Folder folder;
    const Outcome outcome = shell(
        program_with("new mine --like " + like) + " && " + program_with("check mine.toml --set max_steps=2"), folder);
    INFO(outcome.err);
    CHECK(outcome.status == 0);
    const std::string text = contents_of(entry.path());
    const std::regex mesh("\\.\\./meshes/([a-z_]+\\.geo)");
    std::smatch found;
    REQUIRE(std::regex_search(text, found, mesh));
    CHECK(contents_of(folder.path("mine.toml")) ==
          std::regex_replace(text, mesh, "mine.geo", std::regex_constants::format_first_only));
    CHECK(contents_of(folder.path("mine.geo")) == contents_of(SOURCE_DIR "/meshes/" + found[1].str()));
  }
  CHECK(cases > 5);
}

TEST_CASE("a new case overwrites nothing and is called what files can be called") {
  const Folder folder;
  folder.write("taken.toml", "mine");
  folder.write("meshed.geo", "mine too");
  const auto before = folder.contents();
  for (const std::string arguments : {"taken", "meshed", "none/there", "'a b'", ".hidden", "' '", "x --like impct"}) {
    const Outcome outcome = shell(program_with("new " + arguments), folder);
    INFO(arguments << ": " << outcome.out << outcome.err);
    CHECK(outcome.status == 2);
    CHECK_THAT(outcome.err, Contains("allowed: "));
    CHECK(folder.contents() == before);
  }
  CHECK(contents_of(folder.path("taken.toml")) == "mine");
  CHECK_THAT(shell(program_with("new x --like impct"), folder).err, Contains("did you mean \"impact\"?"));
}

TEST_CASE("check foretells what a run requires, and how it knows") {
  const Folder folder;
  const auto check = [&](const std::string& options) {
    const Outcome outcome =
        shell(program_with("check " + quoted(case_file("impact")) + " --set mesh_parameters.n=100 " + options), folder);
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    return outcome.out;
  };
  const std::string all = check("");
  INFO(all);
  CHECK_THAT(all, Contains("plane scene, 100 cells") && Contains("copper: solid, 136 bytes of state per cell") &&
                      Contains("state: 272 bytes per cell, 0.0272 MB in all") && Contains("on 1 rank"));
  // a run so short that check makes all of it knows the number of steps, and so does the run
  std::smatch steps, made;
  REQUIRE(std::regex_search(all, steps, std::regex("step: [0-9.e-]+ s at t = 0; in all ([0-9]+) steps to 5e-05 s")));
  const Outcome run = shell(program_with("run " + quoted(case_file("impact")) +
                                         " --output out --quiet --set mesh_parameters.n=100 output.count=1"),
                            folder);
  REQUIRE(std::regex_search(run.out, made, std::regex("steps=([0-9]+)")));
  CHECK(steps[1] == made[1]);

  CHECK_THAT(check("max_steps=3"), Contains("if it stays so, 3 steps to") && Contains("first 3 steps"));
  CHECK_THAT(check("max_steps=1"), Contains("measured over the only step"));
}
