// Who touches whom: faces found by their nodes.
#pragma once

#include <vector>

#include "mesh/global_mesh.hpp"

namespace cobasis {

/// Faces of two cells with left < right, then boundary faces with group as an index into raw.group_names, -1 where no
/// boundary element lies on them. Boundary elements inside the mesh are ignored with a notice in raw. Throws
/// InputError: elements listed twice or overlapping, a face of more than two cells, a boundary element in two groups.
std::vector<FaceLink> connect(RawMesh& raw);

/// Corners of a cell's face in the cell's order; `corners` has room for four. Returns how many there are.
int face_nodes(const RawMesh& raw, std::int32_t cell, int local, std::int32_t* corners);

}  // namespace cobasis
