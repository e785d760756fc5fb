#include <algorithm>
#include <catch2/catch.hpp>
#include <sstream>

#include "app/progress.hpp"

namespace cobasis {
namespace {

const ProgressState half{2.5e-5, 5e-5, 1234, 12.4, 41.27};

TEST_CASE("a progress line tells percent, time, step, time left and cost") {
  CHECK(progress_line(half, 0) == " 50 %  t = 2.5e-05 s  step 1234  0:13 left  41.3 ns/cell/eq");
  CHECK(progress_line({0, 1, 0, 0, 0}, 0) == "  0 %  t = 0 s  step 0");
  CHECK(progress_line({1, 1, 9, 4, 0}, 0) == "100 %  t = 1 s  step 9");
  CHECK_THAT(progress_line({0.001, 1, 5, 10, 0}, 0), Catch::Contains("2:46:30 left"));
}

TEST_CASE("100 % is shown only at the end") {
  CHECK_THAT(progress_line({0.9999, 1, 5, 10, 0}, 0), Catch::StartsWith(" 99 %"));
}

TEST_CASE("a progress line fits its width, the bar is as full as the run") {
  for (int width = 1; width < 200; ++width) CHECK(progress_line(half, width).size() <= static_cast<std::size_t>(width));
  const std::string wide = progress_line(half, 200);
  CHECK_THAT(wide, Catch::StartsWith("[" + std::string(20, '#') + std::string(20, '.') + "] "));
  CHECK_THAT(progress_line(half, 60), !Catch::Contains("["));
}

int updates_shown(ProgressStyle style, double run_seconds) {
  std::ostringstream out;
  Progress progress(out, style);
  const int steps = 10000;
  for (int step = 0; step < steps; ++step) {
    const double done = static_cast<double>(step) / steps;
    progress.update({done, 1, step, done * run_seconds, 0});
  }
  const std::string text = out.str();
  return static_cast<int>(std::count(text.begin(), text.end(), style == ProgressStyle::bar ? '\r' : '\n'));
}

TEST_CASE("a bar is refreshed at most five times a second") {
  CHECK(updates_shown(ProgressStyle::bar, 10) <= 50);
  CHECK(updates_shown(ProgressStyle::bar, 10) >= 45);
}

TEST_CASE("plain lines come at most every 5 % and at most every 10 s") {
  CHECK(updates_shown(ProgressStyle::lines, 3600) <= 20);
  CHECK(updates_shown(ProgressStyle::lines, 3600) >= 18);
  CHECK(updates_shown(ProgressStyle::lines, 60) <= 6);
  CHECK(updates_shown(ProgressStyle::lines, 60) >= 4);
  CHECK(updates_shown(ProgressStyle::lines, 5) == 0);
}

TEST_CASE("quiet is silent, also at the end") {
  CHECK(progress_style(true) == ProgressStyle::silent);
  std::ostringstream out;
  Progress progress(out, ProgressStyle::silent);
  progress.update(half);
  progress.finish(half);
  CHECK(out.str().empty());
}

TEST_CASE("the end is always shown") {
  std::ostringstream out;
  Progress progress(out, ProgressStyle::lines);
  progress.finish({1, 1, 9, 0.01, 0});
  CHECK(out.str() == "100 %  t = 1 s  step 9\n");
}

}  // namespace
}  // namespace cobasis
