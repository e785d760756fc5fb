// Where a step has failed: cells that stay at first order and with diffuse interfaces, as in the paper, for some steps.
#pragma once

#include "mesh/mesh.hpp"
#include "mesh/mpi.hpp"
#include "mesh/neighbour_exchange.hpp"
#include "solver/field.hpp"
#include "solver/keeper.hpp"

namespace cobasis {

class Caution {
 public:
  Caution(const Mpi& mpi, const Mesh& mesh);

  /// An owned cell whose state was not admissible.
  void note(std::int32_t cell) { noted_.push_back(cell); }
  /// The cells noted and those around them are treated with caution from this step on: the farther and the longer, the
  /// more attempts at the step have failed. Collective.
  void spread(const Mesh& mesh, std::int64_t step, int failed);
  /// Says in Fields::cautious which cells are treated so in this step.
  void tell(Fields& fields, std::int64_t step);
  void keep(Keeper& keeper, const Mesh& mesh, std::int64_t step);

 private:
  void tell_halo(const Mesh& mesh);

  std::vector<std::int32_t> noted_;
  std::vector<std::int64_t> until_;  // per owned and halo cell: the first step without caution
  std::int64_t until_any_ = 0;       // the largest of these
  NeighbourExchange exchange_;
};

}  // namespace cobasis
