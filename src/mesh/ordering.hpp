// Numbers cells along a space-filling curve: neighbours in space are neighbours in memory, on any number of ranks.
#pragma once

#include <vector>

#include "mesh/raw_mesh.hpp"

namespace cobasis {

/// Cell numbers along Morton's curve through `points`, which are scaled alike in all directions.
std::vector<std::int32_t> morton_order(const std::vector<Point>& points, int dimension);

/// The mesh with its cells in the given order and its nodes in the order in which the cells use them.
RawMesh renumber(const RawMesh& raw, const std::vector<std::int32_t>& order);

}  // namespace cobasis
