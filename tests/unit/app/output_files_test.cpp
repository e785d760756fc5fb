#include <sys/resource.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <locale>

#include "app/atomic_file.hpp"
#include "app/output.hpp"
#include "math/errors.hpp"
#include "output_scene.hpp"

namespace cobasis::test {
namespace {

namespace fs = std::filesystem;

/// Lets files grow no further than so many bytes while it lives, as a full disk would.
struct SmallDisk {
  rlimit before{};
  explicit SmallDisk(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &before);
    const rlimit now{bytes, before.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &now);
  }
  ~SmallDisk() { ::setrlimit(RLIMIT_FSIZE, &before); }
};

std::size_t count_files(const fs::path& directory) {
  std::size_t n = 0;
  for (const auto& entry : fs::recursive_directory_iterator(directory)) n += entry.is_regular_file();
  return n;
}

TEST_CASE("a file that cannot be written whole leaves the former one and nothing else") {
  const Scratch scratch;
  const std::string path = (scratch.path / "table.csv").string();
  write_atomically(path, "old");
  {
    const SmallDisk disk(1000);
    CHECK_THROWS_WITH(write_atomically(path, std::string(2000, 'x')),
                      Catch::Contains(path) && Catch::Contains("File too large"));
  }
  CHECK(read(path) == "old");
  CHECK(count_files(scratch.path) == 1);
  write_atomically(path, "new");
  CHECK(read(path) == "new");
}

TEST_CASE("a row that does not fit leaves no part of it") {
  const Scratch scratch;
  const std::string path = (scratch.path / "history.csv").string();
  RowFile rows(path, "step\n");
  rows.append("1\n");
  {
    const SmallDisk disk(10);
    CHECK_THROWS_AS(rows.append("22222222222222\n"), SystemError);
  }
  CHECK(read(path) == "step\n1\n");
  rows.append("3\n");
  rows.close();
  CHECK(read(path) == "step\n1\n3\n");
}

TEST_CASE("a directory that cannot be made is the user's error, named") {
  const Scratch scratch;
  write_atomically((scratch.path / "occupied").string(), "a file");
  Setup setup = three_phases(scratch.path / "occupied" / "results");
  setup.output.where = "case.toml:7";
  const Mesh mesh = squares(4, 1, 1);
  CHECK_THROWS_AS(Output(setup, Geometry::plane, mesh, world()), InputError);
  CHECK_THROWS_WITH(Output(setup, Geometry::plane, mesh, world()),
                    Catch::Contains("case.toml:7") && Catch::Contains("occupied/results"));
  CHECK(read(scratch.path / "occupied") == "a file");
}

TEST_CASE("an output that does not fit on the disk is an error and leaves the collection as it was") {
  const Scratch scratch;
  const Mesh mesh = squares(30, 30, 1);
  Setup setup = three_phases(scratch.path);
  Output output(setup, Geometry::plane, mesh, world());
  output.write(three_phase_state(900, 0));
  const std::string before = read(scratch.path / "impact.pvd");
  const std::size_t n_files = count_files(scratch.path);
  {
    const SmallDisk disk(2000);
    CHECK_THROWS_AS(output.write(three_phase_state(900, 1)), SystemError);
  }
  CHECK(read(scratch.path / "impact.pvd") == before);
  CHECK(count_files(scratch.path) == n_files);
}

TEST_CASE("the collection lists every time with its fields") {
  const Scratch scratch;
  const Mesh mesh = squares(4, 1, 1);
  Output output(three_phases(scratch.path / "new" / "folder"), Geometry::plane, mesh, world());
  for (const double time : {0.0, 2.5e-5}) output.write(three_phase_state(4, time));
  const std::string pvd = read(scratch.path / "new/folder/impact.pvd");
  CHECK_THAT(pvd, Catch::Contains("timestep=\"0\" part=\"0\" file=\"fields/impact_0000.pvtu\""));
  CHECK_THAT(pvd, Catch::Contains("timestep=\"2.5e-05\" part=\"0\" file=\"fields/impact_0001.pvtu\""));
  CHECK(fs::exists(scratch.path / "new/folder/fields/impact_0001_0.vtu"));
}

TEST_CASE("a new run takes away what an earlier one left and nothing of others") {
  const Scratch scratch;
  const Mesh mesh = squares(4, 1, 1);
  Setup setup = three_phases(scratch.path);
  setup.lines = {{"axis", {0.5, 0.5, 0}, {3.5, 0.5, 0}, 4}};
  fs::create_directories(scratch.path / "fields");
  fs::create_directories(scratch.path / "lines");
  const std::vector<std::string> ours = {"fields/impact_0000_5.vtu", "fields/impact_0003.pvtu",
                                         "fields/impact_0003_0.vtu", "fields/impact_10000_12.vtu",
                                         "lines/axis_0003.csv"};
  const std::vector<std::string> others = {"fields/other_0003.pvtu", "fields/impact_final.vtu",
                                           "fields/impact_0003.png", "lines/wall_0003.csv", "notes.txt"};
  for (const auto& name : ours) write_atomically((scratch.path / name).string(), "former");
  for (const auto& name : others) write_atomically((scratch.path / name).string(), "mine");

  Output output(setup, Geometry::plane, mesh, world());
  for (const auto& name : ours) CHECK(fs::exists(scratch.path / name));
  output.write(three_phase_state(4, 0));
  for (const auto& name : ours) CHECK(!fs::exists(scratch.path / name));
  for (const auto& name : others) CHECK(read(scratch.path / name) == "mine");
  CHECK(fs::exists(scratch.path / "fields/impact_0000_0.vtu"));
  CHECK(fs::exists(scratch.path / "lines/axis_0000.csv"));
}

TEST_CASE("tables that would share a file are refused") {
  const Scratch scratch;
  const Mesh mesh = squares(4, 1, 1);
  const auto name = GENERATE(as<std::string>{}, "history", "units", "axis", "../axis");
  Setup setup = three_phases(scratch.path);
  setup.lines = {{"axis", {0.5, 0.5, 0}, {3.5, 0.5, 0}, 4}};
  setup.probes = {{name, {0.5, 0.5, 0}}};
  CHECK_THROWS_WITH(Output(setup, Geometry::plane, mesh, world()), Catch::Contains("[[probe]] name '" + name + "'"));
}

TEST_CASE("the history has step, time, dt, totals and integrals, numbers that read back exactly") {
  const Scratch scratch;
  const Mesh mesh = squares(4, 1, 1);
  Setup setup = three_phases(scratch.path);
  setup.integrals = {{"spread", Extent{0, 0.5, Axis::x}}};
  setup.probes = {{"gauge", {1.5, 0.5, 0}}};
  Output output(setup, Geometry::plane, mesh, world());
  CHECK(output.needs_alpha_for_history());
  CHECK(output.needs_fields_for_history());
  const double total = 0.1 + 0.2;
  output.history(three_phase_state(4, 0.25), {{"energy.copper", "J", total}});
  output.history(three_phase_state(4, 0.75), {{"energy.copper", "J", 1 / 3.0}});
  output.finish();

  const auto history = table(read(scratch.path / "history.csv"));
  CHECK(history.at(0) == std::vector<std::string>{"step", "time", "dt", "energy.copper", "spread"});
  REQUIRE(history.size() == 3);
  CHECK(history[1][0] == "7");
  CHECK(history[1][1] == "0.25");
  CHECK(history[1][2] == "0.5");
  CHECK(std::stod(history[1][3]) == total);
  CHECK(std::stod(history[2][3]) == 1 / 3.0);
  CHECK(history[1][4] == "2.5");
  CHECK(output.integral("spread") == 2.5);

  const auto gauge = table(read(scratch.path / "gauge.csv"));
  REQUIRE(gauge.size() == 3);
  CHECK(gauge[0][0] == "step");
  CHECK(gauge[0][1] == "time");
  CHECK(gauge[2][1] == "0.75");
  CHECK(cell_of(gauge, 1, "density.copper") == "101.125");
  CHECK(cell_of(gauge, 1, "density.gas") == "nan");

  output.write(three_phase_state(4, 1));  // energy.copper of a cell is per mass
  const std::string units = read(scratch.path / "units.csv");
  CHECK_THAT(units, Catch::Contains("\nhistory,energy.copper,J\n"));
  CHECK_THAT(units, Catch::Contains("\nfields,energy.copper,J/kg\n"));
  CHECK_THAT(units, Catch::Contains("\nhistory,spread,m\n"));
}

TEST_CASE("the locale does not reach the numbers") {
  struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
  };
  const std::locale before = std::locale::global(std::locale(std::locale(), new Comma));
  const Scratch scratch;
  const Mesh mesh = squares(4, 1, 0.5);
  Setup setup = three_phases(scratch.path);
  setup.lines = {{"axis", {0.25, 0.25, 0}, {1.75, 0.25, 0}, 4}};
  Output output(setup, Geometry::plane, mesh, world());
  output.write(three_phase_state(4, 0.5));
  std::locale::global(before);
  CHECK_THAT(read(scratch.path / "axis.csv"), Catch::StartsWith("x,y,z,") && Catch::Contains("\n0.25,0.25,0,"));
  CHECK_THAT(read(scratch.path / "impact.pvd"), Catch::Contains("timestep=\"0.5\""));
}

}  // namespace
}  // namespace cobasis::test
