// What a run says and leaves behind.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <regex>

#include "program.hpp"

using namespace cobasis::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

/// Runs one of the project's cases into `out`.
Outcome run(const Folder& folder, const std::string& name, const std::string& options,
            const std::string& launcher = "") {
  const Outcome outcome =
      shell(launcher + program_with("run " + quoted(case_file(name)) + " --output out " + options), folder);
  INFO(outcome.out << outcome.err);
  REQUIRE(outcome.status == 0);
  return outcome;
}

std::vector<std::string> all_matches(const std::string& text, const std::string& pattern) {
  std::vector<std::string> found;
  const std::regex expression(pattern);
  for (std::sregex_iterator i(text.begin(), text.end(), expression), end; i != end; ++i) found.push_back((*i)[1]);
  return found;
}

}  // namespace

TEST_CASE("a run ends with one line that a program can read, and says nothing else when quiet") {
  const std::string number = R"(-?[0-9.]+(e[-+][0-9]+)?)";
  const std::regex last(
      fmt::format("cobasis: steps=([0-9]+) time={0} cells=([0-9]+) mixed={0}% seconds={0} pack={0}% "
                  "ns_per_cell_equation_evaluation={0} mass_error={0}",
                  number));
  const Folder folder;
  const auto told = lines_of(run(folder, "impact", "--set mesh_parameters.n=40").out);
  const auto quiet = lines_of(run(folder, "impact", "--set mesh_parameters.n=40 --quiet").out);
  REQUIRE(told.size() > 1);
  REQUIRE(quiet.size() == 1);
  CHECK_THAT(told.front(), StartsWith("Impact between two elastic solids"));
  for (const std::string& line : {told.back(), quiet.back()}) {
    CAPTURE(line);
    std::smatch match;
    REQUIRE(std::regex_match(line, match, last));
    CHECK(std::stoi(match[1]) > 10);
    CHECK(match[3] == "40");
    const auto value = [&](const std::string& key) {
      return std::stod(line.substr(line.find(key + "=") + key.size() + 1));
    };
    CHECK(value("time") == 50e-6);
    CHECK(value("mixed") > 0);
    CHECK(value("mass_error") < 1e-13);  // round-off
  }
}

TEST_CASE("a run that turns unphysical stops with status 3, cell, place, phase and time, on any number of ranks") {
  // so fast that the energy's last digit is a tenth of what the pressure may vary by: no smaller step helps
  const std::string options =
      "--quiet --set 'mesh=\"../meshes/box.geo\"' 'mesh_parameters={ n = 20 }' 'line=[]' "
      "'boundary={ \"*\" = \"transmissive\" }' 'region.0.velocity=[8e10, 3e9]' 'region.1.velocity=[3e10, 1e10]'";
  std::string said;
  for (const std::string launcher : {"", "mpirun --quiet -n 2 "}) {
    const Folder folder;
    const Outcome outcome =
        shell(launcher + program_with("run " + quoted(case_file("shear")) + " --output out " + options), folder);
    INFO(launcher << outcome.out << outcome.err);
    CHECK(outcome.status == 3);
    CHECK(outcome.out.empty());
    CHECK(std::regex_search(
        outcome.err,
        std::regex("cobasis: the run turned unphysical and was stopped: step [0-9]+, time [0-9.e-]+ s: phase "
                   "'aluminium' left its admissible states in cell [0-9]+ at \\([0-9.]+, [0-9.]+, 0\\): volume "
                   "fraction 1, density [0-9.]+ kg/m\\^3, pressure -[0-9.e+]+ Pa, cobasis \\(")));
    CHECK(std::filesystem::exists(folder.path("out/shear.pvd")));  // the way there can be looked at
    std::smatch fields;
    REQUIRE(std::regex_search(outcome.err, fields,
                              std::regex("the state before this step is in '(out/fields/shear_[0-9]+.pvtu)'\n$")));
    CHECK(std::filesystem::exists(folder.path(fields[1])));
    if (!said.empty()) CHECK_THAT(outcome.err, Contains(said));
    said = lines_of(outcome.err).at(0);
  }
}

TEST_CASE("a run whose steps would never end stops with status 3, and what makes them so small") {
  const Folder folder;
  const Outcome outcome = shell(program_with("run " + quoted(case_file("sod")) +
                                             " --output out --quiet --set end_time=1e4 'region.1.velocity=[1e7, 0]'"),
                                folder);
  INFO(outcome.out << outcome.err);
  CHECK(outcome.status == 3);
  CHECK_THAT(outcome.err, Contains("phase 'gas'") && Contains("waves or flow this fast allow steps of "));
}

