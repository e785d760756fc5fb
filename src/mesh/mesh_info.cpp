#include "mesh/mesh_info.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "mesh/cell_shape.hpp"
#include "mesh/geometry.hpp"
#include "mesh/global_mesh.hpp"
#include "mesh/partition.hpp"
#include "mesh/topology.hpp"

namespace cobasis {
namespace {

void measure_cells(const GlobalMesh& mesh, MeshInfo& info) {
  for (const std::string& name : mesh.raw.region_names) info.regions.push_back({name});
  info.smallest_volume = std::numeric_limits<double>::infinity();
  for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell) {
    const double volume = mesh.volume[cell];
    ++info.cells_by_type[static_cast<std::size_t>(mesh.raw.cell_type[cell])];
    info.volume += volume;
    info.smallest_volume = std::min(info.smallest_volume, volume);
    info.largest_volume = std::max(info.largest_volume, volume);
    if (const std::int32_t region = mesh.raw.cell_region[cell]; region >= 0) {
      ++info.regions[region].count;
      info.regions[region].measure += volume;
    }
  }
}

void measure_quality(const GlobalMesh& mesh, MeshInfo& info) {
  for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell) {
    double surface = 0, longest = 0;
    for (int local = 0; local < shape_of(mesh.raw.cell_type[cell]).n_faces; ++local) {
      std::array<std::int32_t, 4> nodes{};
      std::array<Point, 4> corners;
      const int n = face_nodes(mesh.raw, cell, local, nodes.data());
      for (int i = 0; i < n; ++i) corners[i] = mesh.raw.nodes[nodes[i]];
      for (int i = 0; i < n; ++i) longest = std::max(longest, length(corners[(i + 1) % n] - corners[i]));
      const Point area = face_geometry({corners.data(), static_cast<std::size_t>(n)}).area;
      const double size = length(area);
      surface += size;
      if (n < 4) continue;
      const Point middle = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
      for (const Point& corner : corners)
        info.worst_warp = std::max(info.worst_warp, std::abs(dot(corner - middle, area)) / (size * std::sqrt(size)));
    }
    const double aspect = surface * longest / (2 * mesh.raw.dimension * mesh.volume[cell]);
    info.worst_aspect = std::max(info.worst_aspect, aspect);
  }
}

void count_boundaries(const GlobalMesh& mesh, MeshInfo& info) {
  for (const std::string& name : mesh.boundary_names) info.boundaries.push_back({name});
  for (std::size_t f = static_cast<std::size_t>(mesh.n_inner_faces); f < mesh.faces.size(); ++f) {
    MeshInfo::Group& group = info.boundaries[mesh.faces[f].group];
    ++group.count;
    group.measure += length(mesh.face_area[f]);
  }
}

MeshInfo::Parts preview(const GlobalMesh& mesh, int n_parts, const MeshRequest& request) {
  const std::vector<int> owner = partition(mesh, n_parts, request);
  std::vector<std::int64_t> cells(n_parts, 0);
  for (const int part : owner) ++cells[part];
  MeshInfo::Parts parts{n_parts, *std::min_element(cells.begin(), cells.end()),
                        *std::max_element(cells.begin(), cells.end())};
  for (const FaceLink& face : mesh.faces)
    if (face.right >= 0 && owner[face.left] != owner[face.right]) ++parts.cut_faces;
  return parts;
}

}  // namespace

MeshInfo mesh_info(const MeshRequest& request) {
  const GlobalMesh mesh = read_global_mesh(request);
  MeshInfo info;
  info.file = request.file;
  info.dimension = mesh.raw.dimension;
  info.cells = mesh.n_cells();
  info.faces = std::ssize(mesh.faces);
  info.nodes = std::ssize(mesh.raw.nodes);
  info.notices = mesh.raw.notices;
  info.low = info.high = mesh.raw.nodes.front();
  for (const Point& p : mesh.raw.nodes) {
    info.low = {std::min(info.low.x, p.x), std::min(info.low.y, p.y), std::min(info.low.z, p.z)};
    info.high = {std::max(info.high.x, p.x), std::max(info.high.y, p.y), std::max(info.high.z, p.z)};
  }
  measure_cells(mesh, info);
  measure_quality(mesh, info);
  count_boundaries(mesh, info);
  for (const int n_parts : {2, 4, 8}) info.parts.push_back(preview(mesh, n_parts, request));
  return info;
}

std::string format(const MeshInfo& info) {
  const bool plane = info.dimension == 2;
  const char* const volume_unit = plane ? "m^2" : "m^3";
  std::string text = fmt::format("{}: {}, {} cells, {} faces, {} nodes\n", info.file, plane ? "plane" : "space",
                                 info.cells, info.faces, info.nodes);
  for (std::size_t type = 0; type < info.cells_by_type.size(); ++type)
    if (info.cells_by_type[type] > 0)
      text += fmt::format("  {:<14} {:>12}\n", cell_shapes[type].name, info.cells_by_type[type]);
  text += fmt::format("box        ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g}) m\n", info.low.x, info.low.y,
                      info.low.z, info.high.x, info.high.y, info.high.z);
  text += fmt::format("{}     {:.6g} {}, of a cell {:.3g} to {:.3g}\n", plane ? "area  " : "volume", info.volume,
                      volume_unit, info.smallest_volume, info.largest_volume);
  text += fmt::format("quality    worst aspect {:.3g} (square, cube 1; tetrahedron 2.45)", info.worst_aspect);
  text += plane ? "\n" : fmt::format(", worst warp of a face {:.2g}\n", info.worst_warp);
  for (const MeshInfo::Group& group : info.regions)
    text +=
        fmt::format("region     {:<20} {:>10} cells  {:.6g} {}\n", group.name, group.count, group.measure, volume_unit);
  for (const MeshInfo::Group& group : info.boundaries)
    text += fmt::format("boundary   {:<20} {:>10} faces  {:.6g} {}\n", group.name, group.count, group.measure,
                        plane ? "m" : "m^2");
  for (const MeshInfo::Parts& parts : info.parts)
    text += fmt::format("{} ranks    {} to {} cells each, {} faces between ranks\n", parts.n, parts.fewest_cells,
                        parts.most_cells, parts.cut_faces);
  for (const std::string& notice : info.notices) text += fmt::format("note       {}\n", notice);
  return text;
}

}  // namespace cobasis
