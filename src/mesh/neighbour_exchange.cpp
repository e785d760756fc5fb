#include "mesh/neighbour_exchange.hpp"

#include <algorithm>
#include <cassert>

namespace cobasis {

std::vector<std::size_t> halo_capacities(const std::vector<Neighbour>& neighbours, std::size_t per_cell) {
  std::vector<std::size_t> values;
  for (const Neighbour& n : neighbours) values.push_back(per_cell * n.receive_count);
  return values;
}

NeighbourExchange::NeighbourExchange(const Mpi& mpi, const std::vector<Neighbour>& neighbours,
                                     std::vector<std::size_t> max_values, int tag)
    : comm_(mpi.comm()),
      tag_(tag),
      outgoing_(neighbours.size()),
      incoming_(neighbours.size()),
      received_(neighbours.size()),
      requests_(2 * neighbours.size(), MPI_REQUEST_NULL),
      statuses_(2 * neighbours.size()) {
  assert(max_values.size() == neighbours.size());
  for (std::size_t n = 0; n < neighbours.size(); ++n) {
    ranks_.push_back(neighbours[n].rank);
    incoming_[n].resize(max_values[n]);
    const auto cells = static_cast<std::size_t>(std::max(neighbours[n].receive_count, 1));
    outgoing_[n].reserve((max_values[n] + cells - 1) / cells * neighbours[n].send.size());
  }
}

NeighbourExchange::~NeighbourExchange() {
  // Only an exception between start() and finish() leaves requests open: the buffers must not be written any more.
  for (MPI_Request& request : requests_) {
    if (request == MPI_REQUEST_NULL) continue;
    MPI_Cancel(&request);
    MPI_Request_free(&request);
  }
}

std::vector<double>& NeighbourExchange::outgoing(std::size_t neighbour) { return outgoing_[neighbour]; }

void NeighbourExchange::start() {
  const std::size_t size = ranks_.size();
  for (std::size_t n = 0; n < size; ++n)
    MPI_Irecv(incoming_[n].data(), static_cast<int>(incoming_[n].size()), MPI_DOUBLE, ranks_[n], tag_, comm_,
              &requests_[n]);
  for (std::size_t n = 0; n < size; ++n)
    MPI_Isend(outgoing_[n].data(), static_cast<int>(outgoing_[n].size()), MPI_DOUBLE, ranks_[n], tag_, comm_,
              &requests_[size + n]);
}

void NeighbourExchange::finish() {
  MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), statuses_.data());
  for (std::size_t n = 0; n < ranks_.size(); ++n) {
    int count = 0;
    MPI_Get_count(&statuses_[n], MPI_DOUBLE, &count);
    received_[n] = count;
  }
}

std::span<const double> NeighbourExchange::incoming(std::size_t neighbour) const {
  return {incoming_[neighbour].data(), received_[neighbour]};
}

}  // namespace cobasis
