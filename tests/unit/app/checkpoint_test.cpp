#include <sys/resource.h>

#include <catch2/catch.hpp>
#include <csignal>

#include "app/checkpoint_file.hpp"
#include "app/checkpoint_identity.hpp"
#include "app/checksum.hpp"
#include "case_file.hpp"
#include "math/errors.hpp"
#include "output_scene.hpp"

using namespace cobasis;
using namespace cobasis::test;
using Catch::Matchers::Contains;

TEST_CASE("the checksum is CRC-64/XZ, in one piece or several") {
  Checksum whole, parts;
  whole.add("123456789");
  for (const char* part : {"", "1234", "56789"}) parts.add(part);
  CHECK(whole.value() == 0x995DC9BBDF1939FA);  // its catalogued value
  CHECK(parts.value() == whole.value());
}

TEST_CASE("a checkpoint file gives back what was written, empty arrays and texts too") {
  const Scratch scratch;
  const std::string path = (scratch.path / "a.h5").string();
  const std::vector<double> numbers{1, -0.0, 1e-320, 0.1, 1e308}, none;
  {
    CheckpointFileWriter file(path);
    file.write("numbers", numbers);
    file.write("rows", std::span(numbers.data(), 4), 2);
    file.write("none", none);
    file.write("text", std::string("a\nb\0c", 5));
    file.write("nothing", std::string());
    CHECK_FALSE(std::filesystem::exists(path));
    file.finish();
  }
  CHECK(what_is_wrong_with_checkpoint(path).empty());
  const CheckpointFileReader file(path);
  const std::vector<double> read = file.read("numbers");
  REQUIRE(read.size() == numbers.size());
  CHECK(std::memcmp(read.data(), numbers.data(), sizeof(double) * numbers.size()) == 0);
  CHECK(file.read("rows").size() == 4);
  CHECK(file.read("none").empty());
  CHECK(file.read_text("text") == std::string("a\nb\0c", 5));
  CHECK(file.read_text("nothing").empty());
  CHECK_THROWS_AS(file.read("other"), SystemError);
}

TEST_CASE("a checkpoint file that is never finished, or cannot be written, leaves nothing and the former one") {
  const Scratch scratch;
  const std::string path = (scratch.path / "a.h5").string();
  {
    CheckpointFileWriter file(path);
    file.write("x", std::vector<double>{1});
    file.finish();
  }
  { CheckpointFileWriter(path).write("x", std::vector<double>{2}); }
  CHECK(CheckpointFileReader(path).read("x") == std::vector<double>{1});
  CHECK(std::distance(std::filesystem::directory_iterator(scratch.path), {}) == 1);
  CHECK_THROWS_WITH(CheckpointFileWriter((scratch.path / "no/a.h5").string()),
                    Contains("no/a.h5': No such file or directory"));
  const auto fill = [&] {
    rlimit former{};
    getrlimit(RLIMIT_FSIZE, &former);
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{1 << 16, former.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    std::string said;
    try {
      CheckpointFileWriter file(path);
      file.write("x", std::vector<double>(1 << 20));
      file.finish();
    } catch (const SystemError& error) {
      said = error.what();
    }
    setrlimit(RLIMIT_FSIZE, &former);
    return said;
  };
  CHECK_THAT(fill(), Contains("cannot write '" + path + "': File too large"));
  CHECK(CheckpointFileReader(path).read("x") == std::vector<double>{1});
  CHECK(std::distance(std::filesystem::directory_iterator(scratch.path), {}) == 1);
}

TEST_CASE("two cases are the same to a checkpoint if they differ in end, title, steps, directory or times of output") {
  Setup setup;
  setup.keys = {{"cfl", "0.8"}, {"end_time", "1"}, {"output.every", "2"}, {"phase.a.density", "3"}, {"title", "\"t\""}};
  const std::string before = identity_of(setup, Geometry::plane);
  setup.keys["end_time"] = "5";
  setup.keys["title"] = "\"u\"";
  setup.keys["max_steps"] = "5";
  setup.keys["cfl"] = "0.4";
  setup.keys["output.directory"] = "\"d\"";
  setup.keys["output.count"] = "7";
  setup.keys["mesh_parameters.n"] = "7";
  setup.keys.erase("output.every");
  CHECK(differences(before, identity_of(setup, Geometry::plane)).empty());
  CHECK(differences(before, identity_of(setup, Geometry::space)) == "scene = space instead of plane");
  setup.keys["phase.a.density"] = "4";
  setup.keys["phase.a.material"] = "\"air\"";
  CHECK(differences(before, identity_of(setup, Geometry::plane)) ==
        "phase.a.density = 4 instead of 3; phase.a.material = \"air\", which was not there");
  setup.keys.erase("phase.a.density");
  setup.keys.erase("phase.a.material");
  CHECK(differences(before, identity_of(setup, Geometry::plane)) == "no phase.a.density, which was 3");
}

TEST_CASE("a case keeps its keys as text: the same for the same numbers, with what --set says") {
  const Setup a = read_text("cfl = 1\ncheckpoint_every = 20\n" + rest), b = read_text("cfl = 1.0\n" + rest);
  CHECK(a.keys.at("cfl") == b.keys.at("cfl"));
  REQUIRE(a.checkpoint_every);
  CHECK(a.checkpoint_every->steps == 20);
  CHECK_FALSE(b.checkpoint_every);
  const Setup minutes = read_text("checkpoint_every = { minutes = 0.5 }\n" + rest);
  REQUIRE(minutes.checkpoint_every);
  CHECK_FALSE(minutes.checkpoint_every->steps);
  CHECK(minutes.checkpoint_every->minutes == 0.5);
}
