#include "app/progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace cobasis {
namespace {

constexpr double seconds_between_refreshes = 0.2;
constexpr double seconds_between_lines = 10;
constexpr double fraction_between_lines = 0.05;
constexpr int shortest_bar = 10;
constexpr int longest_bar = 40;

double fraction_of(const ProgressState& state) {
  return state.end_time > 0 ? std::clamp(state.time / state.end_time, 0.0, 1.0) : 0;
}

/// 0:07, 12:34, 1:02:03
std::string clock_time(double seconds) {
  const auto total = static_cast<std::int64_t>(std::ceil(seconds));
  const std::int64_t minutes = total / 60 % 60;
  if (total < 3600) return fmt::format("{}:{:02}", minutes, total % 60);
  return fmt::format("{}:{:02}:{:02}", total / 3600, minutes, total % 60);
}

int terminal_width() {
  winsize size{};
  return ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

}  // namespace

std::string progress_line(const ProgressState& state, int width) {
  const double fraction = fraction_of(state);
  // A run is at 100 % when it is over, not when that is what rounding gives.
  std::string text =
      fmt::format("{:3} %  t = {:.4g} s  step {}", static_cast<int>(100 * fraction), state.time, state.step);
  if (fraction > 0 && fraction < 1)
    text += fmt::format("  {} left", clock_time(state.seconds * (1 - fraction) / fraction));
  if (state.nanoseconds_per_cell_equation_evaluation > 0) {
    text += fmt::format("  {:.3g} ns/cell/eq", state.nanoseconds_per_cell_equation_evaluation);
  }
  if (width <= 0) return text;
  const int room = std::min(width - static_cast<int>(text.size()) - 3, longest_bar);
  if (room >= shortest_bar) {
    const auto done = static_cast<std::size_t>(fraction * room);
    const std::string bar = std::string(done, '#') + std::string(static_cast<std::size_t>(room) - done, '.');
    text = fmt::format("[{}] {}", bar, text);
  }
  return text.substr(0, static_cast<std::size_t>(width));
}

ProgressStyle progress_style(bool quiet) {
  if (quiet) return ProgressStyle::silent;
  const bool under_mpirun =
      std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr;  // which gives its programs terminals of its own
  return !under_mpirun && ::isatty(STDOUT_FILENO) ? ProgressStyle::bar : ProgressStyle::lines;
}

void Progress::update(const ProgressState& state) {
  if (style_ == ProgressStyle::silent) return;
  const double waited = state.seconds - shown_seconds_;
  if (style_ == ProgressStyle::bar) {
    if (waited >= seconds_between_refreshes) show(state, false);
    return;
  }
  const double advanced = state.end_time > 0 ? (state.time - shown_time_) / state.end_time : 0;
  if (waited >= seconds_between_lines && advanced >= fraction_between_lines) show(state, false);
}

void Progress::finish(const ProgressState& state) {
  if (style_ != ProgressStyle::silent) show(state, true);
}

void Progress::show(const ProgressState& state, bool last) {
  shown_seconds_ = state.seconds;
  shown_time_ = state.time;
  if (style_ == ProgressStyle::bar) {
    out_ << '\r' << progress_line(state, terminal_width() - 1) << "\033[K" << (last ? "\n" : "");
  } else {
    out_ << progress_line(state, 0) << '\n';
  }
  out_.flush();
}

}  // namespace cobasis
