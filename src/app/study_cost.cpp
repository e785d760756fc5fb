#include "app/study_cost.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace cobasis {
namespace {

constexpr double rows_per_run = 1000;  // without history_every

template <class Value>
std::vector<double> column(const std::vector<MeasuredRun>& runs, const Value& value) {
  std::vector<double> values;
  for (const MeasuredRun& run : runs) values.push_back(value(run));
  return values;
}

double per_event(double seconds, double events) { return events > 0 ? seconds / events : 0; }

}  // namespace

LinearCost fit_cost(std::span<const double> cells, std::span<const double> seconds) {
  assert(cells.size() == seconds.size() && !cells.empty());
  // minimise sum (a u_i + b v_i - 1)^2 with u = 1 / t, v = N / t
  double uu = 0, uv = 0, vv = 0, u1 = 0, v1 = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (!(seconds[i] > 0)) continue;
    const double u = 1 / seconds[i], v = cells[i] / seconds[i];
    uu += u * u;
    uv += u * v;
    vv += v * v;
    u1 += u;
    v1 += v;
  }
  const double determinant = uu * vv - uv * uv;
  if (determinant > 1e-9 * uu * vv) {
    const LinearCost fitted{(u1 * vv - v1 * uv) / determinant, (v1 * uu - u1 * uv) / determinant};
    if (fitted.fixed < 0) return {0, v1 / vv};
    if (fitted.per_cell > 0) return fitted;
  }
  return {0.5 * seconds.back(), 0.5 * seconds.back() / cells.back()};
}

double extrapolate(std::span<const double> h, std::span<const double> y, double at, double power) {
  assert(h.size() == y.size() && !h.empty());
  const std::size_t last = h.size() - 1;
  if (last > 0) power = std::log(y[last] / y[last - 1]) / std::log(h[last - 1] / h[last]);
  return y[last] * std::pow(h[last] / at, power);
}

CostModel::CostModel(std::vector<MeasuredRun> runs, std::optional<std::int64_t> history_every)
    : runs_(std::move(runs)), history_every_(history_every) {
  const auto cells = column(runs_, [](const MeasuredRun& run) { return run.size.cells; });
  step_ = fit_cost(cells,
                   column(runs_, [](const MeasuredRun& run) { return per_event(run.seconds.steps, run.size.steps); }));
  row_ = fit_cost(cells,
                  column(runs_, [](const MeasuredRun& run) { return per_event(run.seconds.history, run.size.rows); }));
  other_ = fit_cost(cells, column(runs_, [](const MeasuredRun& run) { return run.seconds.other; }));
}

RunSize CostModel::size(double h, std::optional<double> cells) const {
  const auto sizes = column(runs_, [](const MeasuredRun& run) { return run.h; });
  const auto extrapolated = [&](auto value, double power) {
    return extrapolate(sizes, column(runs_, value), h, power);
  };
  RunSize size;
  size.cells = cells ? *cells : extrapolated([](const MeasuredRun& run) { return run.size.cells; }, 1);
  size.steps = extrapolated([](const MeasuredRun& run) { return run.size.steps; }, 1);
  size.rows = history_every_ ? size.steps / static_cast<double>(*history_every_) : std::min(size.steps, rows_per_run);
  return size;
}

double CostModel::seconds(const RunSize& size) const {
  return size.steps * step_(size.cells) + size.rows * row_(size.cells) + other_(size.cells);
}

}  // namespace cobasis
