// From a .msh or .geo file to the mesh of each rank.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "mesh/mesh.hpp"
#include "mesh/mpi.hpp"

namespace cobasis {

struct MeshRequest {
  std::string file;                          ///< .msh (2.2, 4.1; ASCII, binary) or .geo
  std::map<std::string, double> parameters;  ///< DefineConstant numbers of a .geo
  bool trust_geo = false;                    ///< let a .geo run commands and read other files
  int splits = 0;                            ///< times every cell is cut into 4 (plane) or 8 (space)
  int dimension = 0;                         ///< 2, 3, or 0: 3 if the mesh has volume cells, else 2
  bool axisymmetric = false;  ///< a two-dimensional mesh is the upper half of a meridian plane, x the axis
  std::vector<std::pair<std::string, std::string>> periodic;  ///< pairs of boundary groups, matched by translation
  /// Cost of a cell for the partition, >= 1, by its centroid and physical group ("": none). Empty: all alike.
  std::function<int(const Point& centroid, const std::string& region)> cell_weight;
  std::function<int(std::int64_t global_cell, int n_parts)> partition;  ///< empty: METIS; tests pass random ones
};

/// Rank 0 reads, checks, numbers and partitions; every rank gets its part. Collective. Throws InputError on all ranks
/// alike: missing, truncated or non-mesh file, no cells of the dimension, non-positive volume (with the element's
/// number), boundary face without a group, hanging face, unmatched periodic pair.
Mesh read_mesh(const MeshRequest& request, const Mpi& mpi);

}  // namespace cobasis
