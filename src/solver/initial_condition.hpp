// The regions of a case painted onto the cells of a mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/mesh.hpp"
#include "solver/setup.hpp"

namespace cobasis {

/// Both: [phase][owned cell].
struct InitialState {
  std::vector<std::vector<double>> alpha;         ///< volume fractions; exactly the filling's in a cell that is not cut
  std::vector<std::vector<std::int32_t>> region;  ///< index of the region whose PhaseState holds; -1: phase absent
};

/// Regions are painted in order: with the fraction f of a cell inside a region, alpha_k <- (1 - f) alpha_k + f fill_k.
/// Where several regions bring the same phase into a cell, the state is that of the one with most of the phase there
/// (of equals, the later). Throws InputError if a cell is not covered in full (naming its centroid), or if the mesh has
/// no cells of a physical group that a region names (naming the groups it has). A rank speaks for its own cells alone.
InitialState paint(const std::vector<RegionSetup>& regions, int n_phases, const Mesh& mesh);

/// Relative cost of a cell for the partition, from what fills it at first: voids cost next to nothing.
/// \param group physical group of the cell, "": none
int cell_cost(const Setup& setup, const Point& centroid, const std::string& group);

}  // namespace cobasis
