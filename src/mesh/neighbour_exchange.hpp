// Non-blocking messages of varying length between ranks that share faces. Buffers keep their capacity: no allocation
// in steady state.
#pragma once

#include <span>
#include <vector>

#include "mesh/mesh.hpp"
#include "mesh/mpi.hpp"

namespace cobasis {

/// The most values that may come from each neighbour, of its halo cells.
std::vector<std::size_t> halo_capacities(const std::vector<Neighbour>& neighbours, std::size_t per_cell);

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

/// Halo cells learn numbers of their owners. visit(cell, with) calls with(number) for each of a cell: it is sent for
/// an owned cell, overwritten for a halo cell. Which come next may depend on those before.
template <class Visit>
void send_cells(NeighbourExchange& exchange, const std::vector<Neighbour>& neighbours, const Visit& visit) {
  for (std::size_t n = 0; n < neighbours.size(); ++n) {
    std::vector<double>& out = exchange.outgoing(n);
    out.clear();
    for (const std::int32_t cell : neighbours[n].send)
      visit(cell, [&](const auto& number) { out.push_back(static_cast<double>(number)); });
  }
  exchange.start();
}
template <class Visit>
void receive_cells(NeighbourExchange& exchange, const std::vector<Neighbour>& neighbours, const Visit& visit) {
  exchange.finish();
  for (std::size_t n = 0; n < neighbours.size(); ++n) {
    const double* in = exchange.incoming(n).data();
    for (std::int32_t i = 0; i < neighbours[n].receive_count; ++i)
      visit(neighbours[n].receive_first + i,
            [&]<class Number>(Number& number) { number = static_cast<Number>(*in++); });
  }
}
template <class Visit>
void exchange_cells(NeighbourExchange& exchange, const std::vector<Neighbour>& neighbours, const Visit& visit) {
  send_cells(exchange, neighbours, visit);
  receive_cells(exchange, neighbours, visit);
}

}  // namespace cobasis
