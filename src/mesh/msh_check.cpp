#include "mesh/msh_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <utility>
#include <vector>

#include "math/errors.hpp"

namespace cobasis {
namespace {

using std::string_view;

/// The start of what a file holds, for a message.
std::string printable(string_view text) {
  std::string start;
  for (const char c : text.substr(0, 60)) start += std::isprint(static_cast<unsigned char>(c)) ? c : '?';
  return start;
}

/// Sections of a .msh that say what the mesh is, and those that Gmsh may write beside them, of which nothing is needed.
constexpr std::array<string_view, 6> needed{"MeshFormat",          "PhysicalNames", "Entities",
                                            "PartitionedEntities", "Nodes",         "Elements"};
constexpr std::array<string_view, 10> skipped{"Periodic",        "GhostElements",      "Parametrizations", "Comments",
                                              "NodeData",        "ElementData",        "ElementNodeData",  "NodeSets",
                                              "Parametrization", "InterpolationScheme"};

struct Section {
  string_view name, whole, body;  ///< whole: with its first and last line; body: between them
};

/// The line that begins at `at`, without its end, and the place of the next one.
std::pair<string_view, std::size_t> line_at(string_view text, std::size_t at) {
  const std::size_t end = std::min(text.find('\n', at), text.size());
  string_view line = text.substr(at, end - at);
  while (!line.empty() && std::isspace(static_cast<unsigned char>(line.back()))) line.remove_suffix(1);
  return {line, std::min(end + 1, text.size())};
}

/// Where the line `$EndName` begins.
std::size_t end_of_section(string_view text, std::size_t from, const std::string& mark) {
  for (std::size_t at = from; (at = text.find(mark, at)) != string_view::npos; at += mark.size())
    if (text[at - 1] == '\n' && line_at(text, at).first == mark) return at;
  return string_view::npos;
}

std::vector<Section> sections_of(const std::string& file, string_view text) {
  std::vector<Section> sections;
  for (std::size_t at = 0; at < text.size();) {
    const auto [line, next] = line_at(text, at);
    if (!line.empty()) {
      const string_view name = line.substr(std::min<std::size_t>(line.size(), 1));
      const auto is = [&](string_view other) { return name == other; };
      if (line[0] != '$' || (std::ranges::none_of(needed, is) && std::ranges::none_of(skipped, is)))
        throw InputError(fmt::format("{}: found the line '{}' where a section begins; allowed: ${}", file,
                                     printable(line), fmt::join(needed, ", $")));
      const std::size_t end = end_of_section(text, next, fmt::format("$End{}", name));
      if (end == string_view::npos)
        throw InputError(fmt::format("{}: section ${} has no end: the file is cut short", file, name));
      if (std::ranges::find(sections, name, &Section::name) != sections.end() && std::ranges::any_of(needed, is))
        throw InputError(fmt::format("{}: section ${} is there twice; allowed: once", file, name));
      const std::size_t after = line_at(text, end).second;
      sections.push_back({name, text.substr(at, after - at), text.substr(next, end - next)});
      at = after;
    } else {
      at = next;
    }
  }
  return sections;
}

/// The counts at the start of $Nodes and $Elements: one number in 2.x; blocks, entries, lowest and highest tag in 4.1.
void check_count(const std::string& file, const std::vector<Section>& sections, string_view name, bool version4,
                 bool binary, std::size_t bytes_each) {
  const auto section = std::ranges::find(sections, name, &Section::name);
  if (section == sections.end()) throw InputError(fmt::format("{}: no section ${}: empty or cut short", file, name));
  const string_view body = section->body;
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
  if (!known) throw InputError(fmt::format("{}: no counts at the start of ${}", file, name));
  for (const std::uint64_t n : count)
    if (n > body.size() / bytes_each)
      throw InputError(fmt::format("{}: ${} announces {} entries, more than a file of {} bytes can hold", file, name,
                                   static_cast<std::int64_t>(n), body.size()));
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

std::string check_msh(const std::string& file, const std::string& text) {
  if (!text.starts_with("$MeshFormat\n") && !text.starts_with("$MeshFormat\r\n"))
    throw InputError(fmt::format("{}: not a Gmsh mesh: it must start with the line $MeshFormat", file));
  const std::string line(line_at(text, text.find('\n') + 1).first.substr(0, 200));
  double version = 0;
  int binary = -1, size = 0;
  if (std::sscanf(line.c_str(), "%lf %d %d", &version, &binary, &size) != 3 || binary < 0 || binary > 1)
    throw InputError(
        fmt::format("{}:2: found '{}', expected version, 0 (ASCII) or 1 (binary), size", file, printable(line)));
  const bool version4 = version > 4.05 && version < 4.15;
  if (!version4 && !(version >= 2 && version < 3))
    throw InputError(
        fmt::format("{}:2: mesh format {}; read are 2.2 and 4.1 (in Gmsh: Mesh.MshFileVersion = 4.1)", file, version));
  if (version4 && size != 8) throw InputError(fmt::format("{}:2: data size {}, expected 8", file, size));

  const std::vector<Section> sections = sections_of(file, text);
  check_count(file, sections, "Nodes", version4, binary == 1, binary == 1 ? 24 : 6);
  check_count(file, sections, "Elements", version4, binary == 1, 6);
  std::string mesh;
  for (const Section& section : sections)
    if (std::ranges::find(needed, section.name) != needed.end()) mesh += section.whole;
  return mesh;
}

}  // namespace cobasis
