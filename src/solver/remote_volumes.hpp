// Volumes of a phase that are small and have only small ones around them: the corner of a phase in a fan of simplices.
// None of them has a state that it could share; together with the nearest cell that has, they have one.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "mesh/mesh.hpp"
#include "mesh/neighbour_exchange.hpp"
#include "solver/faces.hpp"
#include "solver/field.hpp"

namespace cobasis {

/// Trees of cells that share faces: the root has more than `least_root` of the phase, a branch less or as much; every
/// branch hangs on the cell with most of the phase among those nearer to a root. Trees deeper than one branch take the
/// mean of mass, momentum, energy per volume of the phase, and of the cobasis, over all their cells: the sum over the
/// tree is conserved.
class RemoteVolumes {
 public:
  static constexpr int deepest = 4;

  RemoteVolumes(const Mpi& mpi, const Mesh& mesh, const Fields& fields);

  /// What is small itself has no state to share. In fans of simplices many volumes are small alike, and waves cross a
  /// tenth of a cell as often as what hangs on it, which grows its own errors there.
  static double least_root(CellType type);

  /// `small`: (owned cell, phase) with a volume fraction that is not 0 and at most `least_root`; volume fractions of
  /// the halo must be known. Collective. The same bits for any partition. Returns how many hang on no root.
  std::int64_t run(const Mesh& mesh, const Faces& faces, Fields& fields,
                   std::span<const std::pair<std::int32_t, int>> small);

 private:
  static constexpr int most_components = Layout<Space, Kind::solid>::n_conserved;

  struct Node {
    std::int32_t cell;
    int k;
    int level = -1;  // branches to the root; -1: not yet known
    std::int64_t parent_id = -1;
    std::int32_t parent = -1;  // of an owned cell
    bool active = false;       // whether it is in a tree of several branches
    bool has_mean = false;
    double volume = 0;
    std::array<double, most_components> content{};  // of the cell and what hangs on it; then the mean of the tree
  };
  Node* find(int k, std::int32_t cell) { return at_[k][cell] < 0 ? nullptr : &nodes_[at_[k][cell]]; }
  Node& node_of(int k, std::int32_t cell);
  template <class Visit>
  void for_each_neighbour(const Mesh& mesh, const Faces& faces, std::int32_t cell, const Visit& visit) const;
  template <class Choice, class Numbers>
  void exchange(const Mesh& mesh, const Choice& chosen, const Numbers& numbers);
  void grow(const Mesh& mesh, const Faces& faces, const Fields& fields, int level);
  void collect(const Mesh& mesh, const Faces& faces, const Fields& fields, Node& parent);

  NeighbourExchange exchange_;
  std::vector<std::vector<std::int32_t>> at_;  // [phase][cell]: in nodes_; all -1 between runs
  std::vector<Node> nodes_;                    // of owned and of halo cells
};

}  // namespace cobasis
