// The whole mesh, connected and numbered, on rank 0: what the ranks' parts are cut from. Nothing here depends on the
// partition.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "mesh/raw_mesh.hpp"
#include "mesh/read_mesh.hpp"

namespace cobasis {

/// A face and its cells. Boundary: right = -1 and group >= 0; else group = -1. The left cell decides normal and
/// centroid.
struct FaceLink {
  std::int32_t left = -1, right = -1;
  std::int8_t left_local = 0, right_local = 0;  ///< its number among the cell's own faces
  std::int32_t group = -1;
  std::int32_t image = 0;  ///< k + 1: right lies one shift of periodic pair k ahead; -(k + 1): behind; 0: not periodic
};

struct GlobalMesh {
  RawMesh raw;  ///< cells in the order of their global ids, nodes in the order of theirs
  bool axisymmetric = false;
  std::vector<double> volume;
  std::vector<Point> centroid;
  std::vector<double> section;          ///< axisymmetric, see Mesh; else empty
  std::vector<Point> section_centroid;  ///< likewise

  std::vector<FaceLink> faces;  ///< first those of two cells, by (left, right), then the boundary's, by (group, left)
  std::int64_t n_inner_faces = 0;
  std::vector<Point> face_area;               ///< area vectors, from left to right; axisymmetric: of the section
  std::vector<double> face_circumference;     ///< axisymmetric: their length times this is the area of the ring
  std::vector<Point> face_centroid;           ///< as seen from the left cell
  std::vector<std::int64_t> cell_face_begin;  ///< CSR: faces of a cell in its own order
  std::vector<std::int64_t> cell_faces;       ///< 2 face + side
  std::vector<std::string> boundary_names;    ///< what FaceLink::group counts
  std::vector<Point> shifts;                  ///< of each periodic pair, from the first-named group to the second

  std::int32_t n_cells() const { return raw.n_cells(); }
  std::span<const std::int32_t> nodes_of(std::int32_t cell) const;
  /// Centroid of right minus centroid of left, through the periodic image; of a boundary face twice the way to it.
  Point delta(std::int64_t face) const;
};

/// Checks, numbers and connects. Throws InputError.
GlobalMesh build_global_mesh(RawMesh raw, const std::vector<std::pair<std::string, std::string>>& periodic,
                             bool axisymmetric = false);

/// Reads request.file through Gmsh and builds. Throws InputError naming the file.
GlobalMesh read_global_mesh(const MeshRequest& request);

}  // namespace cobasis
