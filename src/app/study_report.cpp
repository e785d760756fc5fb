#include "app/study_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <limits>

#include "app/atomic_file.hpp"
#include "app/tables.hpp"

namespace cobasis {
namespace {

constexpr const char* all_that_converge = "*";
constexpr double out_of_reach = 1e9;  // core-seconds: 30 years of a core

bool is_trusted(const Convergence& convergence) {
  return convergence.trend == Trend::asymptotic || convergence.trend == Trend::same;
}

/// Nothing to look at: zero but for round-off, nowhere defined, or the same numbers as one before (the mixture's where
/// there is one phase).
bool is_idle(const std::vector<StudyQuantity>& quantities, const StudyQuantity& quantity) {
  const Convergence& found = quantity.convergence;
  if (found.trend == Trend::same && std::fabs(found.value) <= found.error) return true;
  if (std::ranges::all_of(quantity.values, [](double x) { return std::isnan(x); })) return true;
  for (const StudyQuantity& other : quantities) {
    if (&other == &quantity) return false;
    if (other.unit == quantity.unit && other.values == quantity.values) return true;
  }
  return false;
}

std::string word_of(Trend trend) {
  switch (trend) {
    case Trend::asymptotic:
      return "asymptotic";
    case Trend::same:
      return "same";
    case Trend::fast:
      return "fast";
    case Trend::slow:
      return "slow";
    case Trend::growing:
      return "growing";
    case Trend::oscillating:
      return "oscillating";
    case Trend::none:
      break;
  }
  return "none";
}

std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

/// Columns two spaces apart.
std::string table_of(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], width_of(row[c]));
  }
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t c = 0; c < row.size(); ++c)
      line += fmt::format("  {}{}", row[c], std::string(widths[c] - width_of(row[c]), ' '));
    line.resize(line.find_last_not_of(' ') + 1);
    text += line;
    text += '\n';
  }
  return text;
}

/// For a shell, in quotes only where they are needed.
std::string quoted(const std::string& word) {
  const auto plain = [](unsigned char c) {
    return std::isalnum(c) || std::string_view("_-./=,:+").find(c) != std::string_view::npos;
  };
  if (!word.empty() && std::ranges::all_of(word, plain)) return word;
  std::string result;
  for (const char c : word) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return fmt::format("'{}'", result);
}

std::string command_for(const StudyReport& report, const StudyMesh& mesh) {
  std::string text = report.ranks > 1 ? fmt::format("mpirun -n {} ", report.ranks) : "";
  text += fmt::format("cobasis run {} --set", quoted(report.case_file));
  const auto& own = report.runs.back().mesh.parameters;
  for (const auto& setting : report.settings) {
    const auto replaced = [&](const auto& parameter) {
      return setting.first == "mesh_parameters." + parameter.first && parameter.second != own.at(parameter.first);
    };
    if (std::ranges::none_of(mesh.parameters, replaced))
      text += fmt::format(" {}", quoted(fmt::format("{}={}", setting.first, setting.second)));
  }
  for (const auto& [name, value] : mesh.parameters)
    if (value != own.at(name))
      text += fmt::format(" {}", quoted(fmt::format("mesh_parameters.{}={:.9g}", name, value)));
  return text;
}

std::vector<std::string> parameter_names(const StudyReport& report) {
  std::vector<std::string> names;
  for (const auto& [name, value] : report.runs.back().mesh.parameters)
    names.push_back(fmt::format("mesh_parameters.{}", name));
  return names;
}

std::vector<std::string> parameter_values(const StudyMesh& mesh) {
  std::vector<std::string> values;
  for (const auto& [name, value] : mesh.parameters) values.push_back(fmt::format("{}", value));
  return values;
}

std::string study_csv(const StudyReport& report) {
  std::vector<std::string> header = {"quantity", "unit", "value", "error", "order", "trend"};
  for (std::size_t i = 0; i < report.runs.size(); ++i) header.push_back(fmt::format("mesh_{}", i + 1));
  std::string text = csv_row(header);
  for (const StudyQuantity& quantity : report.quantities) {
    const Convergence& found = quantity.convergence;
    const double no_order = std::numeric_limits<double>::quiet_NaN();
    text += fmt::format("{},{},{},{},{},{},{}\n", quantity.name, quantity.unit, found.value, found.error,
                        found.order.value_or(no_order), word_of(found.trend), fmt::join(quantity.values, ","));
  }
  return text;
}

