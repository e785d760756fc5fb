// A case file in a directory of its own, next to a mesh, for the time of a test.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "app/case.hpp"
#include "math/errors.hpp"

namespace cobasis {

class CaseFile {
 public:
  explicit CaseFile(const std::string& text) {
    static int number = 0;
    directory_ = std::filesystem::temp_directory_path() /
                 ("cobasis_case_test_" + std::to_string(getpid()) + "_" + std::to_string(number++));
    std::filesystem::create_directories(directory_ / "cases");
    std::filesystem::create_directories(directory_ / "meshes");
    std::ofstream(directory_ / "meshes" / "tube.geo") << "// a mesh\n";
    std::ofstream(directory_ / "meshes" / "tube.msh") << "$MeshFormat\n";
    std::ofstream(path()) << text;
  }
  ~CaseFile() { std::filesystem::remove_all(directory_); }
  CaseFile(const CaseFile&) = delete;
  CaseFile& operator=(const CaseFile&) = delete;

  std::filesystem::path directory() const { return directory_; }
  std::string path() const { return (directory_ / "cases" / "case.toml").string(); }

 private:
  std::filesystem::path directory_;
};

inline Setup read_text(const std::string& text, const CaseOverrides& overrides = {}) {
  const CaseFile file(text);
  return read_case(file.path(), overrides);
}

/// What read_case says is wrong, with the file's path cut down to case.toml; empty if nothing is.
inline std::string mistakes_in(const std::string& text, const CaseOverrides& overrides = {}) {
  const CaseFile file(text);
  try {
    read_case(file.path(), overrides);
  } catch (const InputError& error) {
    std::string said = error.what();
    const std::string directory = (file.directory() / "cases").string() + "/";
    for (std::size_t at = 0; (at = said.find(directory)) != std::string::npos;) said.erase(at, directory.size());
    return said;
  }
  return {};
}

/// Air at rest in a tube; pieces of it are exchanged by the tests. Lines are counted by them.
inline const std::string rest = R"(schema = 1
mesh = "../meshes/tube.geo"
end_time = 1e-3

[phase.air]
material = "air"
[phase.copper]
material = "copper"

[[region]]
shape = "everywhere"
fill = "air"
pressure = 1e5

[boundary]
"*" = "wall"
)";

/// The text with `found`, which must be there, replaced.
inline std::string with(std::string text, const std::string& found, const std::string& replacement) {
  const std::size_t at = text.find(found);
  if (at == std::string::npos) throw std::logic_error("the case has no " + found);
  return text.replace(at, found.size(), replacement);
}

}  // namespace cobasis
