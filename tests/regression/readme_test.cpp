// The commands that the documents show do what they say: every ```sh block is run in a folder that looks like a built
// clone. tools/run and tools/test would build and test once more: in their place stand scripts that check what they are
// given.
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cctype>
#include <set>
#include <sstream>

#include "program.hpp"

using namespace cobasis::test;
using Catch::Matchers::Contains;

namespace {

namespace fs = std::filesystem;

/// The texts between ```KIND and ``` of a document.
std::vector<std::string> blocks(const std::string& document, const std::string& kind) {
  std::vector<std::string> found;
  bool inside = false;
  for (const std::string& line : lines_of(contents_of(SOURCE_DIR "/" + document))) {
    if (line.starts_with("```")) {
      inside = !inside && line == "```" + kind;
      if (inside) found.emplace_back();
    } else if (inside) {
      found.back() += line + "\n";
    }
  }
  return found;
}

/// Takes the arguments of tools/run, whose case it only checks.
const std::string stand_in_for_run = R"(#!/usr/bin/env bash
set -euo pipefail
if [ "${1:-}" = --help ]; then exec bash "$SOURCE/tools/run" --help; fi
case_file=$SOURCE/cases/droplet.toml
if [ $# -gt 0 ] && [[ $1 != -* ]]; then
  case_file=$1
  [ -f "$case_file" ] || case_file=$SOURCE/cases/$1.toml
  shift
fi
exec build/release/cobasis check "$case_file" "$@"
)";

/// A folder with the project's directories, the program where the build puts it, and stand-ins for the tools.
void furnish(const Folder& folder) {
  for (const char* name : {"cases", "meshes", "src", "tests"})
    fs::create_directory_symlink(fs::path(SOURCE_DIR) / name, folder.path(name));
  fs::create_directories(folder.path("build/release/tests"));
  fs::create_symlink(COBASIS_PROGRAM, folder.path("build/release/cobasis"));
  fs::create_directory(folder.path("tools"));
  folder.write("tools/run", with(stand_in_for_run, "set -euo pipefail", "set -euo pipefail\nSOURCE=" SOURCE_DIR));
  folder.write("tools/test", "#!/bin/sh\nexec bash -n " SOURCE_DIR "/tools/test\n");
  folder.write("tools/figures", "#!/bin/sh\nexec bash -n " SOURCE_DIR "/tools/figures\n");
  for (const char* name : {"tools/run", "tools/test", "tools/figures"})
    fs::permissions(folder.path(name), fs::perms::owner_exec, fs::perm_options::add);
}

void check_commands(const std::string& document) {
  const Folder folder;
  furnish(folder);
  for (const std::string& text : blocks(document, "toml"))
    if (text.starts_with("# ")) folder.write(text.substr(2, text.find_first_of(" :\n", 2) - 2), text);
  const auto commands = blocks(document, "sh");
  CHECK(!commands.empty());
  for (const std::string& text : commands) {
    const Outcome outcome = shell(text, folder);
    INFO(document << ":\n" << text << outcome.out << outcome.err);
    CHECK(outcome.status == 0);
  }
}

}  // namespace

TEST_CASE("the commands of README.md work", "[long]") { check_commands("README.md"); }
TEST_CASE("the commands of cases/README.md work", "[long]") { check_commands("cases/README.md"); }

TEST_CASE("the two commands for people are there, can be executed and explain themselves") {
  const Folder folder;
  for (const std::string tool : {"tools/run", "tools/test"}) {
    CAPTURE(tool);
    const fs::path file = fs::path(SOURCE_DIR) / tool;
    CHECK(::access(file.c_str(), X_OK) == 0);
    CHECK_THAT(contents_of(SOURCE_DIR "/README.md"), Contains(tool));
    CHECK(shell("bash -n " + quoted(file.string()), folder).status == 0);
  }
  const Outcome help = shell(quoted(SOURCE_DIR "/tools/run") + " --help", folder);
  CHECK(help.status == 0);
  CHECK_THAT(help.out, Contains("tools/run [CASE]"));
  CHECK(folder.contents().empty());
}

/// As links name them: small letters, a hyphen for a space.
bool has_heading(const std::string& text, const std::string& name) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("#")) continue;
    std::string slug;
    for (const char c : line.substr(std::min(line.size(), line.find(' ') + 1)))
      if (std::isalnum(static_cast<unsigned char>(c)) || c == ' ' || c == '-')
        slug += c == ' ' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (slug == name) return true;
  }
  return false;
}

TEST_CASE("the files and headings that the documents link to exist") {
  for (const std::string document : {"README.md", "src/README.md", "cases/README.md", "CHANGELOG.md"}) {
    const std::string text = contents_of(SOURCE_DIR "/" + document);
    const fs::path here = fs::path(SOURCE_DIR "/" + document).parent_path();
    for (auto at = text.find("]("); at != std::string::npos; at = text.find("](", at + 1)) {
      const std::string target = text.substr(at + 2, text.find(')', at) - at - 2);
      CAPTURE(document, target);
      if (target.starts_with("#"))
        CHECK(has_heading(text, target.substr(1)));
      else if (!target.starts_with("http"))
        CHECK(fs::exists(here / target));
    }
  }
}

TEST_CASE("the map in src/README.md names every header, and no file that is not there") {
  const std::string map = contents_of(SOURCE_DIR "/src/README.md");
  std::set<std::string> named;
  for (auto at = map.find('`'); at != std::string::npos;) {
    const auto end = map.find('`', at + 1);
    if (end == std::string::npos) break;
    const std::string name = map.substr(at + 1, end - at - 1);
    if (name.find('/') != std::string::npos && (name.ends_with(".hpp") || name.ends_with(".cpp"))) named.insert(name);
    at = map.find('`', end + 1);
  }
  for (const std::string& name : named) {
    CAPTURE(name);
    CHECK(fs::exists(fs::path(SOURCE_DIR) / (name.starts_with("tests/") ? name : "src/" + name)));
  }
  int headers = 0;
  for (const auto& entry : fs::recursive_directory_iterator(SOURCE_DIR "/src")) {
    if (entry.path().extension() != ".hpp") continue;
    ++headers;
    const std::string name = fs::relative(entry.path(), SOURCE_DIR "/src").string();
    CAPTURE(name);
    CHECK(named.contains(name));
  }
  CHECK(headers > 40);
}
