// Absent phases at no cost: small volumes of a phase change places with equal volumes of the other phase in a neighbour
// that has more of it. Conserves every phase, leaves intensive values untouched, and moves slow fronts exactly.
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

/// What has been exchanged so far on this rank.
struct ExchangeCounters {
  std::int64_t exchanges = 0;
  std::int64_t kept = 0;  ///< small volumes that found no partner and stayed, summed over steps
  std::int64_t dust = 0;  ///< volumes below 1e-11 whose content went to a neighbour without volume
};

/// What a phase has in a cell in total: mass, momentum, energy [kg, kg m/s, J], and volume times cobasis [m^3].
using Content = std::array<double, Layout<Space, Kind::solid>::n_conserved>;

class VolumeExchange {
 public:
  VolumeExchange(const Mpi& mpi, const Mesh& mesh, const Fields& fields);

  /// After a full step. `candidates`: owned cells, ascending, among them all with several phases. `forced`: (cell,
  /// phase) fragments to be exchanged whatever their size, ascending. Collective. Returns the owned cells that were
  /// touched, ascending.
  const std::vector<std::int32_t>& run(const Mesh& mesh, const Faces& faces, Fields& fields, double dt,
                                       std::span<const std::int32_t> candidates,
                                       const std::vector<std::pair<std::int32_t, int>>& forced);

  double kernel_seconds() const { return kernel_seconds_; }  ///< spent in loops over packs so far
  const ExchangeCounters& counters() const { return counters_; }
  /// Volume that each owned cell has got rid of so far [m^3].
  const std::vector<double>& volume_of_cell() const { return volume_of_cell_; }

 private:
  enum class Answer { refused, granted, dust };
  struct Request {  // phase k of cell asks donor for an equal volume of phase j
    std::int64_t from_id;
    std::int32_t cell, donor;
    int k, j;
    double volume, alpha;
    bool dust_only;
    int neighbour;  // who asks (received) or is asked (sent); -1: this rank itself
    int position;   // among the requests of that neighbour
    Answer answer;
    int content;  // received from another rank: where in contents_; else -1
  };
  struct Deposit {
    std::int32_t cell;
    int phase;
    std::int64_t from_id;
    double volume;
    Content content;
  };
  struct Extraction {
    std::int32_t cell;
    int phase;
    double volume;
  };

  void share_alpha(const Mesh& mesh, Fields& fields);
  void find_small(const Fields& fields, std::span<const std::int32_t> candidates,
                  const std::vector<std::pair<std::int32_t, int>>& forced);
  void ask(const Mesh& mesh, const Faces& faces, const Fields& fields, double dt,
           std::span<const std::int32_t> candidates, const std::vector<std::pair<std::int32_t, int>>& forced);
  void request(const Mesh& mesh, const Faces& faces, const Fields& fields, std::int32_t cell, int k, bool forced);
  void deliver(const Mesh& mesh, const Fields& fields);
  void serve(const Mesh& mesh, const Fields& fields);
  void collect_answers(const Mesh& mesh, const Fields& fields);
  void settle(const Mesh& mesh, const Request& request, Answer answer, const Content& content);
  void apply(Fields& fields);
  Content content_of(const Fields& fields, int k, std::int32_t cell) const;

  NeighbourExchange alpha_, requests_out_, answers_;
  std::vector<std::int32_t> neighbour_of_halo_;
  std::vector<Request> asked_, received_;
  std::vector<Content> contents_;    // of requests from other ranks: first what comes, then what is given for it
  std::vector<std::int32_t> order_;  // scratch: positions in sorted order
  std::vector<int> sent_;            // requests per neighbour
  std::vector<std::size_t> read_;    // doubles taken from each neighbour's answers
  std::vector<Deposit> deposits_;
  std::vector<Extraction> extractions_;
  std::vector<std::int32_t> given_, taken_, touched_;  // cells
  CellList small_, completed_;
  ExchangeCounters counters_;
  double kernel_seconds_ = 0;
  std::vector<double> volume_of_cell_;
};

}  // namespace cobasis
