// Absent phases at no cost: small volumes of a phase change places with equal volumes of the other phase in a neighbour
// that has more of it. Conserves every phase, leaves intensive values untouched, and moves slow fronts exactly. What is
// missing of a phase, a negative volume, goes to such a neighbour with as much of the cell's own other phase.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "mesh/mesh.hpp"
#include "mesh/neighbour_exchange.hpp"
#include "solver/faces.hpp"
#include "solver/field.hpp"
#include "solver/keeper.hpp"

namespace cobasis {

/// What has been exchanged so far on this rank.
struct ExchangeCounters {
  std::int64_t exchanges = 0;
  std::int64_t kept = 0;  ///< small volumes that found no partner and stayed, summed over steps
  std::int64_t dust = 0;  ///< volumes too small to matter whose content went to a neighbour without volume
};

/// What a phase has in a cell in total: mass, momentum, energy [kg, kg m/s, J], and volume times cobasis [m^3].
using Content = std::array<double, Layout<Space, Kind::solid>::n_conserved>;

/// Volume fractions below 0.1 dt sum of A |u_n| / (2 V) are small, but this threshold keeps within bounds.
struct ExchangeThresholds {
  double smallest, largest;
};
/// Where interfaces are diffuse, larger values would sharpen them, but make staircases of oblique ones.
inline constexpr ExchangeThresholds diffuse_exchange{1e-9, 1e-3};
/// Where they are planes in cells, a small volume is the tip of a phase that lies in the neighbour.
inline constexpr ExchangeThresholds sharp_exchange{1e-8, 3e-2};

/// What is less of a cell is dust anywhere.
inline constexpr double dust_threshold = 1e-11;

class VolumeExchange {
 public:
  VolumeExchange(const Mpi& mpi, const Mesh& mesh, const Fields& fields,
                 const ExchangeThresholds& thresholds = diffuse_exchange);

  /// Whether phase k belongs in the cell in the small quantity in which it is there; then it may stay.
  using Expected = std::function<bool(std::int32_t cell, int k)>;

  /// After a full step. `candidates`: owned cells, ascending, among them all with several phases. `forced`: (cell,
  /// phase) fragments to be exchanged whatever their size, ascending. Collective. Returns the owned cells that were
  /// touched, ascending.
  const std::vector<std::int32_t>& run(const Mesh& mesh, const Faces& faces, Fields& fields, double dt,
                                       std::span<const std::int32_t> candidates,
                                       const std::vector<std::pair<std::int32_t, int>>& forced,
                                       const Expected& expected = {});

  double kernel_seconds() const { return kernel_seconds_; }  ///< spent in loops over packs so far
  const ExchangeCounters& counters() const { return counters_; }
  /// Volume that each owned cell has got rid of so far [m^3].
  const std::vector<double>& volume_of_cell() const { return volume_of_cell_; }
  void keep(Keeper& keeper);  ///< these and the counters

 private:
  enum class Answer { refused, granted, dust };
  /// Phase k of cell asks the donor to take it, for an equal volume of phase j; of a negative volume of k, to take it
  /// with an equal volume of the cell's own phase j, which leaves the donor as much less of k.
  struct Request {
    std::int64_t from_id;
    std::int32_t cell, donor;
    int k, j;
    double volume, alpha;
    bool dust_only;
    int neighbour;  // who asks (received) or is asked (sent); -1: this rank itself
    int position;   // among the requests of that neighbour
    Answer answer;
    int content;  // received from another rank: where in contents_; else -1

    bool negative() const { return volume < 0; }
    int drawn() const { return negative() ? k : j; }  // the phase that the donor gets less of
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

  void find_small(const Fields& fields, std::span<const std::int32_t> candidates,
                  const std::vector<std::pair<std::int32_t, int>>& forced);
  void ask(const Mesh& mesh, const Faces& faces, const Fields& fields, double dt,
           std::span<const std::int32_t> candidates, const std::vector<std::pair<std::int32_t, int>>& forced,
           const Expected& expected);
  void request(const Mesh& mesh, const Faces& faces, const Fields& fields, std::int32_t cell, int k, bool forced,
               bool planes);
  void deliver(const Mesh& mesh, const Fields& fields);
  void serve(const Mesh& mesh, const Fields& fields);
  void collect_answers(const Mesh& mesh, const Fields& fields);
  void settle(const Mesh& mesh, const Request& request, Answer answer, const Content& content);
  void apply(Fields& fields);
  Content content_of(const Fields& fields, int k, std::int32_t cell) const;
  Content part_of(const Fields& fields, int k, std::int32_t cell, double volume) const;
  double promised(std::int32_t cell, int k) const;
  /// Whether so much of what is available may be given by a cell of volume V: what stays is no remainder of round-off.
  static bool has(double available, double given, double V) { return available >= given + least_rest * V; }
  static constexpr double least_rest = 1e-6;  ///< volume fraction

  ExchangeThresholds thresholds_;
  double least_to_give_;
  NeighbourExchange alpha_, requests_out_, answers_;
  std::vector<std::int32_t> neighbour_of_halo_;
  std::vector<Request> asked_, received_;
  std::vector<Content> contents_;    // of requests from other ranks: first what comes, then what is given for it; of a
                                     // negative volume what comes of k, then what comes of j
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
