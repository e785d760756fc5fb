// Boundary conditions: every physical group of the mesh's boundary gets exactly one.
#pragma once

#include <vector>

#include "mesh/mesh.hpp"
#include "solver/setup.hpp"

namespace cobasis {

/// The boundary of each of the mesh's groups, in its order. Throws InputError (file:line) if the case names a group
/// that the mesh lacks, or the mesh has one that the case neither names nor covers with "*".
std::vector<Boundary> resolve_boundaries(const Setup& setup, const Mesh& mesh);

}  // namespace cobasis
