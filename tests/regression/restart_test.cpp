// Runs that are interrupted and go on: the same bytes as a run that was not.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>

#include "program.hpp"

using namespace cobasis::test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

const std::string ball = R"(schema = 1
title = "a ball strikes a plate"
mesh = ")" SOURCE_DIR R"(/meshes/box.geo"
mesh_parameters = { n = 16, element = 3 }
end_time = 0.15e-3
[phase.copper]
material = "copper"
[phase.aluminium]
material = "aluminium"
[phase.air]
material = "air"
[[region]]
shape = "everywhere"
fill = "air"
pressure = 1e5
[[region]]
shape = "box"
low = [0.5, 0.1]
high = [0.7, 0.9]
fill = "aluminium"
pressure = 1e5
[[region]]
shape = "sphere"
center = [0.3, 0.5]
radius = 0.18
fill = "copper"
pressure = 1e5
velocity = [800.0, 0.0]
[boundary]
"*" = "transmissive"
[output]
count = 5
[[line]]
name = "axis"
from = [0.0, 0.5]
to = [1.0, 0.5]
points = 40
[[probe]]
name = "gauge"
at = [0.6, 0.5]
[[integral]]
name = "front"
extent = { phase = "copper", alpha = 0.5, axis = "x" }
)";

/// Every file below the folder but the checkpoints and, unless asked for, the fields, whose pieces go by ranks.
std::map<std::string, std::string> results(const fs::path& folder, bool fields) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = fs::relative(entry.path(), folder).string();
    if (entry.is_regular_file() && !name.starts_with("checkpoints") && (fields || !name.starts_with("fields")))
      files[name] = contents_of(entry.path());
  }
  return files;
}

void check_same(const fs::path& interrupted, const fs::path& whole, bool fields) {
  const auto found = results(interrupted, fields), expected = results(whole, fields);
  CHECK(found.size() == expected.size());
  for (const auto& [name, bytes] : expected) {
    CAPTURE(name);
    REQUIRE(found.contains(name));
    const bool same = found.at(name) == bytes;
    CHECK(same);
  }
}

struct Leg {
  int steps, ranks;
};

Outcome run(const Folder& folder, const std::string& arguments, int ranks = 1) {
  const std::string launcher = ranks > 1 ? fmt::format("mpirun --quiet -n {} ", ranks) : "";
  return shell(launcher + program_with("run " + arguments), folder);
}

std::string last_line(const Outcome& outcome) {
  return std::regex_replace(lines_of(outcome.out).back(), std::regex("seconds=.*mass_error"), "mass_error");
}

/// A whole run on one rank, and one that ends after some steps and goes on several times, on so many ranks.
void check_restarts(const std::string& file, const std::string& set, const std::vector<Leg>& legs, int last_ranks) {
  const Folder folder;
  folder.write("ball.toml", ball);
  const std::string what = file + " --quiet --set " + set;
  const Outcome whole = run(folder, what + " --output whole");
  INFO(whole.out << whole.err);
  REQUIRE(whole.status == 0);
  bool same_ranks = last_ranks == 1;
  std::string restart;
  for (const Leg& leg : legs) {
    const Outcome outcome =
        run(folder, what + fmt::format(" max_steps={} checkpoint_every=100000 --output parts", leg.steps) + restart,
            leg.ranks);
    INFO(outcome.out << outcome.err);
    REQUIRE(outcome.status == 0);
    restart = " --restart";
    same_ranks = same_ranks && leg.ranks == 1;
  }
  const Outcome rest = run(folder, what + " --output parts --restart", last_ranks);
  INFO(rest.out << rest.err);
  REQUIRE(rest.status == 0);
  CHECK(last_line(rest) == last_line(whole));
  check_same(folder.path("parts"), folder.path("whole"), same_ranks);
}

/// Words for bash, one by one in quotation marks.
std::string quoted_words(const std::string& words) { return std::regex_replace(words, std::regex("[^ ]+"), "'$&'"); }

std::string damaged(std::string bytes, std::size_t at) {
  bytes[at] = static_cast<char>(bytes[at] ^ 0x10);
  return bytes;
}

void write(const fs::path& file, const std::string& bytes) { std::ofstream(file, std::ios::binary) << bytes; }

}  // namespace

