#include "app/study_convergence.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace cobasis {
namespace {

constexpr double observed_factor = 1.25;
constexpr double feigned_factor = 2;
constexpr double assumed_factor = 3;
constexpr double round_off = 1e-10;  // what is left of 1e-16 after thousands of steps

/// (h1^p - h2^p) / (h2^p - h3^p) for p of either sign, with a = ln(h1 / h2), b = ln(h2 / h3); rises with p.
double ratio_of_differences(double p, double a, double b) {
  return p == 0 ? a / b : std::expm1(p * a) / -std::expm1(-p * b);
}

/// The p of this ratio of differences, by bisection between orders far from any that is seen.
double order_of(double ratio, double a, double b) {
  double low = -30, high = 30;
  for (int i = 0; i < 100; ++i) {
    const double p = 0.5 * (low + high);
    (ratio_of_differences(p, a, b) < ratio ? low : high) = p;
  }
  return 0.5 * (low + high);
}

/// From mesh to mesh of three: values, and logarithms of the ratios of sizes.
struct Differences {
  double before, last, a, b;
  double order() const { return order_of(before / last, a, b); }
};

Differences differences(std::span<const double> h, std::span<const double> f) {
  const Differences found{f[0] - f[1], f[1] - f[2], std::log(h[0] / h[1]), std::log(h[1] / h[2])};
  assert(found.a > 0 && found.b > 0);
  return found;
}

}  // namespace

std::string_view describe(Trend trend) {
  switch (trend) {
    case Trend::asymptotic:
      return "converging";
    case Trend::same:
      return "the same on all meshes";
    case Trend::fast:
      return "not in the asymptotic range: faster than order 3";
    case Trend::slow:
      return "not in the asymptotic range: slower than order 1/2";
    case Trend::growing:
      return "not in the asymptotic range: differences grow";
    case Trend::oscillating:
      return "not in the asymptotic range: oscillating";
    case Trend::none:
      break;
  }
  return "no value on some mesh";
}

Convergence converge(std::span<const double> h, std::span<const double> values, double scale) {
  assert(h.size() == values.size() && h.size() >= 3);
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  if (!std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); }))
    return {Trend::none, nothing, nothing, {}, 1};
  const auto [least, largest] = std::minmax_element(values.begin(), values.end());
  const double noise = round_off * std::max({std::fabs(*least), std::fabs(*largest), scale});
  const double finest = values.back();
  if (*largest - *least <= noise) return {Trend::same, finest, noise, {}, 1};

  const Differences now = differences(h.last(3), values.last(3));
  const double span = std::fabs(now.before + now.last);
  // Of two differences one of which is noise, a sign or a ratio tells nothing.
  if (std::fabs(now.last) <= noise) return {Trend::fast, finest, observed_factor * span + noise, {}, 1};
  if (now.before * now.last <= 0) return {Trend::oscillating, finest, assumed_factor * (*largest - *least), {}, 1};

  const double order = now.order();
  const auto distance = [&](double p) { return std::fabs(now.last) / std::expm1(p * now.b); };
  if (order < least_order)
    return {order < 0 ? Trend::growing : Trend::slow, finest, assumed_factor * distance(least_order), order,
            least_order};
  if (order > largest_order)
    return {Trend::fast, finest, std::max(assumed_factor * distance(1), observed_factor * span), order, 1};

  bool confirmed = false;
  if (h.size() > 3) {
    const Differences former = differences(h.last(4).first(3), values.last(4).first(3));
    confirmed = former.before * former.last > 0 && std::fabs(former.order() - order) < 0.1 * order;
  }
  const double error = confirmed ? observed_factor * distance(order) : feigned_factor * distance(std::min(order, 1.0));
  return {Trend::asymptotic, finest - now.last / std::expm1(order * now.b), error, order, order};
}

std::optional<double> refinement_for(const Convergence& convergence, double accuracy) {
  const double wanted = accuracy * std::fabs(convergence.value);
  if (!(wanted > 0) || !std::isfinite(convergence.error)) return std::nullopt;
  return std::pow(convergence.error / wanted, 1 / convergence.falls_with);
}

}  // namespace cobasis
