// What lies in the output directory, and what a case says of it, may be anybody's.
#include <fmt/format.h>
#include <hdf5.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <limits>

#include "app/atomic_file.hpp"
#include "app/checkpoint_file.hpp"
#include "app/checkpoint_identity.hpp"
#include "app/state_keepers.hpp"
#include "app/written_output.hpp"
#include "case_file.hpp"
#include "math/errors.hpp"
#include "output_scene.hpp"

using namespace cobasis;
using namespace cobasis::test;
using Catch::Matchers::Contains;

namespace {

std::string repeated(const std::string& piece, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += piece;
  return text;
}

/// An HDF5 file made by somebody else, with the array "x" as `make` makes it.
template <class Make>
std::string foreign_file(const std::string& path, const Make& make) {
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  make(file);
  H5Fclose(file);
  return path;
}

void add_array(hid_t file, hsize_t n, hid_t creation, hid_t type = H5T_IEEE_F64LE) {
  const hid_t space = H5Screate_simple(1, &n, nullptr);
  H5Dclose(H5Dcreate2(file, "x", type, space, H5P_DEFAULT, creation, H5P_DEFAULT));
  H5Sclose(space);
}

}  // namespace

TEST_CASE("a key of a hundred thousand parts is refused, as a key, a table, in a table and on the command line") {
  const std::string deep = repeated("a.", 100000) + "a";
  CHECK_THAT(mistakes_in(rest + deep + " = 1\n"), Contains("case.toml:17: a key of more than 21 parts"));
  CHECK_THAT(mistakes_in(rest + "[" + deep + "]\n"), Contains("a key of more than 21 parts"));
  CHECK_THAT(mistakes_in("x = { \"=\".'='." + deep + " = 1 }\n" + rest), Contains("case.toml:1: a key of more than"));
  CHECK_THAT(mistakes_in(rest, {{{deep, "1"}}, ""}), Contains("a key of 100001 parts; allowed: at most 20"));
  CHECK_THAT(mistakes_in(rest, {{{"title", "{" + deep + "=1}"}}, ""}), Contains("more than 21 parts"));
  CHECK_THAT(mistakes_in(rest, {{{"title", "1\n[" + deep + "]"}}, ""}), Contains("more than 21 parts"));
  const std::string in_text = std::string("title = \"\"\"\n") + repeated(".\\\"", 100) + "\"\"\"";
  CHECK(mistakes_in(in_text + "  # " + repeated(".", 100) + "\n" + rest).empty());
  CHECK(mistakes_in(rest, {{{"title", fmt::format("'{}'", repeated(".", 100))}}, ""}).empty());
}

TEST_CASE("a case of thousands of phases, of mistakes, or of megabytes is refused in little time") {
  const auto begin = std::chrono::steady_clock::now();
  std::string many = "[phase]\n", mistakes;
  for (int i = 0; i < 3000; ++i) many += fmt::format("p{} = {{ material = \"air\" }}\n", i);
  for (int i = 0; i < 50000; ++i) mistakes += fmt::format("k{} = 1\n", i);
  CHECK_THAT(mistakes_in("schema = 1\n" + many + "[contact]\na-b = \"sliding\"\n"),
             Contains("case.toml:2: 3000 phases; allowed: at most 31"));
  CHECK_THAT(mistakes_in(mistakes), Contains("k199") && Contains("the first 200 are told") && !Contains("k201"));
  CHECK_THAT(mistakes_in(repeated("# 0123456789\n", 1500000)), Contains("more than 16 MB"));
  CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(20));  // the phases alone took minutes
}

