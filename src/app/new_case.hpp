// `cobasis new`: a case to start from, and its mesh beside it.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cobasis {

/// A file of the project, as it was when the program was built.
struct ProjectFile {
  std::string_view name;  ///< in its directory: impact.toml
  std::string_view text;
};
std::span<const ProjectFile> project_cases();
std::span<const ProjectFile> project_meshes();

/// Names of what a new case can be like, the default first.
const std::vector<std::string>& case_templates();

/// Writes NAME.toml and the mesh it uses, NAME.geo; a directory before the name must exist, .toml behind it may be
/// there. Returns what the user can do next. Throws InputError if one of the files exists or the name is no file name,
/// and then writes nothing; SystemError.
std::string write_new_case(const std::string& name, const std::string& like);

}  // namespace cobasis
