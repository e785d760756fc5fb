// Non-blocking messages of varying length between ranks that share faces. Buffers keep their capacity: no allocation
// in steady state.
#pragma once

#include <span>
#include <vector>

#include "mesh/mesh.hpp"
#include "mesh/mpi.hpp"

namespace cobasis {

class NeighbourExchange {
 public:
  /// `max_values[n]`: the most doubles that may come from neighbour n in one message; `tag` tells exchanges apart.
  NeighbourExchange(const Mpi& mpi, const std::vector<Neighbour>& neighbours, std::vector<std::size_t> max_values,
                    int tag);
  ~NeighbourExchange();
  NeighbourExchange(NeighbourExchange&&) = default;

  std::vector<double>& outgoing(std::size_t neighbour);           ///< fill before start()
  void start();                                                   ///< post receives, send what is in outgoing
  void finish();                                                  ///< wait for all
  std::span<const double> incoming(std::size_t neighbour) const;  ///< after finish()

 private:
  MPI_Comm comm_;
  int tag_;
  std::vector<int> ranks_;
  std::vector<std::vector<double>> outgoing_, incoming_;
  std::vector<std::size_t> received_;
  std::vector<MPI_Request> requests_;
  std::vector<MPI_Status> statuses_;
};

}  // namespace cobasis
