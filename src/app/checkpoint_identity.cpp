#include "app/checkpoint_identity.hpp"

#include <fmt/format.h>

#include <array>
#include <map>
#include <sstream>

#include "app/checksum.hpp"

namespace cobasis {
namespace {

template <class T>
void add(Checksum& checksum, const T& value) {
  checksum.add({reinterpret_cast<const char*>(&value), sizeof value});
}

/// Keys and tables whose change leaves the run what it is.
constexpr std::array may_change{"title",        "mesh",         "mesh_parameters",     "end_time",
                                "max_steps",    "cfl",          "checkpoint_every",    "output.directory",
                                "output.every", "output.count", "output.history_every"};

bool counts(const std::string& key) {
  for (const std::string name : may_change)
    if (key == name || key.starts_with(name + ".")) return false;
  return true;
}

/// Groups of a mesh and texts of a case may hold ends of lines.
std::string one_line(std::string text) {
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; ++at) text.replace(at, 1, "\\n");
  return text;
}

std::map<std::string, std::string> lines_of(const std::string& text) {
  std::map<std::string, std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    const auto at = line.find(" = ");
    lines[line.substr(0, at)] = at == std::string::npos ? "" : line.substr(at + 3);
  }
  return lines;
}

}  // namespace

std::string identity_of(const Mesh& mesh, const Mpi& mpi) {
  std::vector<std::int64_t> group(mesh.n_boundary_faces);
  for (std::size_t g = 0; g < mesh.boundary_groups.size(); ++g)
    for (std::int32_t f = mesh.boundary_groups[g].first; f < mesh.boundary_groups[g].last; ++f)
      group[f - mesh.first_boundary_face()] = -1 - static_cast<std::int64_t>(g);
  std::uint64_t sum = 0;
  for (std::int32_t cell = 0; cell < mesh.n_owned; ++cell) {
    Checksum of_cell;
    add(of_cell, mesh.global_id[cell]);
    add(of_cell, mesh.volume[cell]);
    add(of_cell, mesh.centroid[cell]);
    add(of_cell, mesh.cell_type[cell]);
    for (int j = 0; j < mesh.max_cell_faces; ++j) {
      const std::int32_t entry = mesh.cell_faces[static_cast<std::size_t>(j) * mesh.cell_stride + cell];
      if (entry < 0) continue;
      const std::int32_t face = entry / 2, other = entry % 2 == 0 ? mesh.right[face] : mesh.left[face];
      const bool open = face < mesh.first_boundary_face();
      add(of_cell, open ? mesh.global_id[other] : group[face - mesh.first_boundary_face()]);
      for (const double number : {mesh.area[face], mesh.nx[face], mesh.ny[face], mesh.nz[face]}) add(of_cell, number);
    }
    sum += of_cell.value();
  }
  Checksum names;
  for (const BoundaryGroup& g : mesh.boundary_groups) names.add(g.name + "\n");
  const auto all = static_cast<std::uint64_t>(mpi.sum(static_cast<std::int64_t>(sum))) + names.value();
  return fmt::format("{} cells, checksum {:016x}", mesh.n_global, all);
}

std::string identity_of(const Setup& setup, Geometry geometry) {
  std::string text = fmt::format("scene = {}\n", name_of(geometry));
  for (const auto& [key, value] : setup.keys)
    if (counts(key) && key != "scene") text += one_line(fmt::format("{} = {}", key, value)) + "\n";
  return text;
}

std::string differences(const std::string& before, const std::string& now) {
  constexpr int most = 8;
  const auto old_lines = lines_of(before), new_lines = lines_of(now);
  std::string text;
  int count = 0;
  const auto tell = [&](const std::string& what) {
    if (++count <= most) text += (text.empty() ? "" : "; ") + what;
  };
  for (const auto& [key, value] : new_lines) {
    const auto found = old_lines.find(key);
    if (found == old_lines.end())
      tell(fmt::format("{} = {}, which was not there", key, value));
    else if (found->second != value)
      tell(fmt::format("{} = {} instead of {}", key, value, found->second));
  }
  for (const auto& [key, value] : old_lines)
    if (!new_lines.contains(key)) tell(fmt::format("no {}, which was {}", key, value));
  if (count > most) text += fmt::format("; and {} more", count - most);
  return text;
}

}  // namespace cobasis