TEST_CASE("more outputs than a run can write are refused, whether asked for by their number or by the time between") {
  const std::string slice = "[[slice]]\nname = \"s\"\npoint = [0, 0]\nnormal = [1, 0]\n";
  CHECK_THAT(mistakes_in(rest + "[output]\ncount = 2000000\n"), Contains("count = 2000000"));
  CHECK_THAT(mistakes_in(rest + "[output]\nevery = 1e-300\n"),
             Contains("case.toml:18: every = 1e-300 with end_time = 0.001; allowed: at most 1e+06 outputs"));
  CHECK_THAT(mistakes_in(rest + slice + "every = 1e-12\n"), Contains("allowed: at most 1e+06 outputs"));
  CHECK_THAT(mistakes_in(with(rest, "1e-3", "1e-323")), Contains("end_time = 1e-323; allowed: at least 1e-100 s"));
  CHECK(mistakes_in(rest + "[output]\nevery = 1e-9\n").empty());
  const auto line = [](int i) {
    return fmt::format("[[line]]\nname = \"l{}\"\nfrom = [0, 0]\nto = [1, 0]\npoints = 6000000\n", i);
  };
  CHECK(mistakes_in(rest + line(1)).empty());
  CHECK_THAT(mistakes_in(rest + line(1) + line(2)), Contains("12000000 points on all lines together"));
  std::string probes;
  for (int i = 0; i < 1500; ++i) probes += fmt::format("[[probe]]\nname = \"p{}\"\nat = [0, 0]\n", i);
  CHECK_THAT(mistakes_in(rest + probes), Contains("1000 tables of this kind"));
}

TEST_CASE("no name in a case leads out of the output directory") {
  for (const std::string kind : {"line", "probe", "slice", "integral"})
    for (const std::string name : {"../x", "/tmp/x", "..", ".", "a/b", ".x", "a b", "$(x)", "a\\u0000b", ""}) {
      INFO(kind + " " + name);
      CHECK_THAT(mistakes_in(rest + "[[" + kind + "]]\nname = \"" + name + "\"\n"), Contains("name = "));
    }
  CHECK_THAT(mistakes_in(with(rest, "phase.copper", "phase.\"../x\"")), Contains("phase name \"../x\""));
}

TEST_CASE("ends of lines in names and texts of a case do not confuse its identity") {
  const std::string group = with(rest, "\"*\" = \"wall\"", "\"*\" = \"wall\"\n\"a\\n\" = \"wall\"");
  const std::string text = with(rest, "1e5", "\"\"\"1e5\n\"\"\"");
  for (const std::string& other : {group, text}) {
    const std::string a = identity_of(read_text(rest), Geometry::plane),
                      b = identity_of(read_text(other), Geometry::plane);
    CHECK(differences(b, b).empty());
    CHECK_FALSE(differences(a, b).empty());
  }
  CHECK(differences("\n", "").find("no ") == 0);  // of a file that somebody else has written
}

TEST_CASE("links in the output directory are not followed") {
  const Scratch scratch;
  const std::string victim = (scratch.path / "victim").string(), file = (scratch.path / "a.csv").string();
  const auto content = [&] {
    std::ifstream stream(victim);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  };
  std::ofstream(victim) << "precious";
  std::filesystem::create_symlink(victim, file + ".part");
  write_atomically(file, "x\n");
  CHECK(content() == "precious");
  std::filesystem::remove(file);
  std::filesystem::create_symlink(victim, file);
  write_atomically(file, "x\n");
  CHECK(content() == "precious");
  CHECK_FALSE(std::filesystem::is_symlink(file));
  std::filesystem::remove(file);
  std::filesystem::create_symlink(victim, file);
  RowFile(file, "header\n").append("row\n");
  CHECK(content() == "precious");

  const std::string checkpoint = (scratch.path / "a.h5").string();
  std::filesystem::create_symlink(victim, checkpoint + ".part");
  CheckpointFileWriter writer(checkpoint);
  writer.write("x", std::vector<double>{1});
  writer.finish();
  CHECK(content() == "precious");

  Checksum sum;
  sum.add("prec");
  std::filesystem::remove(file);
  std::filesystem::create_symlink(victim, file);
  CHECK_THROWS_WITH(RowFile(file, 4, sum.value()), Contains("Too many levels of symbolic links"));
  CHECK(content() == "precious");

  std::filesystem::create_directory(scratch.path / "elsewhere");
  std::filesystem::create_directory_symlink(scratch.path / "elsewhere", scratch.path / "fields");
  CHECK_THROWS_WITH(make_writable_folder((scratch.path / "fields").string(), ".w"), Contains("fields' is a link"));
  CHECK(std::filesystem::is_empty(scratch.path / "elsewhere"));
}

