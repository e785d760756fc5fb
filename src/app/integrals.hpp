// Numbers that say where a phase is: how far it reaches, within what radius most of it lies.
#pragma once

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
  Integrals(std::vector<IntegralSetup> setups, Geometry geometry, const Mesh& mesh, const Mpi& mpi);

  /// Collective; per integral, on every rank [m]. NaN: alpha reaches the value nowhere, or there is no such phase left.
  std::vector<double> evaluate(const Snapshot& snapshot);

 private:
  std::vector<double> alpha_with_halo(const Snapshot& snapshot, int phase);
  double evaluate(const Extent& extent, const std::vector<double>& alpha) const;
  double evaluate(const Quantile& quantile, const std::vector<double>& alpha) const;

  std::vector<IntegralSetup> setups_;
  Geometry geometry_;
  const Mesh& mesh_;
  const Mpi& mpi_;
  NeighbourExchange exchange_;
};

}  // namespace cobasis