TEST_CASE("a run that is interrupted and goes on leaves the bytes of one that was not, also on other ranks") {
  for (const std::string interface : {"diffuse", "compressed"}) {
    CAPTURE(interface);
    check_restarts("ball.toml", "scheme.interface=" + interface, {{11, 1}, {40, 1}}, 1);
    check_restarts("ball.toml", "scheme.interface=" + interface, {{7, 1}, {31, 3}}, 2);
  }
  check_restarts("ball.toml", "scheme.interface=sharp", {{17, 1}, {50, 1}}, 1);
}

TEST_CASE("a fast body on triangles goes on with the same bytes, in a plane and around an axis") {
  // it leaves cells within a step, whose slopes and wetted faces must not be felt later
  const std::string fast =
      "'mesh_parameters={ n = 24, element = 3 }' 'region=[{ shape = \"everywhere\", fill = \"air\", "
      "pressure = 1e5 }, { shape = \"sphere\", center = [0.35, HEIGHT], radius = 0.2, fill = "
      "\"copper\", pressure = 1e5, velocity = [2000, 0] }]' 'phase={ copper = { material = "
      "\"copper\" }, air = { material = \"air\" } }'";
  const auto at = [&](const std::string& height) { return std::regex_replace(fast, std::regex("HEIGHT"), height); };
  check_restarts("ball.toml", at("0.5"), {{3, 1}, {20, 1}}, 1);
  check_restarts("ball.toml", at("0.0") + " scene=axisymmetric 'boundary.bottom=\"axis\"'", {{20, 1}, {50, 1}}, 1);
}

TEST_CASE("the droplet with a sharp surface goes on with the same bytes, around an axis and in space") {
  const std::string axis = quoted(case_file("droplet_axisymmetric")), space = quoted(case_file("droplet")),
                    short_axis = "mesh_parameters.h=1e-3 end_time=0.5e-3 output.count=4",
                    short_space = "mesh_parameters.h=2e-3 end_time=1e-3 output.count=3";
  check_restarts(axis, short_axis, {{9, 1}, {33, 1}}, 1);
  check_restarts(axis, short_axis, {{9, 1}, {33, 3}}, 2);
  check_restarts(space, short_space, {{5, 1}, {13, 3}}, 2);
}

TEST_CASE("SIGTERM and SIGUSR1 leave a checkpoint, and the run goes on from it with the same bytes") {
  const Folder folder;
  folder.write("ball.toml", ball);
  REQUIRE(run(folder, "ball.toml --quiet --output whole").status == 0);
  const std::string start = program_with("run ball.toml --quiet --output parts");
  const Outcome stopped =
      shell(start +
                " & pid=$!; until [ -e parts/history.csv ]; do sleep 0.01; done; kill -USR1 $pid; "
                "until ls parts/checkpoints/*.h5 >/dev/null 2>&1 || ! kill -0 $pid 2>/dev/null; do sleep 0.005; done; "
                "kill -TERM $pid; wait $pid",
            folder);
  INFO(stopped.out << stopped.err);
  CHECK(stopped.status == 4);
  CHECK_THAT(stopped.err, Contains("cobasis: checkpoint 'parts/checkpoints/ball_") &&
                              Contains("stopped by SIGTERM after step") && Contains("--restart goes on"));
  const Outcome rest = run(folder, "ball.toml --quiet --output parts --restart");
  INFO(rest.err);
  CHECK(rest.status == 0);
  check_same(folder.path("parts"), folder.path("whole"), true);
}