std::string meshes_csv(const StudyReport& report) {
  std::vector<std::string> header = {"mesh", "h", "splits"};
  std::ranges::copy(parameter_names(report), std::back_inserter(header));
  for (const char* name : {"cells", "steps", "ranks", "core_seconds", "predicted_core_seconds"})
    header.emplace_back(name);
  std::string text = csv_row(header);
  for (std::size_t i = 0; i < report.runs.size(); ++i) {
    const StudyRun& run = report.runs[i];
    std::vector<std::string> row = {fmt::format("mesh_{}", i + 1), fmt::format("{}", run.mesh.h),
                                    fmt::format("{}", run.mesh.splits)};
    std::ranges::copy(parameter_values(run.mesh), std::back_inserter(row));
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    row.push_back(fmt::format("{},{},{},{},{}", run.cells, run.steps, report.ranks, run.core_seconds,
                              run.predicted_core_seconds.value_or(unknown)));
    text += csv_row(row);
  }
  return text;
}

std::string forecast_csv(const StudyReport& report) {
  std::vector<std::string> header = {"quantity", "accuracy", "trusted", "h", "splits"};
  std::ranges::copy(parameter_names(report), std::back_inserter(header));
  for (const char* name : {"cells", "steps", "core_seconds"}) header.emplace_back(name);
  std::string text = csv_row(header);
  for (const Forecast& forecast : report.forecasts) {
    std::vector<std::string> row = {forecast.quantity, fmt::format("{}", forecast.accuracy),
                                    forecast.trusted ? "1" : "0", fmt::format("{}", forecast.mesh.h),
                                    fmt::format("{}", forecast.mesh.splits)};
    std::ranges::copy(parameter_values(forecast.mesh), std::back_inserter(row));
    row.push_back(fmt::format("{:.0f},{:.0f},{}", forecast.size.cells, forecast.size.steps, forecast.core_seconds));
    text += csv_row(row);
  }
  return text;
}

std::string text_of_forecasts(const StudyReport& report) {
  if (report.forecasts.empty()) return {};
  std::vector<double> accuracies;
  for (const Forecast& forecast : report.forecasts)
    if (std::ranges::find(accuracies, forecast.accuracy) == accuracies.end()) accuracies.push_back(forecast.accuracy);
  std::vector<std::vector<std::string>> rows = {{"relative accuracy"}};
  for (const double accuracy : accuracies) rows[0].push_back(fmt::format("{:g}", accuracy));
  bool guesses = false;
  const Forecast* next = nullptr;  // the first that takes a finer mesh
  for (const Forecast& forecast : report.forecasts) {
    const std::string name = forecast.quantity == all_that_converge ? "all that converge" : forecast.quantity;
    if (rows.back()[0] != name) rows.push_back({name});
    rows.back().push_back(
        forecast.core_seconds > out_of_reach
            ? "out of reach"
            : fmt::format("{:.3g}{} ({})", forecast.core_seconds, forecast.trusted ? "" : "?", forecast.mesh.name));
    guesses = guesses || !forecast.trusted;
    const bool is_next = forecast.mesh.h < 0.999 * report.runs.back().mesh.h && forecast.core_seconds < out_of_reach;
    if (!next && forecast.quantity == all_that_converge && is_next) next = &forecast;
  }
  std::string text = fmt::format("\ncore-seconds on {} rank{}\n", report.ranks, report.ranks == 1 ? "" : "s");
  text += table_of(rows);
  if (guesses) text += "  ? not in the asymptotic range: a guess on the safe side\n";
  if (next && next->mesh.splits == 0)
    text += fmt::format("\nto {:g} in all that converge, {:.3g} core-seconds:\n  {}\n", next->accuracy,
                        next->core_seconds, command_for(report, next->mesh));
  return text;
}

}  // namespace

std::string announcement(const StudyRun& run, std::size_t number, std::size_t count) {
  return fmt::format(
      "mesh {} of {}: {}, {:.0f} cells{}\n", number, count, run.mesh.name, run.cells,
      run.predicted_core_seconds ? fmt::format(", predicted {:.3g} core-seconds", *run.predicted_core_seconds) : "");
}

std::string with_error(double value, double error) {
  if (!std::isfinite(value) || !std::isfinite(error)) return "no value";
  if (error < 1e-6 * std::fabs(value)) return fmt::format("{:.8g} ± {:.1g}", value, error);
  const double larger = std::max(std::fabs(value), error);
  if (larger == 0) return "0";
  const int magnitude = static_cast<int>(std::floor(std::log10(larger)));
  const int power = magnitude >= 5 || magnitude < -2 ? magnitude : 0;
  const double unit = std::pow(10.0, power);
  const int digits = error > 0 ? std::clamp(1 - static_cast<int>(std::floor(std::log10(error / unit))), 0, 12) : 12;
  const std::string text = fmt::format("{:.{}f} ± {:.{}f}", value / unit, digits, error / unit, digits);
  return power == 0 ? text : fmt::format("({})e{}", text, power);
}

