#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <random>

#include "mesh/mpi.hpp"

using namespace cobasis;

namespace {

const Mpi& mpi() {
  static int argc = 0;
  static char** argv = nullptr;
  static const Mpi ranks(argc, argv);
  return ranks;
}

}  // namespace

TEST_CASE("exact_sum has the same bits for any distribution of the values") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> mantissa(-1, 1);
  std::vector<double> values;  // the same on all ranks
  for (int i = 0; i < 3000; ++i) values.push_back(std::ldexp(mantissa(random), static_cast<int>(random() % 60)));
  const auto sum_of = [&](auto owner) {
    std::vector<double> mine;
    for (std::size_t i = 0; i < values.size(); ++i)
      if (owner(i) == mpi().rank()) mine.push_back(values[i]);
    return mpi().exact_sum(mine);
  };
  const double reference = sum_of([](std::size_t) { return 0; });
  CHECK(std::abs(reference) > 1);
  CHECK(sum_of([](std::size_t) { return mpi().size() - 1; }) == reference);
  CHECK(sum_of([](std::size_t i) { return static_cast<int>(i % mpi().size()); }) == reference);
  CHECK(sum_of([](std::size_t i) { return static_cast<int>(std::mt19937(i)() % mpi().size()); }) == reference);
  const double naive = std::accumulate(values.begin(), values.end(), 0.0);
  CHECK(reference == Approx(naive).epsilon(1e-9));
}

TEST_CASE("a value that is not finite on one rank makes the exact sum NaN on all") {
  const std::vector<double> mine{mpi().rank() == mpi().size() - 1 ? std::nan("") : 1.0};
  CHECK(std::isnan(mpi().exact_sum(mine)));
}

TEST_CASE("collectives combine all ranks") {
  const int rank = mpi().rank(), size = mpi().size();
  CHECK(mpi().min(rank) == 0);
  CHECK(mpi().max(rank) == size - 1);
  CHECK(mpi().sum(1) == size);
  CHECK(mpi().any(rank == size - 1));
  CHECK_FALSE(mpi().any(false));
  const std::vector<std::int64_t> mine(rank, rank);  // rank 0 gives nothing
  const std::vector<std::int64_t> all = mpi().gather(std::span(mine));
  if (mpi().root()) {
    CHECK(std::ssize(all) == size * (size - 1) / 2);
    CHECK(std::is_sorted(all.begin(), all.end()));
  } else {
    CHECK(all.empty());
  }
  std::string text = mpi().root() ? "from the root" : "";
  mpi().broadcast(text);
  CHECK(text == "from the root");
}
