#include <algorithm>
#include <limits>
#include <random>

#include "mesh_files.hpp"

using namespace cobasis;

TEST_CASE("exact_sum does not depend on order and does not lose small terms") {
  const Mpi& mpi = test_mpi();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> mantissa(-1, 1);
  std::uniform_int_distribution<int> exponent(-60, 20);
  std::vector<double> values;
  for (int i = 0; i < 1000; ++i) values.push_back(std::ldexp(mantissa(random), exponent(random)));
  const double sum = mpi.exact_sum(values);
  long double reference = 0;
  for (const double x : values) reference += x;
  CHECK(sum == Approx(static_cast<double>(reference)).epsilon(1e-14));
  for (int i = 0; i < 5; ++i) {
    std::shuffle(values.begin(), values.end(), random);
    CHECK(mpi.exact_sum(values) == sum);
  }
  const std::vector<double> cancel{1e16, 1, -1e16};
  CHECK(mpi.exact_sum(cancel) == 1);
}

TEST_CASE("exact_sum of nothing, zeros, one value and extremes") {
  const Mpi& mpi = test_mpi();
  const auto sum = [&](std::vector<double> values) { return mpi.exact_sum(values); };
  CHECK(sum({}) == 0);
  CHECK(sum({0, -0.0}) == 0);
  for (const double x : {0.1, -3e300, 5e-324, 1e-310, std::numeric_limits<double>::max()}) CHECK(sum({x}) == x);
  CHECK(sum({5e-324, 5e-324}) == 1e-323);
  CHECK(std::isnan(sum({1, std::numeric_limits<double>::quiet_NaN()})));
  CHECK(std::isnan(sum({1, std::numeric_limits<double>::infinity()})));
}
