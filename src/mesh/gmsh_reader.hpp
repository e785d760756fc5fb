// The only door to Gmsh. Gmsh works in a child process: it crashes on some damaged files and scripts.
#pragma once

#include "mesh/raw_mesh.hpp"
#include "mesh/read_mesh.hpp"

namespace cobasis {

/// Reads a .msh or meshes a .geo. Nodes that no cell uses are dropped, elements of higher order keep their corners.
/// Throws InputError.
RawMesh read_gmsh(const MeshRequest& request);

}  // namespace cobasis
