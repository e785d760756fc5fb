#include "mesh/msh_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "math/errors.hpp"

namespace cobasis {
namespace {

using std::string_view;

/// What follows the line `$name`, or nothing.
string_view after_section_start(string_view text, const std::string& name) {
  for (std::size_t at = 0; (at = text.find(name, at)) != string_view::npos; at += name.size()) {
    const std::size_t end = at + name.size();
    if (at > 0 && text[at - 1] != '\n') continue;
    if (end < text.size() && text[end] == '\r') return text.substr(std::min(end + 2, text.size()));
    if (end < text.size() && text[end] == '\n') return text.substr(end + 1);
  }
  return {};
}

std::string_view last_line(string_view text) {
  const std::size_t end = text.find_last_not_of(" \t\r\n");
  if (end == string_view::npos) return {};
  text = text.substr(0, end + 1);
  return text.substr(text.find_last_of('\n') + 1);
}

/// The counts at the start of $Nodes and $Elements: one number in 2.x; blocks, entries, lowest and highest tag in 4.1.
void check_count(const std::string& file, string_view text, const char* section, bool version4, bool binary,
                 std::size_t bytes_each) {
  const string_view body = after_section_start(text, std::string("$") + section);
  std::uint64_t count[2] = {0, 0};
  bool known = false;
  if (version4 && binary) {
    known = body.size() >= sizeof count;
    if (known) std::memcpy(count, body.data(), sizeof count);
  } else {
    const std::string head(body.substr(0, std::min(body.find('\n'), std::size_t{200})));
    char* rest = nullptr;
    for (int i = 0; i < (version4 ? 2 : 1); ++i) {
      const char* const start = i == 0 ? head.c_str() : rest;
      count[i] = std::strtoull(start, &rest, 10);
      known = rest != start;
    }
  }
  if (!known) throw InputError(fmt::format("{}: no counts at the start of ${}", file, section));
  for (const std::uint64_t n : count)
    if (n > body.size() / bytes_each)
      throw InputError(fmt::format("{}: ${} announces {} entries, more than a file of {} bytes can hold", file, section,
                                   static_cast<std::int64_t>(n), text.size()));
}

}  // namespace

std::string read_whole_file(const std::string& file) {
  namespace fs = std::filesystem;
  std::error_code code;
  const fs::file_status status = fs::status(file, code);
  if (!fs::exists(status)) throw InputError(fmt::format("{}: no such mesh file", file));
  if (fs::is_directory(status)) throw InputError(fmt::format("{}: is a directory, not a mesh file", file));
  if (!fs::is_regular_file(status)) throw InputError(fmt::format("{}: is not a regular file", file));
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InputError(fmt::format("{}: cannot be opened ({})", file, std::strerror(errno)));
  std::string text(fs::file_size(file, code), '\0');
  if (code || !in.read(text.data(), static_cast<std::streamsize>(text.size())))
    throw InputError(fmt::format("{}: cannot be read", file));
  if (text.empty()) throw InputError(fmt::format("{}: the file is empty", file));
  return text;
}

std::size_t check_msh(const std::string& file) {
  const std::string text = read_whole_file(file);
  if (!text.starts_with("$MeshFormat\n") && !text.starts_with("$MeshFormat\r\n"))
    throw InputError(fmt::format("{}: not a Gmsh mesh: it must start with the line $MeshFormat", file));
  const string_view header = after_section_start(text, "$MeshFormat");
  const std::string line(header.substr(0, std::min(header.find('\n'), std::size_t{200})));
  double version = 0;
  int binary = -1, size = 0;
  if (std::sscanf(line.c_str(), "%lf %d %d", &version, &binary, &size) != 3 || binary < 0 || binary > 1)
    throw InputError(fmt::format("{}:2: found '{}', expected version, 0 (ASCII) or 1 (binary), size", file, line));
  const bool version4 = version > 4.05 && version < 4.15;
  if (!version4 && !(version >= 2 && version < 3))
    throw InputError(
        fmt::format("{}:2: mesh format {}; read are 2.2 and 4.1 (in Gmsh: Mesh.MshFileVersion = 4.1)", file, version));
  if (version4 && size != 8) throw InputError(fmt::format("{}:2: data size {}, expected 8", file, size));

  for (const char* section : {"Nodes", "Elements"}) {
    if (after_section_start(text, std::string("$") + section).empty())
      throw InputError(fmt::format("{}: no section ${}: empty or cut short", file, section));
    if (text.find(std::string("$End") + section) == std::string::npos)
      throw InputError(fmt::format("{}: section ${} has no end: the file is cut short", file, section));
  }
  if (const string_view last = last_line(text); last.find("$End") == string_view::npos)
    throw InputError(fmt::format("{}: the last section has no end: the file is cut short", file));
  check_count(file, text, "Nodes", version4, binary == 1, binary == 1 ? 24 : 6);
  check_count(file, text, "Elements", version4, binary == 1, 6);
  return text.size();
}

}  // namespace cobasis
