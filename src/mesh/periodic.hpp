// Boundary groups joined by a translation.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "mesh/global_mesh.hpp"

namespace cobasis {

struct PeriodicFaces {
  std::vector<FaceLink> faces;  ///< those of `connect`, the pairs' boundary faces replaced by faces of two cells
  std::vector<Point> shifts;    ///< from the first-named group of each pair to the second
};

/// Matches the faces of each pair of groups by their corners and moves those of the second group to exactly where the
/// shift puts those of the first (a file's digits differ), so that cells stay closed through the shared face. Throws
/// InputError: unknown group, a group named twice, faces without a counterpart.
PeriodicFaces join_periodic(RawMesh& raw, std::vector<FaceLink> faces,
                            const std::vector<std::pair<std::string, std::string>>& pairs);

}  // namespace cobasis