TEST_CASE("a checkpoint that is damaged anywhere is refused, and the one before is taken") {
  const Folder folder;
  folder.write("ball.toml", ball);
  REQUIRE(run(folder, "ball.toml --quiet --output whole").status == 0);
  REQUIRE(run(folder, "ball.toml --quiet --output parts --set checkpoint_every=10 max_steps=25").status == 0);
  const fs::path newest = folder.path("parts/checkpoints/ball_000000025.h5"),
                 before = folder.path("parts/checkpoints/ball_000000020.h5");
  const std::string bytes = contents_of(newest), bytes_before = contents_of(before);
  CHECK(fs::exists(newest));
  const auto refused = [&] {
    // a run of no further step: which checkpoint it takes, it tells
    const Outcome outcome = run(folder, "ball.toml --output parts --restart --set max_steps=1");
    INFO(outcome.out << outcome.err);
    CHECK(outcome.status == 0);
    return outcome.err.find("ball_000000025.h5' cannot be used") != std::string::npos &&
           outcome.out.find("restart from 'parts/checkpoints/ball_000000020.h5'") != std::string::npos;
  };
  std::vector<std::size_t> places{0, 20, 60, 511, 512, 600, bytes.size() - 1};
  for (std::size_t i = 1; i < 4; ++i) places.push_back(i * bytes.size() / 4);
  for (const std::size_t at : places) {
    write(newest, damaged(bytes, at));
    CAPTURE(at, bytes.size());
    CHECK(refused());
  }
  for (const std::size_t size : {std::size_t{0}, std::size_t{512}, bytes.size() - 1}) {
    write(newest, bytes.substr(0, size));
    CAPTURE(size);
    CHECK(refused());
  }
  write(newest, bytes + "x");
  CHECK(refused());

  write(before, damaged(bytes_before, 5000));
  const Outcome none = run(folder, "ball.toml --quiet --output parts --restart");
  CHECK(none.status == 2);
  CHECK_THAT(none.err, Contains("no checkpoint in 'parts/checkpoints' is whole; allowed: a run without --restart"));

  write(before, bytes_before);
  CHECK(run(folder, "ball.toml --quiet --output parts --restart").status == 0);
  check_same(folder.path("parts"), folder.path("whole"), true);
}

TEST_CASE("a restart from another case or mesh is refused, and what differs is told") {
  const Folder folder;
  folder.write("ball.toml", ball);
  const auto restart = [&](const std::string& set) {
    return run(folder, "ball.toml --quiet --output parts --restart " + set);
  };
  const Outcome none = restart("");
  CHECK(none.status == 2);
  CHECK_THAT(none.err, Contains("there is no checkpoint in 'parts/checkpoints'"));
  REQUIRE(run(folder, "ball.toml --quiet --output parts --set checkpoint_every=1000 max_steps=5").status == 0);
  const Outcome other = restart("--set region.2.velocity=[900,0] phase.air.density=2");
  CHECK(other.status == 2);
  CHECK_THAT(other.err, Contains("region.2.velocity.0 = 900 instead of 800") &&
                            Contains("phase.air.density = 2, which was not there") &&
                            Contains("allowed to change: end_time"));
  const Outcome finer = restart("--set mesh_parameters.n=20");
  CHECK(finer.status == 2);
  CHECK_THAT(finer.err, Contains("is of another mesh") && Contains("cells, checksum"));
  const Outcome later = restart("--set end_time=2e-6 output.count=3 title=same output.history_every=1");
  INFO(later.err);
  CHECK(later.status == 0);
}

TEST_CASE("a disk that is full ends a run with status 4, the path and the reason, and leaves nothing half written") {
  const Folder folder;
  folder.write("ball.toml", ball);
  struct Way {
    std::string set, file;
  };
  const std::string small = "output.fields=[\"alpha\"] output.history_every=1 ";
  for (const Way& way : {Way{"output.history_every=1", "fields/ball_0001_0.vtu"}, Way{small, "history.csv"},
                         Way{small + "checkpoint_every=10", "checkpoints/ball_000000010.h5"}}) {
    CAPTURE(way.set);
    // No file may grow beyond 40 blocks of 1024 bytes; MPI makes larger ones unless it is told that it is alone.
    const Outcome outcome =
        shell("ulimit -f 40; export OMPI_MCA_ess_singleton_isolated=1 OMPI_MCA_pmix=isolated; " +
                  program_with("run ball.toml --quiet --output full --set " + quoted_words(way.set)),
              folder);
    INFO(outcome.out << outcome.err);
    CHECK(outcome.status == 4);
    CHECK(outcome.err == "cannot write 'full/" + way.file + "': File too large\n");
    for (const auto& entry : fs::recursive_directory_iterator(folder.path("full")))
      CHECK(entry.path().extension() != ".part");
    if (fs::exists(folder.path("full/history.csv")))
      CHECK(contents_of(folder.path("full/history.csv")).ends_with("\n"));
    fs::remove_all(folder.path("full"));
  }
  fs::create_directories(folder.path("full"));
  write(folder.path("full/checkpoints"), "in the way");
  const Outcome outcome = run(folder, "ball.toml --quiet --output full");
  CHECK(outcome.status == 4);
  CHECK_THAT(outcome.err, Contains("directory 'full/checkpoints'"));
}

