// A mesh as it lies in a file: nodes, cells and the boundary elements of named groups, nothing yet connected.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace cobasis {

struct RawMesh {
  int dimension = 0;
  std::vector<Point> nodes;

  std::vector<CellType> cell_type;
  std::vector<std::int32_t> cell_node_begin{0};  ///< CSR
  std::vector<std::int32_t> cell_nodes;
  std::vector<std::int64_t> cell_tag;     ///< the element's number in the file
  std::vector<std::int32_t> cell_region;  ///< index into region_names, -1: none
  std::vector<std::string> region_names;

  // boundary elements of physical groups
  std::vector<std::array<std::int32_t, 4>> side_nodes;  ///< -1 beyond its corners
  std::vector<std::int64_t> side_tag;
  std::vector<std::int32_t> side_group;  ///< index into group_names
  std::vector<std::string> group_names;

  std::vector<std::string> notices;

  std::int32_t n_cells() const { return static_cast<std::int32_t>(cell_type.size()); }
};

/// Calls visit for every member in a fixed order.
template <class Raw, class Visit>
void for_each_member(Raw& raw, Visit& visit) {
  visit(raw.dimension);
  visit(raw.nodes);
  visit(raw.cell_type);
  visit(raw.cell_node_begin);
  visit(raw.cell_nodes);
  visit(raw.cell_tag);
  visit(raw.cell_region);
  visit(raw.region_names);
  visit(raw.side_nodes);
  visit(raw.side_tag);
  visit(raw.side_group);
  visit(raw.group_names);
  visit(raw.notices);
}

}  // namespace cobasis
