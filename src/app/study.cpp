#include "app/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "app/case.hpp"
#include "app/simulation.hpp"
#include "app/study_report.hpp"
#include "math/errors.hpp"

namespace cobasis {
namespace {

void check_for_study(const Setup& setup) {
  if (setup.max_steps)
    throw InputError(fmt::format(
        "{}: max_steps would end the meshes of a study at different times; allowed: no max_steps, a smaller "
        "end_time",
        setup.case_file));
  if (!setup.integrals.empty() || !setup.probes.empty()) return;
  const auto phase = std::ranges::find_if(setup.phases, [](const PhaseSetup& p) { return !p.is_void(); });
  const std::string name = phase == setup.phases.end() ? "NAME" : phase->name;
  throw InputError(
      fmt::format("{0}: a study compares numbers, and the case has no [[integral]] and no [[probe]]; allowed: at least "
                  "one, such as\n"
                  "[[integral]]\nname = \"pressure\"\nmean = {{ field = \"pressure.{1}\", box = {{ low = [0.4, 0.0], "
                  "high = [0.5, 1.0] "
                  "}} }}\n"
                  "[[integral]]\nname = \"front\"\nextent = {{ phase = \"{1}\", alpha = 0.5, axis = \"x\" }}\n"
                  "[[probe]]\nname = \"gauge\"\nat = [0.45, 0.0]",
                  setup.case_file, name));
}

std::string directory_of(const CommandLine& command, const Setup& setup) {
  return command.overrides.output.empty() ? setup.output.directory + "-study" : setup.output.directory;
}

MeasuredRun measured(const StudyMesh& mesh, const Scene& scene, const RunResult& run) {
  return {mesh.h,
          {static_cast<double>(scene.mesh.n_global), static_cast<double>(run.steps), static_cast<double>(run.rows)},
          {run.step_seconds, run.history_seconds, run.other_seconds}};
}

/// What round-off of a number is measured by: the largest of the numbers of the same place and unit, so that a
/// component that vanishes is not taken for one that oscillates.
double scale_of(const std::vector<RunResult>& runs, std::size_t column) {
  const auto place = [](const std::string& name) { return name.substr(0, name.find('.')); };
  const Column& one = runs.back().values[column];
  double scale = 0;
  for (const RunResult& run : runs) {
    for (const Column& other : run.values) {
      if (place(other.name) == place(one.name) && other.unit == one.unit && std::isfinite(other.value))
        scale = std::max(scale, std::fabs(other.value));
    }
  }
  return scale;
}

std::vector<StudyQuantity> quantities_of(const std::vector<StudyRun>& meshes, const std::vector<RunResult>& runs) {
  std::vector<double> h;
  for (const StudyRun& mesh : meshes) h.push_back(mesh.mesh.h);
  std::vector<StudyQuantity> quantities;
  for (std::size_t c = 0; c < runs.back().values.size(); ++c) {
    StudyQuantity quantity{runs.back().values[c].name, runs.back().values[c].unit, {}, {}};
    for (const RunResult& run : runs) quantity.values.push_back(run.values[c].value);
    quantity.convergence = converge(h, quantity.values, scale_of(runs, c));
    quantities.push_back(std::move(quantity));
  }
  return quantities;
}

}  // namespace

void study_case(const CommandLine& command, const Mpi& mpi) {
  const Setup setup = read_case(command.file, command.overrides);
  check_for_study(setup);
  const Refinement refinement(setup, command.study.refine);
  const std::vector<StudyMesh> meshes = mesh_sequence(refinement, command.study);
  const bool speaks = mpi.root() && !command.quiet;

  StudyReport report;
  report.case_file = command.file;
  report.settings = command.overrides.set;
  report.directory = directory_of(command, setup);
  report.ranks = mpi.size();

  std::vector<Scene> scenes;  // all of them first: what is wrong with a mesh shows before the first run
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    Setup one = setup;
    one.mesh_parameters = meshes[i].parameters;
    one.output.directory = fmt::format("{}/mesh_{}", report.directory, i + 1);
    scenes.push_back(open_scene(one, command.trust_geo, meshes[i].splits, mpi));
  }
  if (speaks) {
    for (const std::string& notice : scenes.back().mesh.notices) std::cerr << "cobasis: " << notice << '\n';
    std::cout << setup.title << '\n';
  }

  std::vector<RunResult> runs;
  std::vector<MeasuredRun> costs;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    StudyRun run{meshes[i], static_cast<double>(scenes[i].mesh.n_global), 0, 0, {}};
    if (!costs.empty()) {
      const CostModel model(costs, setup.history_every);
      run.predicted_core_seconds = mpi.size() * model.seconds(model.size(run.mesh.h, run.cells));
    }
    if (speaks) std::cout << announcement(run, i + 1, meshes.size()) << std::flush;
    runs.push_back(run_scene(scenes[i], mpi, {.speech = command.quiet ? Speech::nothing : Speech::progress}));
    costs.push_back(measured(meshes[i], scenes[i], runs.back()));
    scenes[i].mesh = {};
    run.steps = static_cast<double>(runs.back().steps);
    run.core_seconds = mpi.size() * costs.back().seconds.total();
    report.runs.push_back(run);
  }
  if (!mpi.root()) return;

  report.quantities = quantities_of(report.runs, runs);
  report.forecasts = foretell(report, refinement, CostModel(costs, setup.history_every), command.study.accuracies);
  if (speaks) std::cout << text_of(report) << std::flush;
  write_report(report);
  const bool drawn = draw_report(report);
  if (speaks)
    std::cout << fmt::format("results: {}: study.csv, meshes.csv, forecast.csv{}\n", report.directory,
                             drawn ? ", study.png" : "");
  std::cout << last_line_of(report);
}

}  // namespace cobasis
