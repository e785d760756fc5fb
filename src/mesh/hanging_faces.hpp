// Boundary faces that no physical group names: forgotten by the user, or the sign of a mesh that does not fit together.
#pragma once

#include <vector>

#include "mesh/global_mesh.hpp"

namespace cobasis {

/// Throws InputError if boundary faces are in no group; says whether they hang on faces that do not share their nodes.
void check_all_grouped(const RawMesh& raw, const std::vector<FaceLink>& faces);

}  // namespace cobasis
