// What `cobasis info MESH` says about a mesh.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mesh/read_mesh.hpp"

namespace cobasis {

struct MeshInfo {
  std::string file;
  int dimension = 0;
  std::int64_t cells = 0, faces = 0, nodes = 0;
  std::array<std::int64_t, 6> cells_by_type{};  ///< indexed by CellType

  struct Group {
    std::string name;
    std::int64_t count = 0;  ///< cells or boundary faces
    double measure = 0;      ///< their volume [m^3, in a plane m^2] or area [m^2, in a plane m]
  };
  std::vector<Group> regions, boundaries;

  Point low, high;  ///< bounding box [m]
  double volume = 0, smallest_volume = 0, largest_volume = 0;
  double worst_aspect = 0;  ///< S h / (2 d V) of surface S, longest edge h, dimension d: square and cube 1, equilateral
                            ///< triangle 1.73, regular tetrahedron 2.45, slender or flat cells large
  double worst_warp = 0;  ///< distance of a quadrilateral face's corners from its mean plane / square root of its area

  struct Parts {
    int n = 0;
    std::int64_t fewest_cells = 0, most_cells = 0;
    std::int64_t cut_faces = 0;
  };
  std::vector<Parts> parts;  ///< for 2, 4 and 8 ranks

  std::vector<std::string> notices;
};

/// Needs no ranks; to be called on one. Throws InputError as read_mesh does.
MeshInfo mesh_info(const MeshRequest& request);

/// A page of text, lines ended by \n.
std::string format(const MeshInfo& info);

}  // namespace cobasis
