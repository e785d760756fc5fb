// What runs cost, learnt from some and foretold of others.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace cobasis {

/// What of a run the cost depends on.
struct RunSize {
  double cells = 0;
  double steps = 0;
  double rows = 0;  ///< of the history
};

/// Wall-clock seconds of a run.
struct RunSeconds {
  double steps = 0;    ///< of all steps
  double history = 0;  ///< of all rows of the history
  double other = 0;    ///< mesh, initial state, outputs

  double total() const { return steps + history + other; }
};

struct MeasuredRun {
  double h = 0;  ///< size of the cells, in any unit
  RunSize size;
  RunSeconds seconds;
};

/// fixed + per_cell · cells, neither negative.
struct LinearCost {
  double fixed = 0, per_cell = 0;
  double operator()(double cells) const { return fixed + per_cell * cells; }
};

/// Least squares of the relative differences. One point, or times that do not grow with the cells, tell nothing of the
/// two terms: then each is half of the last time.
LinearCost fit_cost(std::span<const double> cells, std::span<const double> seconds);

/// The number y(h) = y_last (h_last / h)^q, with q from the two last of the points; q = `power` if there is only one.
double extrapolate(std::span<const double> h, std::span<const double> y, double at, double power);

/// Of runs of one case, coarse to fine; at least one. Each step, and each row of the history, costs a fixed time and
/// one per cell; the rest of the run likewise.
class CostModel {
 public:
  CostModel(std::vector<MeasuredRun> runs, std::optional<std::int64_t> history_every);

  /// Cells, steps and rows with cells of size h; `cells` where they are known.
  RunSize size(double h, std::optional<double> cells = {}) const;
  /// Wall-clock seconds of such a run.
  double seconds(const RunSize& size) const;

 private:
  std::vector<MeasuredRun> runs_;
  std::optional<std::int64_t> history_every_;
  LinearCost step_, row_, other_;
};

}  // namespace cobasis
