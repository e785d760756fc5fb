// How far a run is, for whoever watches it.
#pragma once

#include <cstdint>
#include <ostream>
#include <string>

namespace cobasis {

struct ProgressState {
  double time = 0;      ///< simulated [s]
  double end_time = 0;  ///< [s]
  std::int64_t step = 0;
  double seconds = 0;                                   ///< since the start of the run
  double nanoseconds_per_cell_equation_evaluation = 0;  ///< 0: not known yet
};

/// Percent, simulated time, step, time left and cost; with a bar if the width [characters] leaves room for one. At most
/// `width` characters; width 0: no bar, no limit.
std::string progress_line(const ProgressState& state, int width);

enum class ProgressStyle { silent, lines, bar };

/// silent if quiet, else bar if standard output is a terminal and no mpirun stands between.
ProgressStyle progress_style(bool quiet);

/// A bar refreshed in place at most five times a second, or a plain line per 5 % of the run or 10 s, whichever is
/// later.
class Progress {
 public:
  Progress(std::ostream& out, ProgressStyle style) : out_(out), style_(style) {}

  void update(const ProgressState& state);
  void finish(const ProgressState& state);  ///< the last state, shown at any rate

 private:
  void show(const ProgressState& state, bool last);

  std::ostream& out_;
  ProgressStyle style_;
  double shown_seconds_ = 0;
  double shown_time_ = 0;  ///< simulated
};

}  // namespace cobasis
