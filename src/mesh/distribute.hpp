// Cuts each rank's part from the whole mesh.
#pragma once

#include <vector>

#include "mesh/global_mesh.hpp"

namespace cobasis {

/// Takes parts one after the other; keeps a table of the size of the whole mesh between them.
class PartCutter {
 public:
  PartCutter(const GlobalMesh& whole, const std::vector<int>& owner, int n_parts);
  Mesh cut(int part);

 private:
  struct Draft;
  void add_cells(Draft& draft) const;
  void add_faces(Draft& draft) const;
  void add_cell_faces(Draft& draft) const;
  void add_neighbours(Draft& draft) const;

  const GlobalMesh& whole_;
  const std::vector<int>& owner_;
  std::vector<std::vector<std::int32_t>> owned_;  ///< global ids by part, ascending
  std::vector<std::int32_t> local_;               ///< of each global cell, -1 outside the part at hand
};

std::vector<char> pack(const Mesh& mesh);
Mesh unpack(const std::vector<char>& bytes);

}  // namespace cobasis
