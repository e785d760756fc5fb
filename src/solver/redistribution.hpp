// Small cut volumes without small steps: state redistribution (Berger and Giuliani, J. Comput. Phys. 428 (2021) 109820)
// per phase. After an update whose step knows only the sizes of whole cells, a phase that fills little of a cell is
// averaged, weighted by volume, with the same phase in a neighbour that has more of it. Volume fractions stay.
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
#include "solver/keeper.hpp"
#include "solver/remote_volumes.hpp"

namespace cobasis {

/// What has been redistributed so far on this rank, summed over steps.
struct RedistributionCounters {
  std::int64_t merged = 0;  ///< small volumes averaged with a neighbour's
  std::int64_t mended = 0;  ///< volumes of an inadmissible state averaged with a neighbour's
  std::int64_t alone = 0;   ///< small volumes without a neighbour that has more of the phase
  std::int64_t apart = 0;   ///< negative volumes that nearly cancel the neighbour's share: left as they were
};

/// Phase k of cell i with alpha_ik < 0.55 has the neighbourhood {i, d}, d the face neighbour with the largest alpha_dk,
/// which must exceed |alpha_ik| (of equals the one with the smaller global number); any other has {i}. A donor d lends
/// the part beta of itself that brings the neighbourhood to 0.55 of a cell, at most 1 / (1 + number of takers), and
/// keeps the rest. With V the volumes of the phase a neighbourhood has the mean Q^ of what is in it, and a cell takes
/// the mean of the Q^ of its neighbourhoods, weighted by its parts: sum V Q is conserved, for V > 0 all averages are
/// convex, and what is nearly large enough is hardly averaged (Giuliani, Almgren, Bell, Berger, de Frahan, Rangarajan,
/// J. Comput. Phys. 464 (2022) 111305). Neighbourhoods whose donor is small itself come after the others: what such a
/// donor lends is what it has got. Q: mass, momentum, energy per volume of the phase, and the cobasis. With half a
/// cell quadrilaterals would be unstable at a CFL number of 0.8 where a phase fills just that; with 0.6 the pressure of
/// a strong shock tube of water is off by 0.2 %.
class Redistribution {
 public:
  Redistribution(const Mpi& mpi, const Mesh& mesh, const Fields& fields);

  /// After an update, before primitives are made from it. `candidates`: owned cells, ascending, among them all with
  /// several phases; what they are averaged with need not be among them. Collective. Needs no halo cell to be current;
  /// leaves the new volume fractions there, their conserved quantities as they are. The same bits for any partition.
  void run(const Mesh& mesh, const Faces& faces, Fields& fields, std::span<const std::int32_t> candidates);

  /// The same for the listed (owned cell, phase) alone, whatever their size, and with whatever neighbour has most of
  /// the phase: for states that are not admissible. `changed` then says what got a new state.
  void mend(const Mesh& mesh, const Faces& faces, Fields& fields,
            std::span<const std::pair<std::int32_t, int>> volumes);
  /// (owned cell, phase) that the last call averaged.
  const std::vector<std::pair<std::int32_t, int>>& changed() const { return changed_; }

  const RedistributionCounters& counters() const { return counters_; }
  void keep(Keeper& keeper);  ///< these

 private:
  static constexpr int most_components = Layout<Space, Kind::solid>::n_conserved;

  /// A cell's share of a neighbourhood: its part of V, and that times Q.
  struct Share {
    double volume;
    std::array<double, most_components> content;
  };
  struct Pair {  // neighbourhood of phase k of two cells, of which this rank owns at least one
    std::int32_t cell, donor;
    int k;
    double lent = 0;                             // beta, known to the donor's owner
    bool apart = false;                          // no mean: both keep what they have
    double volume = 0, own = 0;                  // of the phase: of the neighbourhood, of the cell in it
    std::array<double, most_components> mean{};  // Q^
    std::array<double, most_components> step{};  // Q in the cell less Q in the donor, by the donor's slopes
  };
  /// Which cells of a phase are averaged; all is -1 and 0 between runs.
  struct Members {
    std::vector<std::int32_t> pair_of;  ///< of owned and halo cells: position in pairs_ of the pair about the cell
    std::vector<std::int32_t> chosen;   ///< of owned cells: by how many neighbours
  };

  bool choose(const Mesh& mesh, const Faces& faces, const Fields& fields, int k, std::int32_t cell, double more_than);
  void settle(const Mesh& mesh, const Faces& faces, Fields& fields, double target);
  void share_choices(const Mesh& mesh);
  void average(const Mesh& mesh, const Faces& faces, const Fields& fields);
  void lend(const Mesh& mesh, const Fields& fields, Pair& pair, double target) const;
  double kept(const Mesh& mesh, const Faces& faces, int k, std::int32_t cell) const;
  template <class Visit>
  void for_each_taker(const Mesh& mesh, const Faces& faces, int k, std::int32_t cell, const Visit& visit) const;
  void take(const Mesh& mesh, const Faces& faces, Fields& fields, int k, std::int32_t cell);
  std::array<double, 3> between(const Mesh& mesh, const Faces& faces, const Fields& fields, const Pair& pair) const;
  std::array<double, most_components> step_beside(const Mesh& mesh, const Faces& faces, const Fields& fields,
                                                  const Pair& pair) const;
  Share share_of(const Fields& fields, int k, std::int32_t cell, double fraction) const;

  const Mpi& mpi_;
  RemoteVolumes remote_;
  NeighbourExchange alpha_, choices_, shares_;
  std::vector<std::int32_t> neighbour_of_halo_;
  std::vector<Pair> pairs_;   // first about owned cells, then about halo cells
  std::vector<Pair> second_;  // about owned cells, with donors that are small themselves
  std::size_t n_own_pairs_ = 0;
  std::vector<std::vector<std::int32_t>> asked_;  // per neighbour: pairs about owned cells with its cells
  std::vector<std::pair<std::int32_t, std::int32_t>> received_;  // per neighbour: its part of pairs_
  std::vector<Members> members_;                                 // per phase
  std::vector<std::pair<std::int32_t, int>> small_;              // (cell, phase) with no state to share
  std::vector<std::pair<std::int32_t, int>> changed_;            // (cell, phase) in at least one pair
  RedistributionCounters counters_;
};

}  // namespace cobasis
