// Three unit cubes in a row along x as text in Gmsh's format 2.2: a hexahedron; pyramids about a centre, two of them
// cut into tetrahedra; two prisms. With warp, the faces between the cubes are not plane; the box stays [0,3] x [0,1]^2.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "mesh/cell_shape.hpp"

namespace cobasis {

struct MshText {
  std::vector<Point> nodes;
  std::vector<std::pair<CellType, std::vector<int>>> cells;
  std::string extra_elements;  ///< more lines "type tags nodes", numbered after the others

  /// All boundary faces are in the physical group "wall", all cells in "body".
  std::string text() const {
    constexpr int gmsh_type[] = {2, 3, 4, 5, 6, 7};
    std::map<std::vector<int>, std::pair<int, std::vector<int>>> faces;
    for (const auto& [type, corners] : cells) {
      const CellShape& shape = shape_of(type);
      for (int f = 0; f < shape.n_faces; ++f) {
        std::vector<int> face;
        for (int i = 0; i < shape.faces[f].size; ++i) face.push_back(corners[shape.faces[f].corner[i]]);
        std::vector<int> key = face;
        std::sort(key.begin(), key.end());
        auto& entry = faces[key];
        ++entry.first;
        entry.second = face;
      }
    }
    const int dimension = shape_of(cells[0].first).dimension;
    std::vector<std::string> elements;
    for (const auto& [key, entry] : faces) {
      const auto& [count, corners] = entry;
      if (count == 1) elements.push_back(fmt::format("{} 2 1 1 {}", corners.size() - 1, list(corners)));
    }
    for (const auto& [type, corners] : cells)
      elements.push_back(fmt::format("{} 2 2 1 {}", gmsh_type[static_cast<int>(type)], list(corners)));
    for (std::size_t at = 0; at < extra_elements.size();) {
      const std::size_t end = extra_elements.find('\n', at);
      elements.push_back(extra_elements.substr(at, end - at));
      at = end + 1;
    }
    std::string out = fmt::format(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n{} 1 \"wall\"\n{} 2 \"body\"\n$EndPhysicalNames\n"
        "$Nodes\n{}\n",
        dimension - 1, dimension, nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i)
      out += fmt::format("{} {} {} {}\n", i + 1, nodes[i].x, nodes[i].y, nodes[i].z);
    out += fmt::format("$EndNodes\n$Elements\n{}\n", elements.size());
    for (std::size_t i = 0; i < elements.size(); ++i) out += fmt::format("{} {}\n", i + 1, elements[i]);
    return out + "$EndElements\n";
  }

 private:
  static std::string list(std::vector<int> corners) {
    for (int& node : corners) ++node;
    return fmt::format("{}", fmt::join(corners, " "));
  }
};

inline MshText mixed_mesh(double warp) {
  MshText mesh;
  for (int x = 0; x < 4; ++x) {  // nodes 4x … 4x+3 round the section x
    const bool inner = x == 1 || x == 2;
    const double d[4] = {warp, -0.7 * warp, 0.4 * warp, -warp};
    const double y[4] = {0, 1, 1, 0}, z[4] = {0, 0, 1, 1};
    for (int i = 0; i < 4; ++i) mesh.nodes.push_back({x + (inner ? d[i] : 0), y[i], z[i]});
  }
  mesh.nodes.push_back({1.5, 0.5, 0.5});
  const int c = 16;
  mesh.cells = {
      {CellType::hexahedron, {0, 1, 2, 3, 4, 5, 6, 7}},
      {CellType::pyramid, {4, 5, 6, 7, c}},    // towards the hexahedron
      {CellType::pyramid, {8, 11, 10, 9, c}},  // towards the prisms
      {CellType::pyramid, {4, 7, 11, 8, c}},   // y = 0
      {CellType::pyramid, {5, 9, 10, 6, c}},   // y = 1
      {CellType::tetrahedron, {4, 8, 9, c}},   // z = 0
      {CellType::tetrahedron, {4, 9, 5, c}},
      {CellType::tetrahedron, {7, 6, 10, c}},  // z = 1
      {CellType::tetrahedron, {7, 10, 11, c}},
      {CellType::prism, {8, 12, 13, 11, 15, 14}},
      {CellType::prism, {8, 13, 9, 11, 14, 10}},
  };
  return mesh;
}

}  // namespace cobasis
