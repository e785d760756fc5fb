#include "mesh/mpi.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace cobasis {
namespace {

constexpr std::int64_t chunk = 1 << 30;  // MPI counts are int

template <class T>
std::vector<T> gather_values(std::span<const T> values, MPI_Datatype type, MPI_Comm comm, int rank, int size) {
  const int count = static_cast<int>(values.size());
  std::vector<int> counts(rank == 0 ? size : 0), starts(counts.size());
  MPI_Gather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, comm);
  int total = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    starts[i] = total;
    total += counts[i];
  }
  std::vector<T> all(total);
  MPI_Gatherv(values.data(), count, type, all.data(), counts.data(), starts.data(), type, 0, comm);
  return all;
}

}  // namespace

Mpi::Mpi(int& argc, char**& argv) {
  int initialized = 0;
  MPI_Initialized(&initialized);
  if (!initialized) MPI_Init(&argc, &argv);
  finalizes_ = !initialized;
  MPI_Comm_rank(comm_, &rank_);
  MPI_Comm_size(comm_, &size_);
}

Mpi::Mpi(MPI_Comm comm) : comm_(comm) {
  MPI_Comm_rank(comm_, &rank_);
  MPI_Comm_size(comm_, &size_);
}

Mpi::~Mpi() {
  if (finalizes_) MPI_Finalize();
}

double Mpi::min(double x) const {
  MPI_Allreduce(MPI_IN_PLACE, &x, 1, MPI_DOUBLE, MPI_MIN, comm_);
  return x;
}

double Mpi::max(double x) const {
  MPI_Allreduce(MPI_IN_PLACE, &x, 1, MPI_DOUBLE, MPI_MAX, comm_);
  return x;
}

std::int64_t Mpi::sum(std::int64_t x) const {
  MPI_Allreduce(MPI_IN_PLACE, &x, 1, MPI_INT64_T, MPI_SUM, comm_);
  return x;
}

bool Mpi::any(bool x) const {
  int flag = x;
  MPI_Allreduce(MPI_IN_PLACE, &flag, 1, MPI_INT, MPI_LOR, comm_);
  return flag != 0;
}

void Mpi::barrier() const { MPI_Barrier(comm_); }

double Mpi::exact_sum(std::span<const double> values) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double largest = 0;  // infinity also stands for NaN, which MPI_MAX may drop
  for (const double x : values) largest = std::max(largest, std::isfinite(x) ? std::abs(x) : infinity);
  largest = max(largest);
  if (largest == 0) return 0;
  if (largest == infinity) return std::numeric_limits<double>::quiet_NaN();

  // Three limbs of 30 bits: each step of the splitting is exact, and 64-bit sums have room for 2^33 values.
  constexpr int limb_bits = 30;
  constexpr double limb = 1 << limb_bits;
  int exponent = 0;
  std::frexp(largest, &exponent);
  const int half = (limb_bits - exponent) / 2;  // in two factors: one may be beyond the range of double
  const double scale = std::ldexp(1.0, half), rest_of_scale = std::ldexp(1.0, limb_bits - exponent - half);
  std::array<std::int64_t, 3> limbs{};
  for (const double x : values) {
    double rest = x * scale * rest_of_scale;
    for (std::int64_t& sum : limbs) {
      const auto digits = static_cast<std::int64_t>(rest);
      sum += digits;
      rest = (rest - static_cast<double>(digits)) * limb;
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, limbs.data(), 3, MPI_INT64_T, MPI_SUM, comm_);
  __int128 total = 0;
  for (const std::int64_t sum : limbs) total = total * (std::int64_t{1} << limb_bits) + sum;
  return std::ldexp(static_cast<double>(total), exponent - 3 * limb_bits);
}

std::vector<double> Mpi::gather(std::span<const double> values) const {
  return gather_values(values, MPI_DOUBLE, comm_, rank_, size_);
}

std::vector<std::int64_t> Mpi::gather(std::span<const std::int64_t> values) const {
  return gather_values(values, MPI_INT64_T, comm_, rank_, size_);
}

void Mpi::broadcast(std::vector<char>& bytes) const {
  std::int64_t size = std::ssize(bytes);
  MPI_Bcast(&size, 1, MPI_INT64_T, 0, comm_);
  bytes.resize(size);
  for (std::int64_t at = 0; at < size; at += chunk)
    MPI_Bcast(bytes.data() + at, static_cast<int>(std::min(chunk, size - at)), MPI_CHAR, 0, comm_);
}

void Mpi::broadcast(std::string& text) const {
  std::vector<char> bytes(text.begin(), text.end());
  broadcast(bytes);
  text.assign(bytes.begin(), bytes.end());
}

void Mpi::send(int rank, const std::vector<char>& bytes) const {
  const std::int64_t size = std::ssize(bytes);
  MPI_Send(&size, 1, MPI_INT64_T, rank, 0, comm_);
  for (std::int64_t at = 0; at < size; at += chunk)
    MPI_Send(bytes.data() + at, static_cast<int>(std::min(chunk, size - at)), MPI_CHAR, rank, 0, comm_);
}

std::vector<char> Mpi::receive(int rank) const {
  std::int64_t size = 0;
  MPI_Recv(&size, 1, MPI_INT64_T, rank, 0, comm_, MPI_STATUS_IGNORE);
  std::vector<char> bytes(size);
  for (std::int64_t at = 0; at < size; at += chunk) {
    const int count = static_cast<int>(std::min(chunk, size - at));
    MPI_Recv(bytes.data() + at, count, MPI_CHAR, rank, 0, comm_, MPI_STATUS_IGNORE);
  }
  return bytes;
}

void Mpi::abort(int status) const {
  MPI_Abort(comm_, status);
  std::abort();
}

}  // namespace cobasis
