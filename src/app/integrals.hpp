// Numbers that say where a phase is, how far it reaches, within what radius most of it lies; and means of fields.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/mesh.hpp"
#include "mesh/mpi.hpp"
#include "mesh/neighbour_exchange.hpp"
#include "solver/setup.hpp"
#include "solver/snapshot.hpp"

namespace cobasis {

/// The coordinate along the axis; radial: distance from the z axis in space, from the x axis in a plane.
double coordinate(const Point& x, Axis axis, Geometry geometry);

/// All [[integral]]s of a case. The same bits for any number of ranks.
class Integrals {
 public:
  /// `phases`: for means of the mixture's fields. Collective. Throws InputError, on all ranks together, for a region
  /// without cells.
  Integrals(std::vector<IntegralSetup> setups, Geometry geometry, const Mesh& mesh, const Mpi& mpi,
            std::vector<PhaseSetup> phases = {});

  /// Collective; per integral, on every rank, in its unit. NaN: alpha reaches the value nowhere, or there is no such
  /// phase left. Means need a snapshot with all fields, the others alpha.
  std::vector<double> evaluate(const Snapshot& snapshot);

 private:
  /// This rank's cells in the region of a mean or an extent, and their volumes in it.
  struct Region {
    std::vector<std::int32_t> cells;
    std::vector<double> volumes;
  };
  Region region_of(const IntegralSetup& setup) const;
  std::vector<double> alpha_with_halo(const Snapshot& snapshot, int phase);
  double evaluate(const Extent& extent, const std::vector<double>& alpha) const;
  double evaluate(const Quantile& quantile, const std::vector<double>& alpha) const;
  double evaluate(const Mean& mean, const Region& region, const Snapshot& snapshot) const;

  std::vector<IntegralSetup> setups_;
  Geometry geometry_;
  const Mesh& mesh_;
  const Mpi& mpi_;
  NeighbourExchange exchange_;
  std::vector<PhaseSetup> phases_;
  std::vector<Region> regions_;  ///< one per integral; empty where it has none
};

}  // namespace cobasis
