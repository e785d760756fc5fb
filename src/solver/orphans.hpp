// Fragments without an admissible state of their own live on a neighbour's. Those that have no such neighbour are
// beyond help: with their own state their motion means nothing, and soon more than the whole scene's energy is in it.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "mesh/mesh.hpp"
#include "mesh/neighbour_exchange.hpp"
#include "solver/faces.hpp"
#include "solver/field.hpp"

namespace cobasis {

class Orphans {
 public:
  Orphans(const Mpi& mpi, const Mesh& mesh, const Fields& fields);

  /// Those of `fragments`, (owned cell, phase), of at least the volume fraction `least`, with no neighbour in which the
  /// phase has a state of its own: as much of it, and no fragment. All the fragments of this rank are given.
  /// Collective.
  const std::vector<std::pair<std::int32_t, int>>& find(const Mesh& mesh, const Faces& faces, const Fields& fields,
                                                        std::span<const std::pair<std::int32_t, int>> fragments,
                                                        double least);

 private:
  const Mpi& mpi_;
  NeighbourExchange exchange_;
  std::vector<std::vector<std::int8_t>> is_fragment_;    // [phase][owned cell]; all false between calls
  std::vector<std::vector<std::int8_t>> sound_in_halo_;  // [phase][halo cell]: has a state of its own
  std::vector<std::pair<std::int32_t, int>> found_;
};

}  // namespace cobasis