TEST_CASE("the tables of a run on two ranks are those of a run on one to the last byte") {
  const auto check_same = [](const std::string& name, const std::string& options,
                             const std::vector<std::string>& files) {
    const Folder one, two;
    run(one, name, options);
    run(two, name, options, "mpirun --quiet -n 2 ");
    for (const std::string& file : files) {
      CAPTURE(name, file);
      const std::string text = contents_of(one.path("out/" + file));
      CHECK(lines_of(text).size() > 30);
      CHECK((text == contents_of(two.path("out/" + file))));
    }
  };
  check_same("droplet", "--set mesh_parameters.h=1.5e-3 end_time=0.5e-3", {"history.csv"});
  check_same("impact", "--set 'mesh_parameters={ n = 60, element = 3 }'", {"history.csv", "axis.csv"});
  // cells with fewer faces than others, which another rank may not have
  check_same("water_air",
             "--set 'mesh=\"../meshes/box_space.geo\"' 'mesh_parameters={ n = 7, element = 0 }' max_steps=40 "
             "output.history_every=1 'region.0.velocity=[-187, 1577, -357]' 'region.1.velocity=[879, 1222, -1439]' "
             "'region.1.point=[0.49, 0.63, 0.68]' 'region.1.normal=[0.757, -0.862, 0.611]' "
             "'boundary={ \"*\" = \"transmissive\" }' 'line=[]'",
             {"history.csv"});
}

TEST_CASE("the .pvd lists every output with its time, and each leads to files with the documented arrays") {
  const Folder folder;
  run(folder, "impact", "--set mesh_parameters.n=40 output.count=4 'output.fields=\"all\"'", "mpirun --quiet -n 2 ");
  const std::string pvd = contents_of(folder.path("out/impact.pvd"));
  std::vector<double> times;
  for (const std::string& time : all_matches(pvd, R"re(timestep="([^"]*)")re")) times.push_back(std::stod(time));
  REQUIRE(times.size() == 5);
  for (int i = 0; i < 5; ++i) CHECK(times[i] == Approx(i * 12.5e-6).epsilon(1e-12));
  CHECK(times.back() == 50e-6);

  const auto files = all_matches(pvd, R"re(file="([^"]*)")re");
  REQUIRE(files.size() == 5);
  for (const std::string& file : files) {
    const std::string text = contents_of(folder.path("out/" + file));
    const auto pieces = all_matches(text, R"re(<Piece Source="([^"]*)")re");
    CHECK(pieces.size() == 2);
    for (const std::string& piece : pieces)
      CHECK(std::filesystem::file_size((folder.path("out/" + file).parent_path() / piece)) > 0);
    for (const std::string phase : {"copper", "aluminium"})
      for (const std::string field : {"alpha", "density", "velocity", "pressure", "stress", "cobasis"})
        CHECK_THAT(text, Contains("Name=\"" + field + "." + phase + "\""));
    for (const std::string field : {"density", "velocity", "pressure", "stress"})
      CHECK_THAT(text, Contains("Name=\"" + field + "\""));
  }
}

TEST_CASE("slices have their own times, and leave the fields theirs") {
  const Folder folder;
  run(folder, "impact",
      "--set mesh_parameters.n=40 output.count=2 output.only=copper "
      "'slice=[{ name = \"along\", point = [0, 0.01], normal = [0, 1], count = 5 }]'",
      "mpirun --quiet -n 2 ");
  const auto times = [&](const std::string& pvd) {
    std::vector<double> all;
    for (const auto& time : all_matches(contents_of(folder.path(pvd)), R"re(timestep="([^"]*)")re"))
      all.push_back(std::stod(time));
    return all;
  };
  const auto fields = times("out/impact.pvd"), slices = times("out/along.pvd");
  REQUIRE(fields.size() == 3);
  REQUIRE(slices.size() == 6);
  for (int i = 0; i < 3; ++i) CHECK(fields[i] == Approx(i * 25e-6).epsilon(1e-12));
  for (int i = 0; i < 6; ++i) CHECK(slices[i] == Approx(i * 10e-6).epsilon(1e-12));
  for (const std::string piece : {"along_0005.pvtu", "along_0005_0.vtu", "along_0005_1.vtu"})
    CHECK(std::filesystem::exists(folder.path("out/slices/" + piece)));
}
