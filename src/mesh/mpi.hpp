// The ranks of a run. The only door to MPI beside neighbour_exchange; without mpirun it is one rank.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace cobasis {

class Mpi {
 public:
  Mpi(int& argc, char**& argv);  ///< all ranks; MPI_Init, unless that was done
  explicit Mpi(MPI_Comm comm);   ///< the ranks of a communicator, which stays its owner's
  ~Mpi();                        ///< MPI_Finalize by whom it was initialised
  Mpi(const Mpi&) = delete;
  Mpi& operator=(const Mpi&) = delete;

  int rank() const { return rank_; }
  int size() const { return size_; }
  bool root() const { return rank_ == 0; }
  MPI_Comm comm() const { return comm_; }

  double min(double x) const;
  double max(double x) const;
  std::int64_t sum(std::int64_t x) const;
  bool any(bool x) const;
  void barrier() const;

  /// The sum over all ranks of all values, independent of their order and of their distribution over ranks: every value
  /// is cut to a multiple of about 2^-90 of the largest magnitude and summed in integers.
  double exact_sum(std::span<const double> values) const;

  /// All ranks' values on rank 0, concatenated by rank (empty elsewhere).
  std::vector<double> gather(std::span<const double> values) const;
  std::vector<std::int64_t> gather(std::span<const std::int64_t> values) const;

  void broadcast(std::vector<char>& bytes) const;  ///< from rank 0
  void broadcast(std::string& text) const;         ///< from rank 0
  void send(int rank, const std::vector<char>& bytes) const;
  std::vector<char> receive(int rank) const;
  [[noreturn]] void abort(int status) const;

 private:
  MPI_Comm comm_ = MPI_COMM_WORLD;
  bool finalizes_ = false;
  int rank_ = 0;
  int size_ = 1;
};

}  // namespace cobasis