TEST_CASE("arrays of a checkpoint that this program has not written are refused before memory is asked for") {
  const Scratch scratch;
  const std::string path = (scratch.path / "a.h5").string(), secret = (scratch.path / "secret").string();
  std::ofstream(secret) << std::string(80, 's');
  const auto error_of = [&](const auto& make) -> std::string {
    try {
      CheckpointFileReader(foreign_file(path, make)).read("x");
    } catch (const SystemError& error) {
      return error.what();
    }
    return "";
  };
  CHECK(error_of([](hid_t file) { add_array(file, 10, H5P_DEFAULT); }) == "");
  CHECK_THAT(error_of([](hid_t file) { add_array(file, hsize_t{1} << 50, H5P_DEFAULT); }),
             Contains("cannot read 'x' in '" + path + "'") && Contains("more than a file of"));
  CHECK_THAT(error_of([](hid_t file) { add_array(file, 10, H5P_DEFAULT, H5T_STD_I16BE); }),
             Contains("not as this program writes it"));
  CHECK_THAT(error_of([&](hid_t file) {
               const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
               H5Pset_external(creation, secret.c_str(), 0, 80);
               add_array(file, 10, creation);
             }),
             Contains("not as this program writes it"));
  CHECK_THAT(error_of([](hid_t file) {
               const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
               const hsize_t chunk = 1000;
               H5Pset_chunk(creation, 1, &chunk);
               H5Pset_deflate(creation, 9);
               add_array(file, hsize_t{1} << 40, creation);
             }),
             Contains("not as this program writes it"));
  foreign_file((scratch.path / "b.h5").string(), [](hid_t file) { add_array(file, 10, H5P_DEFAULT); });
  CHECK_THAT(error_of([](hid_t file) { H5Lcreate_external("b.h5", "/x", file, "x", H5P_DEFAULT, H5P_DEFAULT); }),
             Contains("no array of this file"));
}

TEST_CASE("rows of cells in a checkpoint are rows, of cells of the mesh, with values that may be") {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const auto right = [](std::vector<double> numbers) { return are_rows(numbers, 2, 10, -1, 1); };
  CHECK(right({}));
  CHECK(right({0, -1, 9, 1}));
  CHECK_FALSE(right({0, 0, 9}));
  CHECK_FALSE(right({10, 0}));
  CHECK_FALSE(right({-1, 0}));
  CHECK_FALSE(right({0.5, 0}));
  CHECK_FALSE(right({nan, 0}));
  CHECK_FALSE(right({0, 2}));
  CHECK_FALSE(right({0, nan}));
  CHECK(are_rows(std::vector<double>{3, nan, 1e300}, 3, 10, -infinity, infinity));
}

TEST_CASE("the list of output in a checkpoint names files of this case in their folders, and nothing else") {
  const OutputCounts counts{1, 1, 1};
  const std::vector<WrittenOutput> all{{.kind = "fields", .time = 0.1, .file = "fields/a_0000.pvtu"},
                                       {.kind = "slice", .time = 1e-300, .file = "slices/s_0001.pvtu"},
                                       {.kind = "line", .time = 3, .file = "lines/my line_0001.csv"},
                                       {.kind = "history", .size = 12, .checksum = 345},
                                       {.kind = "probe", .size = 0, .checksum = ~std::uint64_t{0}}};
  const std::vector<WrittenOutput> back = written_output(text_of(all), counts);
  REQUIRE(back.size() == all.size());
  CHECK(text_of(back) == text_of(all));
  CHECK(back[2].file == all[2].file);
  for (const std::string wrong :
       {"slice 1 0 slices/a", "slice 99999999999 0 slices/a", "fields 1 0 fields/a", "fields 0 0 fields/../a",
        "fields 0 0 /etc/passwd", "fields 0 0 fields/..", "fields 0 0 fields/", "fields 0 nan fields/a", "other 0 0 a",
        "history 0 -1 0", "history 0 1e9 0", "history 0 1", "probe 1 0 0", "fields -1 0 fields/a", "", "fields"}) {
    INFO(wrong);
    CHECK_THROWS_WITH(written_output(wrong + "\n", counts),
                      Contains("is not that of this case: found '" + wrong + "'"));
  }
  const Scratch scratch;  // a table of which more is said to be there than there is
  std::ofstream(scratch.path / "history.csv") << "a\n";
  CHECK_THROWS_WITH(RowFile((scratch.path / "history.csv").string(), std::int64_t{1} << 60, 0),
                    Contains("was cut off"));
}
