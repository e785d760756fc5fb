#include "math/pack.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

using namespace cobasis;

namespace {

constexpr int n = 64 * pack_width;

/// Numbers of all magnitudes and both signs, zeros and equal pairs among them.
std::vector<double> numbers(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> exponent(-250, 250), sign(-1, 1);
  std::vector<double> x(n);
  for (double& value : x) value = std::copysign(std::pow(10, exponent(random)), sign(random));
  for (int i = 0; i < n; i += 7) x[i] = 0;
  for (int i = 3; i < n; i += 11) x[i] = 1;
  return x;
}

bool same_bits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

/// `f` works on packs and doubles alike.
template <class F>
void check_lanes(F&& f) {
  const std::vector<double> x = numbers(1), y = numbers(2);
  for (int i = 0; i < n; i += pack_width) {
    const Pack result = f(load<Pack>(&x[i]), load<Pack>(&y[i]));
    for (int j = 0; j < pack_width; ++j) {
      CAPTURE(x[i + j], y[i + j]);
      CHECK(same_bits(lane(result, j), f(x[i + j], y[i + j])));
    }
  }
}

}  // namespace

TEST_CASE("arithmetic of packs is that of doubles, lane by lane, to the last bit") {
  check_lanes([](const auto& x, const auto& y) { return x + y; });
  check_lanes([](const auto& x, const auto& y) { return x - y; });
  check_lanes([](const auto& x, const auto& y) { return x * y; });
  check_lanes([](const auto& x, const auto& y) { return magnitude(x) / (magnitude(y) + 1.0); });
  check_lanes([](const auto& x, const auto& y) { return -x * 0.5 + 2.0 * y - 1.0; });
}

TEST_CASE("smaller, larger, magnitude and square root of packs are those of doubles, lane by lane") {
  check_lanes([](const auto& x, const auto& y) { return smaller(x, y); });
  check_lanes([](const auto& x, const auto& y) { return larger(x, y); });
  check_lanes([](const auto& x, const auto&) { return magnitude(x); });
  check_lanes([](const auto& x, const auto&) { return square_root(magnitude(x)); });
}

TEST_CASE("select takes each lane by its own mask, and any sees a single lane") {
  check_lanes([](const auto& x, const auto& y) { return select(x > y, x, y); });
  check_lanes([](const auto& x, const auto& y) {
    using Real = std::remove_cvref_t<decltype(x)>;
    return select(x >= Real(0.0) && !(y < Real(0.0)), x, Real(-1.0));
  });
  for (int j = 0; j < pack_width; ++j) {
    std::array<double, pack_width> values{};
    CHECK_FALSE(any(load<Pack>(values.data()) > Pack(0.0)));
    values[j] = 1;
    const Pack::mask_type mask = load<Pack>(values.data()) > Pack(0.0);
    CHECK(any(mask));
    for (int i = 0; i < pack_width; ++i) CHECK(lane(mask, i) == (i == j));
  }
}

TEST_CASE("gather and scatter reach the places that the indices name") {
  std::mt19937 random(3);
  std::vector<double> from(1000);
  std::iota(from.begin(), from.end(), 0.5);
  std::vector<std::int32_t> places(from.size());
  std::iota(places.begin(), places.end(), 0);
  for (int round = 0; round < 50; ++round) {
    std::shuffle(places.begin(), places.end(), random);
    Indices<Pack> at;
    std::copy_n(places.begin(), pack_width, at.begin());
    const Pack values = gather<Pack>(from.data(), at);
    std::vector<double> to(from.size(), -1.0);
    scatter(values, to.data(), at);
    for (int j = 0; j < pack_width; ++j) {
      CHECK(lane(values, j) == from[at[j]]);
      CHECK(to[at[j]] == from[at[j]]);
    }
    CHECK(std::count(to.begin(), to.end(), -1.0) == static_cast<int>(to.size()) - pack_width);
  }
  Indices<Pack> everywhere;
  everywhere.fill(17);
  CHECK(lane(gather<Pack>(from.data(), everywhere), pack_width - 1) == from[17]);
  std::vector<double> to(20, 0.0);
  scatter(Pack(3.0), to.data(), everywhere);  // a list's last entry fills its last pack
  CHECK(to[17] == 3);
  CHECK(gather<double>(from.data(), {42}) == from[42]);
}

TEST_CASE("load and store of a pack keep the order") {
  std::vector<double> from(pack_width + 1), to(pack_width + 1, 0.0);
  std::iota(from.begin(), from.end(), 1.0);
  store(load<Pack>(&from[1]), &to[1]);  // not aligned
  for (int i = 1; i <= pack_width; ++i) CHECK(to[i] == from[i]);
  CHECK(to[0] == 0);
}

TEST_CASE("chosen lanes are written one after the other, in order") {
  for (unsigned bits = 0; bits < (1u << pack_width); ++bits) {
    std::array<double, pack_width> x;
    Indices<Pack> index;
    for (int i = 0; i < pack_width; ++i) x[i] = bits >> i & 1 ? i + 1 : -(i % 2), index[i] = 100 + i;
    const Pack pack = load<Pack>(x.data());
    REQUIRE(positive_lanes(pack) == bits);
    std::array<double, pack_width> out;
    std::array<std::int32_t, pack_width> places;
    store_chosen(bits, pack, out.data());
    store_chosen(bits, index, places.data());
    int next = 0;
    for (int i = 0; i < pack_width; ++i) {
      if (!(bits >> i & 1)) continue;
      CHECK(out[next] == i + 1);
      CHECK(places[next] == 100 + i);
      ++next;
    }
  }
  CHECK(positive_lanes(Pack(std::numeric_limits<double>::quiet_NaN())) == 0);
}

TEST_CASE("the cube root has a relative error below 1e-15 from 1e-300 to 1e300, alike in packs and doubles") {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> exponent(-300, 300);
  std::vector<double> x(200 * pack_width);
  for (double& value : x) value = std::pow(10, exponent(random));
  x[0] = 1, x[1] = 8, x[2] = 27, x[3] = 1e-300, x[4] = 1e300, x[5] = std::nextafter(1, 0), x[6] = 1 + 1e-15;
  for (std::size_t i = 0; i < x.size(); i += pack_width) {
    const Pack roots = cube_root(load<Pack>(&x[i]));
    for (int j = 0; j < pack_width; ++j) {
      CAPTURE(x[i + j]);
      const double root = cube_root(x[i + j]), exact = std::cbrt(x[i + j]);
      CHECK(same_bits(lane(roots, j), root));
      CHECK(std::fabs(root - exact) < 1e-15 * exact);
    }
  }
  CHECK(cube_root(1.0) == 1);
}
