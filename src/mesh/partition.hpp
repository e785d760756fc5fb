// Which rank owns which cell.
#pragma once

#include <vector>

#include "mesh/global_mesh.hpp"
#include "mesh/read_mesh.hpp"

namespace cobasis {

/// The owner of every cell, 0 … n_parts-1: by request.partition, or by METIS on the graph of faces with
/// request.cell_weight. The same for the same mesh, parts and weights; parts may be empty.
std::vector<int> partition(const GlobalMesh& mesh, int n_parts, const MeshRequest& request);

}  // namespace cobasis
