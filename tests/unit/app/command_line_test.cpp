#include "app/command_line.hpp"

#include <catch2/catch.hpp>

#include "math/errors.hpp"

using namespace cobasis;
using Catch::Matchers::Contains;
using Command = CommandLine::Command;

namespace {
using Set = std::vector<std::pair<std::string, std::string>>;
}

TEST_CASE("run takes a case, overrides and flags") {
  const CommandLine line = read_command_line({"run", "cases/impact.toml", "--output", "out dir", "--set", "cfl=0.4",
                                              "--set", "boundary.\"a=b\"=wall", "--trust-geo", "--quiet"});
  CHECK(line.command == Command::run);
  CHECK(line.file == "cases/impact.toml");
  CHECK(line.overrides.output == "out dir");
  CHECK(line.overrides.set == Set{{"cfl", "0.4"}, {"boundary.\"a=b\"", "wall"}});
  CHECK(line.trust_geo);
  CHECK(line.quiet);
}

TEST_CASE("without options a case runs as it is written") {
  const CommandLine line = read_command_line({"run", "a.toml"});
  CHECK(line.command == Command::run);
  CHECK(line.overrides.set.empty());
  CHECK(line.overrides.output.empty());
  CHECK_FALSE(line.trust_geo);
  CHECK_FALSE(line.quiet);
}

TEST_CASE("options may come before the case, and one --set may take several settings") {
  const Set expected{{"a", "1"}, {"b", "-2"}};
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"run", "--set", "a=1", "b=-2", "x.toml"},
        std::vector<std::string>{"run", "x.toml", "--set", "a=1", "b=-2"},
        std::vector<std::string>{"run", "--set", "a=1", "x.toml", "--set", "b=-2", "--quiet"},
        std::vector<std::string>{"run", "--set", "a=1", "--quiet", "x.toml", "--set", "b=-2"}}) {
    const CommandLine line = read_command_line(arguments);
    CHECK(line.file == "x.toml");
    CHECK(line.overrides.set == expected);
  }
}

TEST_CASE("values keep their brackets, commas and further equal signs") {
  const std::vector<std::string> values{"[1, 2]", "{ n = 2 }", "[\"-4000*y\", \"0\"]", "x == 3", "", "-1e5"};
  for (const std::string& value : values) {
    const CommandLine line = read_command_line({"run", "a.toml", "--set", "k.0.v=" + value});
    CHECK(line.overrides.set == Set{{"k.0.v", value}});
  }
}

TEST_CASE("check and info take their file") {
  const CommandLine check = read_command_line({"check", "a.toml", "--set", "scene=plane"});
  CHECK(check.command == Command::check);
  CHECK(check.overrides.set == Set{{"scene", "plane"}});
  const CommandLine info = read_command_line({"info", "tube.geo", "--trust-geo"});
  CHECK(info.command == Command::info);
  CHECK(info.file == "tube.geo");
  CHECK(info.trust_geo);
}

TEST_CASE("new takes a name and what the case is to be like") {
  const CommandLine line = read_command_line({"new", "a"});
  CHECK(line.command == Command::make);
  CHECK(line.file == "a");
  CHECK(line.like == "start");
  CHECK(read_command_line({"new", "--like", "impact", "a"}).like == "impact");
}

TEST_CASE("help and version are printed") {
  CHECK_THAT(read_command_line({"--version"}).text, Contains("cobasis " COBASIS_VERSION));
  CHECK(read_command_line({"--version"}).command == Command::print);
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--help"}, {"help"}}) {
    CHECK_THAT(read_command_line(arguments).text, Contains("run") && Contains("check") && Contains("info"));
  }
  CHECK_THAT(read_command_line({"run", "--help"}).text, Contains("--trust-geo") && Contains("--set"));
  CHECK_THAT(read_command_line({"help", "materials"}).text, Contains("copper: a solid, 8900 kg/m^3"));
  CHECK_THAT(read_command_line({"help", "case"}).text, Contains("end_time") && Contains("[s]"));
}

TEST_CASE("wrong usage is refused with what is allowed") {
  const auto refuses = [](const std::vector<std::string>& arguments, const std::string& found,
                          const std::string& allowed) {
    INFO(found);
    CHECK_THROWS_AS(read_command_line(arguments), InputError);
    CHECK_THROWS_WITH(read_command_line(arguments), Contains(found) && Contains(allowed));
  };
  refuses({}, "no command", "run, check, study, info, new, help");
  refuses({"rnu", "a.toml"}, "rnu", "did you mean \"run\"?");
  refuses({"nwe", "a"}, "nwe", "did you mean \"new\"?");
  refuses({"new"}, "no name", "cobasis new NAME");
  refuses({"new", "a", "--lik", "b"}, "--lik", "did you mean \"--like\"?");
  refuses({"run"}, "no file", "cobasis run CASE");
  refuses({"check", "a.toml", "--restart"}, "--restart", "--trust-geo");
  refuses({"run", "a.toml", "--quite"}, "--quite", "did you mean \"--quiet\"?");
  refuses({"run", "a.toml", "b.toml"}, "b.toml", "one file");
  refuses({"run", "a.toml", "--set", "cfl"}, "cfl", "key=value");
  refuses({"run", "a.toml", "--output"}, "--output", "--help");
  refuses({"check", "a.toml", "--output", "d"}, "--output", "--set");
  refuses({"info", "a.msh", "--set", "a=1"}, "--set", "--trust-geo");
  refuses({"help", "cases"}, "cases", "did you mean \"case\"?");
  refuses({"help", "mat"}, "mat", "did you mean \"materials\"?");
  refuses({"--frobnicate"}, "--frobnicate", "--help");
  refuses({"run", "a.toml", "--set", "=3"}, "=3", "key=value");
}
