// The mesh of one rank as the solver sees it: cells with volumes, oriented faces with frames, and who shares what.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "math/vec3.hpp"

namespace cobasis {

enum class CellType : std::uint8_t { triangle, quadrilateral, tetrahedron, hexahedron, prism, pyramid };

/// Boundary faces of one physical group.
struct BoundaryGroup {
  std::string name;
  std::int32_t first = 0;  ///< face index
  std::int32_t last = 0;   ///< one past the last face
};

/// A rank that shares faces with this one.
struct Neighbour {
  int rank = 0;
  std::vector<std::int32_t> send;  ///< owned cells that the other rank holds as halo, ascending global id
  std::int32_t receive_first = 0;  ///< first halo cell that comes from there; they follow in ascending global id
  std::int32_t receive_count = 0;
};

/// Cells: owned first (renumbered for locality), then halo (one layer of face neighbours, grouped by neighbour), then
/// one ghost per boundary face. Faces: interior (two owned cells), then halo (an owned and a halo cell), then boundary
/// (an owned cell left, its ghost right), grouped by physical group. A face that joins two owned or halo cells points
/// from the smaller to the larger global id; a face of a cell with its own periodic image, or one of two faces that
/// join the same two cells through a periodic pair, points as the first-named of the paired groups says (outward from
/// it).
struct Mesh {
  int dimension = 0;  ///< 2 (in z = 0, unit depth) or 3
  /// Axisymmetric: cells and faces of a two-dimensional mesh are sections of the rings that they sweep around the x
  /// axis. Volumes, areas and centroids are those of the rings; dimension is 2.
  bool axisymmetric = false;

  // cells: owned and halo, unless said otherwise
  std::int32_t n_owned = 0;
  std::int32_t n_halo = 0;
  std::int32_t n_ghosts = 0;   ///< = number of boundary faces; ghost of face f is ghost_of(f)
  std::int64_t n_global = 0;   ///< cells of all ranks
  std::vector<double> volume;  ///< [m^3], [m^2] in a plane
  std::vector<Point> centroid;
  std::vector<double> section;          ///< axisymmetric: area of the ring's section [m^2], else empty
  std::vector<Point> section_centroid;  ///< and its centroid, nearer to the axis than the ring's
  std::vector<std::int64_t> global_id;  ///< 0 … n_global-1, independent of the partition
  std::vector<CellType> cell_type;
  std::vector<std::int32_t> cell_region;      ///< index into region_names, -1: none
  std::vector<std::int32_t> cell_node_begin;  ///< CSR, size n_owned + n_halo + 1
  std::vector<std::int32_t> cell_nodes;       ///< corners in Gmsh's (= VTK's) order
  std::vector<std::string> region_names;      ///< physical groups of the cells' dimension
  std::vector<Point> nodes;                   ///< those of the owned and halo cells
  std::vector<std::int64_t> node_global_id;

  // faces
  std::int32_t n_interior_faces = 0;
  std::int32_t n_halo_faces = 0;
  std::int32_t n_boundary_faces = 0;
  std::vector<std::int32_t> left, right;  ///< cells; right of a boundary face is its ghost
  std::vector<double> area;               ///< [m^2], [m] in a plane; 0 on the axis
  std::vector<double> nx, ny, nz;         ///< unit normal, from left to right
  std::vector<double> tx, ty, tz;         ///< first unit tangent t1; t2 = n x t1. In a plane t1 = (-ny, nx, 0)
  std::vector<Point> face_centroid;       ///< as seen from the left cell
  std::vector<Point> face_delta;  ///< centroid of right minus centroid of left, through the periodic image where there
                                  ///< is one (boundary: 2 (face centroid - left centroid)·n n)
  std::vector<BoundaryGroup>
      boundary_groups;  ///< all groups of the whole mesh, the same list on every rank (periodic pairs left out)

  // faces of each owned cell, in the cell's own (partition-independent) order: entry j of cell i at
  // cell_faces[j * cell_stride + i] = 2 face + side (0: cell is left, 1: cell is right), -1 where the cell has fewer
  // faces
  int max_cell_faces = 0;
  std::int32_t cell_stride = 0;  ///< n_owned padded to a multiple of 16; padding entries are -1
  std::vector<std::int32_t> cell_faces;

  std::vector<Neighbour> neighbours;

  std::vector<std::string> notices;  ///< what the user should know about the file, a line each; on rank 0 only

  /// [m^2] in a plane and in a meridian plane, [m^3] in space: what the size of a cell is a root of.
  double measure(std::int32_t cell) const { return axisymmetric ? section[cell] : volume[cell]; }
  std::int32_t n_cells() const { return n_owned + n_halo; }
  std::int32_t n_all() const { return n_owned + n_halo + n_ghosts; }
  std::int32_t n_faces() const { return n_interior_faces + n_halo_faces + n_boundary_faces; }
  std::int32_t first_boundary_face() const { return n_interior_faces + n_halo_faces; }
  std::int32_t ghost_of(std::int32_t face) const { return n_owned + n_halo + face - first_boundary_face(); }
};

}  // namespace cobasis