std::vector<Forecast> foretell(const StudyReport& report, const Refinement& refinement, const CostModel& model,
                               const std::vector<double>& accuracies) {
  std::vector<Forecast> forecasts;
  const double finest = report.runs.back().mesh.h, coarsest = report.runs.front().mesh.h;
  std::vector<double> h_of_all(accuracies.size(), coarsest);
  const auto add = [&](const std::string& quantity, double accuracy, bool trusted, double h) {
    Forecast forecast{quantity, accuracy, trusted, refinement.mesh(h), {}, 0};
    forecast.size = model.size(forecast.mesh.h);
    forecast.core_seconds = report.ranks * model.seconds(forecast.size);
    forecasts.push_back(forecast);
  };
  bool any = false;
  for (const StudyQuantity& quantity : report.quantities) {
    if (is_idle(report.quantities, quantity) || quantity.convergence.trend == Trend::same) continue;
    for (std::size_t a = 0; a < accuracies.size(); ++a) {
      const auto finer_by = refinement_for(quantity.convergence, accuracies[a]);
      if (!finer_by) continue;
      const double h = std::min(finest / *finer_by, coarsest);
      add(quantity.name, accuracies[a], is_trusted(quantity.convergence), h);
      if (!is_trusted(quantity.convergence)) continue;
      h_of_all[a] = std::min(h_of_all[a], h);
      any = true;
    }
  }
  for (std::size_t a = 0; any && a < accuracies.size(); ++a) add(all_that_converge, accuracies[a], true, h_of_all[a]);
  return forecasts;
}

std::string text_of(const StudyReport& report) {
  std::vector<std::vector<std::string>> meshes = {{"mesh", "cells", "steps", "core-seconds", "predicted"}};
  for (const StudyRun& run : report.runs)
    meshes.push_back({run.mesh.name, fmt::format("{:.0f}", run.cells), fmt::format("{:.0f}", run.steps),
                      fmt::format("{:.3g}", run.core_seconds),
                      run.predicted_core_seconds ? fmt::format("{:.3g}", *run.predicted_core_seconds) : "-"});
  std::string text = fmt::format("\n{}", table_of(meshes));

  std::vector<std::vector<std::string>> rows = {{"quantity"}};
  for (const StudyRun& run : report.runs) rows[0].push_back(run.mesh.name);
  for (const char* name : {"value", "order", ""}) rows[0].emplace_back(name);
  int hidden = 0;
  for (const StudyQuantity& quantity : report.quantities) {
    if (is_idle(report.quantities, quantity)) {
      ++hidden;
      continue;
    }
    const Convergence& found = quantity.convergence;
    rows.push_back({quantity.unit == "1" ? quantity.name : fmt::format("{} [{}]", quantity.name, quantity.unit)});
    for (const double value : quantity.values) rows.back().push_back(fmt::format("{:.6g}", value));
    rows.back().push_back(with_error(found.value, found.error));
    rows.back().push_back(found.order ? fmt::format("{:.2f}", *found.order) : "-");
    rows.back().emplace_back(describe(found.trend));
  }
  text += fmt::format("\n{}", table_of(rows));
  if (hidden > 0) text += fmt::format("  and {} that are zero, absent, or the same as another\n", hidden);
  return text + text_of_forecasts(report) + "\n";
}

std::string last_line_of(const StudyReport& report) {
  const auto converging = std::ranges::count_if(
      report.quantities, [](const StudyQuantity& quantity) { return is_trusted(quantity.convergence); });
  double total = 0;
  for (const StudyRun& run : report.runs) total += run.core_seconds;
  return fmt::format(
      "cobasis: meshes={} quantities={} converging={} core_seconds={:.3f} finest_core_seconds={:.3f} "
      "finest_predicted={:.3f}\n",
      report.runs.size(), report.quantities.size(), converging, total, report.runs.back().core_seconds,
      report.runs.back().predicted_core_seconds.value_or(0));
}

void write_report(const StudyReport& report) {
  write_atomically(report.directory + "/meshes.csv", meshes_csv(report));
  write_atomically(report.directory + "/forecast.csv", forecast_csv(report));
  write_atomically(report.directory + "/study.csv", study_csv(report));
}

bool draw_report(const StudyReport& report) {
  const std::string picture = report.directory + "/study.png";
  std::error_code ignored;
  std::filesystem::remove(picture, ignored);
  std::string tool = COBASIS_PLOT_STUDY, directory = report.directory;
  char* const arguments[] = {tool.data(), directory.data(), nullptr};
  pid_t child = 0;
  int status = 0;
  const bool drawn = posix_spawn(&child, tool.c_str(), nullptr, nullptr, arguments, environ) == 0 &&
                     waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
  if (!drawn)
    std::cerr << fmt::format(
        "cobasis: no picture, as {} could not draw it (it needs python3-matplotlib); the tables are "
        "complete\n",
        tool);
  return drawn;
}

}  // namespace cobasis
