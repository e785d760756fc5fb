#include "app/new_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "app/atomic_file.hpp"
#include "math/errors.hpp"
#include "math/suggestion.hpp"

namespace cobasis {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view first_template = "start";

std::string_view text_of(std::span<const ProjectFile> files, const std::string& name) {
  const auto found = std::ranges::find(files, name, &ProjectFile::name);
  if (found == files.end()) throw SystemError(fmt::format("cobasis new: {} is not part of this program", name));
  return found->text;
}

/// Such names need no quotation, in a case and in a shell.
void check_name(const std::string& name) {
  const auto safe = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
           c == '.';
  };
  if (name.empty() || name.front() == '.' || name.front() == '-' || !std::ranges::all_of(name, safe))
    throw InputError(
        fmt::format("cobasis new: the name \"{}\"; allowed: letters, digits, _ - . that do not begin with "
                    ". or -, after a directory if need be",
                    name));
}

}  // namespace

const std::vector<std::string>& case_templates() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all{std::string(first_template)};
    for (const ProjectFile& file : project_cases())
      if (const std::string stem = fs::path(file.name).stem(); stem != first_template) all.push_back(stem);
    return all;
  }();
  return names;
}

std::string write_new_case(const std::string& name, const std::string& like) {
  const auto& known = case_templates();
  if (std::ranges::find(known, like) == known.end())
    throw InputError(fmt::format("cobasis new: --like {}; {}", like, allowed_names(like, known)));
  fs::path base(name);
  if (base.extension() == ".toml") base.replace_extension();
  const std::string stem = base.filename();
  check_name(stem);
  std::error_code none;
  if (const fs::path directory = base.parent_path(); !directory.empty() && !fs::is_directory(directory, none))
    throw InputError(
        fmt::format("cobasis new: there is no directory {}; allowed: an existing one", directory.string()));
  const std::string case_file = base.string() + ".toml", mesh_file = base.string() + ".geo";
  for (const std::string& file : {case_file, mesh_file})
    if (fs::exists(fs::symlink_status(file, none)))
      throw InputError(fmt::format("cobasis new: {} exists and stays as it is; allowed: another name", file));

  // The case's line `mesh = "../meshes/box.geo"` names its mesh, which from now on lies beside it.
  std::string text(text_of(project_cases(), like + ".toml"));
  constexpr std::string_view folder = "../meshes/";
  const auto at = text.find(folder);
  const auto end = text.find('"', at);
  if (at == std::string::npos || end == std::string::npos)
    throw SystemError(fmt::format("cobasis new: {}.toml names no mesh in {}", like, folder));
  const std::string mesh = text.substr(at + folder.size(), end - at - folder.size());
  text.replace(at, end - at, stem + ".geo");
  write_atomically(mesh_file, text_of(project_meshes(), mesh));
  write_atomically(case_file, text);
  return fmt::format("{0} and its mesh {1}\n  cobasis check {0}\n  cobasis run {0}\n  cobasis help case\n", case_file,
                     mesh_file);
}

}  // namespace cobasis