TEST_CASE("when a rank is killed the run ends and says so, and goes on from its checkpoint with the same bytes") {
  const Folder folder;
  folder.write("ball.toml", ball);
  REQUIRE(run(folder, "ball.toml --quiet --output whole").status == 0);
  const std::string kill_one = "sleep 0.0$((RANDOM % 10)); kill -9 $(pgrep -P $pid -x cobasis | shuf -n 1); ";
  // mpirun may hang in its own end when all ranks have come to theirs
  const std::string end =
      "(sleep 60; kill -9 $pid) >/dev/null 2>&1 & dog=$!; wait $pid; status=$?; kill $dog; exit $status";
  const Outcome killed =
      shell("mpirun --quiet -n 2 " + program_with("run ball.toml --quiet --output parts --set checkpoint_every=5") +
                " & pid=$!; until ls parts/checkpoints/*.h5 >/dev/null 2>&1; do sleep 0.01; done; " + kill_one + end,
            folder);
  INFO(killed.out << killed.err);
  CHECK(killed.status != 0);
  const Outcome rest = run(folder, "ball.toml --quiet --output parts --restart");
  INFO(rest.err);
  CHECK(rest.status == 0);
  check_same(folder.path("parts"), folder.path("whole"), false);
}

TEST_CASE("a run that turns unphysical names its last checkpoint and leaves the fields before the step that failed") {
  const Folder folder;
  // so fast that the energy has no digits left for the pressure
  folder.write("ball.toml", ball);
  const Outcome outcome = run(folder,
                              "ball.toml --quiet --output out --set checkpoint_every=1 region.2.velocity=[8e10,3e9] "
                              "region.1.velocity=[3e10,1e10] scheme.interface=sharp output.count=1");
  INFO(outcome.err);
  REQUIRE(outcome.status == 3);
  std::smatch told;
  REQUIRE(std::regex_search(
      outcome.err, told,
      std::regex("stopped: step ([0-9]+), .*the state before this step is in '(.*)'; the last checkpoint is '(.*)'")));
  CHECK(fs::exists(folder.path(told[2])));
  CHECK(fs::exists(folder.path(told[3])));
  CHECK_THAT(told[3].str(), Catch::Matchers::EndsWith(fmt::format("_{:09}.h5", std::stoi(told[1]))));
}

TEST_CASE("a run and a restart under a locale with a decimal comma leave the same bytes") {
  const Folder folder;
  folder.write("ball.toml", ball);
  const std::string german =
      "mkdir -p locale; localedef -i de_DE -f UTF-8 locale/de_DE.UTF-8 >/dev/null 2>&1 || true; "
      "export LOCPATH=$PWD/locale LC_ALL=de_DE.UTF-8; bash -c '[ $(printf %.1f 0,5) = 0,5 ]'; ";
  REQUIRE(run(folder, "ball.toml --quiet --output whole").status == 0);
  for (const std::string steps : {" --set checkpoint_every=100 max_steps=21", " --restart"}) {
    const Outcome outcome = shell(german + program_with("run ball.toml --quiet --output german" + steps), folder);
    INFO(outcome.out << outcome.err);
    REQUIRE(outcome.status == 0);
  }
  check_same(folder.path("german"), folder.path("whole"), true);
}

TEST_CASE("ranks killed at random moments, also while a checkpoint is written, cost no byte") {
  const Folder folder;
  const Outcome outcome =
      shell(SOURCE_DIR "/tools/faults " + quoted(COBASIS_PROGRAM) + " --kills 4 --per-run 4", folder);
  INFO(outcome.out << outcome.err);
  CHECK(outcome.status == 0);
  CHECK(std::regex_search(outcome.out, std::regex("kills=4 during_checkpoint=[1-4] .*: all the same")));
}
