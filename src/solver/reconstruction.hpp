// Second order: which cells of which phase have slopes, and the states at faces between ranks.
#pragma once

#include <optional>

#include "mesh/neighbour_exchange.hpp"
#include "solver/keeper.hpp"
#include "solver/kernels.hpp"

namespace cobasis {

class Reconstruction {
 public:
  /// Collective.
  Reconstruction(const Mpi& mpi, const Mesh& mesh, const Faces& faces, Fields& fields,
                 const std::vector<PhaseKernels>& kernels, const std::vector<Boundary>& boundaries);

  /// States at the faces of the cells that need nothing from other ranks, then of the others, once the halo is there.
  void run_inside(Fields& fields, const Faces& faces, const ReconstructionOptions& options);
  void run_beside_halo(const Mesh& mesh, Fields& fields, const Faces& faces, const ReconstructionOptions& options);
  /// Exchanges the states at faces between ranks. In between other work can be done.
  void send(const Mesh& mesh, const Fields& fields);
  void receive(const Mesh& mesh, Fields& fields);

  const Stencil& stencil() const { return stencil_; }
  /// Cells and phases with slopes so far, and those of them that fell back to first order because a state at a face
  /// would have been inadmissible; of this rank.
  std::int64_t reconstructed() const { return reconstructed_; }
  std::int64_t fallen() const { return fallen_; }
  void keep(Keeper& keeper);  ///< these

 private:
  struct Group {
    CellList cells[2];  // without and with mirrors among their faces
  };
  void select(const Group& group, const Fields& fields, int k, int mirrors);
  void find_slopes(Group& group, Fields& fields, const Faces& faces);
  void forget_slopes(Fields& fields);
  void run(Group& group, Fields& fields, const Faces& faces, const ReconstructionOptions& options);

  Stencil stencil_;
  std::vector<PhaseKernels> kernels_;
  Group inside_, beside_halo_;
  CellList with_slopes_, beside_gaps_, without_;  // scratch
  std::vector<std::vector<std::int32_t>> used_;   // per phase: cells whose Phase::used_slopes are not 0
  /// 1 for simplices at transmissive faces: what flows in there is what the cell makes of its neighbours; with
  /// gradients over so few of them noise would grow.
  AlignedVector<double> flat_;
  std::vector<std::int32_t> transmissive_;             // faces whose right state is their left one
  std::vector<std::vector<std::int32_t>> halo_faces_;  // per neighbour, in an order that both know: 2 face + own side
  NeighbourExchange exchange_;
  std::optional<NeighbourExchange> slope_exchange_;  // where gradients are averaged
  std::int64_t reconstructed_ = 0, fallen_ = 0;
};

}  // namespace cobasis
