// What a study found: as text, as tables, as a picture.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/study_convergence.hpp"
#include "app/study_cost.hpp"
#include "app/study_meshes.hpp"

namespace cobasis {

struct StudyRun {
  StudyMesh mesh;
  double cells = 0, steps = 0;
  double core_seconds = 0;                       ///< wall-clock seconds times ranks, of the whole run
  std::optional<double> predicted_core_seconds;  ///< from the coarser meshes
};

/// A number of the case at its end.
struct StudyQuantity {
  std::string name, unit;
  std::vector<double> values;  ///< per mesh
  Convergence convergence;
};

/// The run that a relative accuracy takes.
struct Forecast {
  std::string quantity;  ///< "*": all that converge
  double accuracy = 0;
  bool trusted = true;  ///< in the asymptotic range
  StudyMesh mesh;
  RunSize size;
  double core_seconds = 0;
};

struct StudyReport {
  std::string case_file;
  std::vector<std::pair<std::string, std::string>> settings;  ///< of --set
  std::string directory;
  int ranks = 1;
  std::vector<StudyRun> runs;  ///< coarse to fine
  std::vector<StudyQuantity> quantities;
  std::vector<Forecast> forecasts;
};

/// For each quantity that depends on the mesh, and for all that converge together. Not on coarser meshes than the
/// coarsest.
std::vector<Forecast> foretell(const StudyReport& report, const Refinement& refinement, const CostModel& model,
                               const std::vector<double>& accuracies);

/// "mesh 2 of 3: n = 1000, 1000 cells, predicted 1.2 core-seconds"
std::string announcement(const StudyRun& run, std::size_t number, std::size_t count);
/// "(-8.0921 ± 0.0012)e9": the error with two digits, the value with as many as it deserves.
std::string with_error(double value, double error);
std::string text_of(const StudyReport& report);
std::string last_line_of(const StudyReport& report);

/// study.csv, meshes.csv, forecast.csv, each whole or not at all. Throws SystemError.
void write_report(const StudyReport& report);
/// study.png, by tools/plot_study.py. A picture that cannot be drawn is told on standard error, and false.
bool draw_report(const StudyReport& report);

}  // namespace cobasis
