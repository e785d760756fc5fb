// The floors of the house: includes point down only, and every library comes in through one door.
#include <catch2/catch.hpp>
#include <map>
#include <regex>
#include <set>

#include "program.hpp"

using namespace cobasis::test;

namespace {

const std::filesystem::path source = SOURCE_DIR "/src";

/// Which floors a file of a floor may include; main.cpp stands above them.
const std::map<std::string, std::set<std::string>> allowed{
    {"math", {"math"}},
    {"physics", {"physics", "math"}},
    {"mesh", {"mesh", "math"}},
    {"solver", {"solver", "physics", "mesh", "math"}},
    {"app", {"app", "solver", "physics", "mesh", "math"}},
    {".", {"app", "solver", "physics", "mesh", "math"}},
};

/// Calls visit(file, header) for every include, as it is written between quotes or brackets.
template <class Visit>
int for_each_include(const Visit& visit) {
  static const std::regex include(R"re(^\s*#\s*include\s*["<]([^">]+)[">])re");
  int files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(source)) {
    const auto extension = entry.path().extension();
    if (extension != ".cpp" && extension != ".hpp") continue;
    ++files;
    for (const std::string& line : lines_of(contents_of(entry.path()))) {
      std::smatch match;
      if (std::regex_search(line, match, include)) visit(entry.path(), match[1].str());
    }
  }
  return files;
}

}  // namespace

TEST_CASE("no file includes one of a floor above it, and physics and mesh do not see each other") {
  int arrows = 0;
  const int files = for_each_include([&](const std::filesystem::path& file, const std::string& header) {
    const std::string to = std::filesystem::path(header).parent_path().string();
    const bool ours = std::filesystem::exists(source / header);
    const std::string from = std::filesystem::relative(file.parent_path(), source).string();
    CAPTURE(file, header);
    REQUIRE(allowed.contains(from));
    CHECK((ours || !allowed.contains(to)));  // a floor's header that is not there
    CHECK_FALSE(header.starts_with(".."));
    if (!ours) return;
    ++arrows;
    CHECK(allowed.at(from).contains(to));
  });
  CHECK(files > 50);
  CHECK(arrows > 100);
}

TEST_CASE("each library is included by one file only") {
  std::map<std::string, std::set<std::string>> doors;
  for_each_include([&](const std::filesystem::path& file, const std::string& header) {
    for (const std::string library : {"gmsh", "metis", "vtk", "toml++", "CLI/", "muParser", "mpi.h", "hdf5"})
      if (header.starts_with(library)) doors[library].insert(file.filename().string());
  });
  const std::map<std::string, std::set<std::string>> one{
      {"gmsh", {"gmsh_reader.cpp"}}, {"metis", {"partition.cpp"}},     {"vtk", {"vtu_writer.cpp"}},
      {"toml++", {"case_toml.cpp"}}, {"CLI/", {"command_line.cpp"}},   {"muParser", {"expression.cpp"}},
      {"mpi.h", {"mpi.hpp"}},        {"hdf5", {"checkpoint_file.cpp"}}};
  CHECK(doors == one);
}
