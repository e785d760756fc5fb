#include "app/simulation.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <iostream>
#include <optional>

#include "app/case.hpp"
#include "app/checkpoint.hpp"
#include "app/output.hpp"
#include "app/progress.hpp"
#include "math/errors.hpp"
#include "mesh/read_mesh.hpp"
#include "solver/initial_condition.hpp"
#include "solver/solver.hpp"

namespace cobasis {
namespace {

class Timer {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Counts down to the next multiple of an interval, and never misses the end.
class Schedule {
 public:
  Schedule(double interval, double end) : interval_(interval), end_(end) {}
  double next() const { return std::min(static_cast<double>(count_) * interval_, end_); }
  /// Whether the time has come; if so, on to the next multiple after it.
  bool due(double time) {
    if (time < next()) return false;
    while (static_cast<double>(count_) * interval_ <= time) ++count_;
    return true;
  }

 private:
  double interval_, end_;
  std::int64_t count_ = 0;
};

/// Largest relative change of a phase's mass, what left through boundaries included.
double mass_error(const std::vector<Column>& before, const std::vector<Column>& after) {
  const auto is_mass_of = [](const std::string& name, const std::string& phase) {
    const std::string suffix = ".mass." + phase;
    return name.starts_with("outflow.") && name.ends_with(suffix);
  };
  double worst = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (!before[i].name.starts_with("mass.")) continue;
    const std::string phase = before[i].name.substr(5);
    double change = after[i].value - before[i].value;
    for (const Column& column : after)
      if (is_mass_of(column.name, phase)) change += column.value;
    if (before[i].value > 0) worst = std::max(worst, std::fabs(change) / before[i].value);
  }
  return worst;
}

std::string describe(const Scene& scene, const Solver& solver) {
  std::string text = fmt::format("{}\n{} scene, {} cells, {} equations per cell\n", scene.setup.title,
                                 name_of(scene.geometry), scene.mesh.n_global, solver.equations());
  const Scheme& scheme = scene.setup.scheme;
  const bool interfaces = solver.fields().multiphase();
  text += fmt::format("  scheme: order {}{}{}, low_mach {}\n", scheme.order,
                      scheme.order == 1 ? ""
                      : scheme.limited  ? ", limited"
                                        : ", not limited",
                      !interfaces                                          ? ""
                      : scheme.interface == InterfaceTreatment::sharp      ? ", sharp interfaces"
                      : scheme.interface == InterfaceTreatment::compressed ? ", compressed interfaces"
                                                                           : ", diffuse interfaces",
                      scheme.low_mach ? "on" : "off");
  const auto rate = [](double value) { return std::isinf(value) ? "stiff" : fmt::format("{:g}", value); };
  for (const auto& [pair, rates] : scene.setup.relaxations)
    text += fmt::format("  {} and {} relax: velocity {}, pressure {}\n", scene.setup.phases[pair.first].name,
                        scene.setup.phases[pair.second].name, rate(rates.velocity), rate(rates.pressure));
  for (int k = 0; k < solver.fields().n_phases(); ++k) {
    const Phase& phase = solver.fields().phases[k];
    if (phase.is_void) {
      text += fmt::format("  {}: void at {:g} Pa, no state of its own\n", phase.name, phase.void_pressure);
      continue;
    }
    const std::size_t number = sizeof(double);
    text += fmt::format("  {}: {}, {} bytes of state per cell, {} per face\n", phase.name,
                        phase.kind == Kind::solid ? "solid" : "fluid", phase.numbers_per_cell() * number,
                        solver.kernels(k).n_flux * number);
  }
  return text;
}

/// Bytes of state that a cell carries.
std::size_t state_bytes(const Solver& solver) {
  std::size_t numbers = 0;
  for (const Phase& phase : solver.fields().phases) numbers += phase.numbers_per_cell();
  return numbers * sizeof(double);
}

/// Memory that this process holds at present [bytes].
std::int64_t resident_memory() {
  std::int64_t pages = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> pages >> resident;
  return resident * sysconf(_SC_PAGESIZE);
}

std::string duration(double seconds) {
  if (seconds < 120) return fmt::format("{:.3g} s", seconds);
  if (seconds < 7200) return fmt::format("{:.3g} min", seconds / 60);
  return fmt::format("{:.3g} h", seconds / 3600);
}

}  // namespace

Scene open_scene(const Setup& setup, bool trust_geo, int splits, const Mpi& mpi) {
  const Timer timer;
  Scene scene{setup, Geometry::plane, {}, 0};
  MeshRequest request;
  request.file = setup.mesh_file;
  request.parameters = setup.mesh_parameters;
  request.trust_geo = trust_geo;
  request.splits = splits;
  request.dimension = !setup.scene ? 0 : *setup.scene == Geometry::space ? 3 : 2;
  request.axisymmetric = setup.scene == Geometry::axisymmetric;
  request.periodic = periodic_pairs(setup);
  request.cell_weight = [&setup](const Point& x, const std::string& region) { return cell_cost(setup, x, region); };
  scene.mesh = read_mesh(request, mpi);
  scene.geometry = geometry_of(scene.mesh);
  check_for_geometry(setup, scene.geometry);
  scene.seconds = timer.seconds();
  return scene;
}

RunResult run_scene(const Scene& scene, const Mpi& mpi, const RunOptions& options) {
  const Speech speech = options.speech;
  const Timer timer;
  const Setup& setup = scene.setup;
  Solver solver(setup, scene.geometry, scene.mesh, mpi);
  Output output(setup, scene.geometry, scene.mesh, mpi);
  if (mpi.root() && speech == Speech::all) {
    for (const std::string& notice : scene.mesh.notices) std::cerr << "cobasis: " << notice << '\n';
    std::cout << describe(scene, solver) << std::flush;
  }

  RunResult result;
  const auto schedule_of = [&](const auto& of) {
    return Schedule(of.every.value_or(setup.end_time / of.count.value_or(20)), setup.end_time);
  };
  Schedule outputs = schedule_of(setup.output);
  std::vector<Schedule> slices;
  for (const SliceSetup& slice : setup.slices) slices.push_back(schedule_of(slice));
  const auto next_output = [&] {
    double next = outputs.next();
    for (const Schedule& slice : slices) next = std::min(next, slice.next());
    return next;
  };
  Schedule rows(setup.end_time / 1000, setup.end_time);
  Progress progress(std::cout, mpi.root() ? progress_style(speech == Speech::last_line || speech == Speech::nothing)
                                          : ProgressStyle::silent);
  const auto cost = [&] {
    const double evaluations =
        static_cast<double>(scene.mesh.n_global) * solver.equations() * static_cast<double>(solver.step());
    return evaluations > 0 ? 1e9 * solver.clock().total / evaluations : 0;
  };
  const auto write_due = [&](bool last) {
    const double time = solver.time();
    const bool fields = outputs.due(time) || last;
    std::vector<std::size_t> cut;
    for (std::size_t i = 0; i < slices.size(); ++i)
      if (slices[i].due(time) || last) cut.push_back(i);
    if (fields || !cut.empty()) {
      const Snapshot snapshot = solver.snapshot();
      if (fields) output.write(snapshot);
      for (const std::size_t i : cut) output.write_slice(i, snapshot);
    }
    const bool row = setup.history_every ? solver.step() % *setup.history_every == 0 : rows.due(time);
    if (!row && !last) return;
    const Timer writing;
    output.history(solver.snapshot(output.needs_fields_for_history() ? Solver::Content::all : Solver::Content::alpha),
                   solver.totals());
    ++result.rows;
    result.history_seconds += writing.seconds();
  };

  std::vector<Column> initial = solver.totals();
  double before = 0;  // time at the beginning of the last step
  const auto done = [&] {
    return solver.time() >= setup.end_time || (setup.max_steps && solver.step() >= *setup.max_steps);
  };
  // A checkpoint is taken after a step and before its outputs, so that those of a run that ends early, and would not
  // be there had it gone on, are not in it.
  const auto keep = [&](Keeper& keeper) {
    solver.keep(keeper);
    output.keep(keeper);
    keeper.number("time_before", before);
    keeper.whole_number("rows", result.rows);
    for (Column& column : initial) keeper.number("initial." + column.name, column.value);
  };
  std::optional<Checkpoints> checkpoints;
  if (options.checkpoints) checkpoints.emplace(setup, scene.geometry, scene.mesh, mpi);
  if (options.restart) {
    checkpoints->restore(keep);
    outputs.due(before);
    for (Schedule& slice : slices) slice.due(before);
    rows.due(before);
    if (mpi.root() && speech == Speech::all)
      std::cout << fmt::format("restart from '{}', step {}, time {:.6g} s\n", checkpoints->latest(), solver.step(),
                               solver.time());
  }
  write_due(options.restart && done());
  if (checkpoints && !options.restart) checkpoints->begin();
  try {
    while (!done()) {
      before = solver.time();
      solver.advance(next_output());
      if (checkpoints) checkpoints->update(keep, solver.step(), done());
      write_due(done());
      progress.update({solver.time(), setup.end_time, solver.step(), timer.seconds(), cost()});
    }
  } catch (const Unphysical& error) {
    if (!output.has_written(solver.time())) output.write(solver.snapshot());
    std::string text = fmt::format("{}; the state before this step is in '{}'", error.what(), output.latest_fields());
    if (checkpoints && !checkpoints->latest().empty())
      text += fmt::format("; the last checkpoint is '{}'", checkpoints->latest());
    throw Unphysical(text);
  }
  progress.finish({solver.time(), setup.end_time, solver.step(), timer.seconds(), cost()});
  output.finish();

  const double mixed = solver.mixed_share();
  const double error = mass_error(initial, solver.totals());
  const std::int64_t exchanges = mpi.sum(solver.exchange_counters().exchanges),
                     kept = mpi.sum(solver.exchange_counters().kept), dust = mpi.sum(solver.exchange_counters().dust);
  const double exchanged_volume = solver.exchanged_volume();
  const RobustnessCounters robustness = solver.robustness();
  result.steps = solver.step();
  result.step_seconds = solver.clock().total;
  result.other_seconds = scene.seconds + timer.seconds() - result.step_seconds - result.history_seconds;
  result.values = output.latest();
  if (!mpi.root() || speech == Speech::progress || speech == Speech::nothing) return result;
  if (speech == Speech::all) {
    std::cout << fmt::format("volume exchange: {} exchanges of {:.6g} m^3 in all, {} kept, {} dust\n", exchanges,
                             exchanged_volume, kept, dust);
    if (setup.scheme.order == 2)
      std::cout << fmt::format("second order: fell back to the first in {:.3g} % of the reconstructions\n",
                               100 * robustness.fallback_share);
    if (robustness.redone > 0)
      std::cout << fmt::format("robustness: {} steps taken again, with caution where they had failed\n",
                               robustness.redone);
    if (robustness.mended + robustness.torn + robustness.followed > 0)
      std::cout << fmt::format(
          "fragments: {} averaged with a neighbour, {} relaxed to the void's pressure, {} without a state of their "
          "own, summed over steps\n",
          robustness.mended, robustness.torn, robustness.followed);
    for (const IntegralSetup& integral : setup.integrals)
      std::cout << fmt::format("{} = {:.6g} {}\n", integral.name, output.integral(integral.name), integral.unit);
  }
  std::cout << fmt::format(
      "cobasis: steps={} time={:.9g} cells={} mixed={:.2f}% seconds={:.3f} pack={:.1f}% "
      "ns_per_cell_equation_evaluation={:.3f} mass_error={:.2e}\n",
      solver.step(), solver.time(), scene.mesh.n_global, 100 * mixed, solver.clock().total,
      solver.clock().total > 0 ? 100 * solver.clock().kernels / solver.clock().total : 0, cost(), error);
  return result;
}

void run_case(const CommandLine& command, const Mpi& mpi) {
  const Setup setup = read_case(command.file, command.overrides);
  run_scene(
      open_scene(setup, command.trust_geo, 0, mpi), mpi,
      {.speech = command.quiet ? Speech::last_line : Speech::all, .checkpoints = true, .restart = command.restart});
}

void check_case(const CommandLine& command, const Mpi& mpi) {
  const Scene scene = open_scene(read_case(command.file, command.overrides), command.trust_geo, 0, mpi);
  const Setup& setup = scene.setup;
  const Output refuses_what_run_would(setup, scene.geometry, scene.mesh, mpi, Output::Disk::untouched);
  Solver solver(setup, scene.geometry, scene.mesh, mpi);
  const auto done = [&] { return solver.time() >= setup.end_time || solver.step() == setup.max_steps; };
  const double dt = solver.advance(setup.end_time);  // it also touches memory for the first time: not measured
  constexpr std::int64_t least = 5;
  constexpr double patience = 1;  // [s]
  const double warm_up = solver.clock().total;
  while (!done() && (solver.step() <= least || mpi.max(solver.clock().total - warm_up) < patience))
    solver.advance(setup.end_time);
  const std::int64_t measured = solver.step() - 1;
  const double seconds = mpi.max(measured > 0 ? solver.clock().total - warm_up : warm_up),
               per_step = seconds / static_cast<double>(std::max<std::int64_t>(measured, 1));
  const std::int64_t memory = mpi.sum(resident_memory());
  if (!mpi.root()) return;
  const double all = std::ceil(setup.end_time / dt * (1 - 1e-12)),
               steps = setup.max_steps ? std::min(static_cast<double>(*setup.max_steps), all) : all;
  const auto bytes = static_cast<double>(state_bytes(solver)), n_cells = static_cast<double>(scene.mesh.n_global);
  const std::string ranks = fmt::format("{} rank{}", mpi.size(), mpi.size() == 1 ? "" : "s");
  std::cout << describe(scene, solver)
            << fmt::format("state: {:g} bytes per cell, {:.3g} MB in all\n", bytes, 1e-6 * bytes * n_cells)
            << fmt::format("memory: {:.3g} MB on {}, with buffers, mesh and libraries\n",
                           1e-6 * static_cast<double>(memory), ranks)
            << fmt::format("step: {:.3g} s at t = 0; {} {:.0f} steps to {:g} s\n", dt,
                           solver.time() >= setup.end_time ? "in all" : "if it stays so,",
                           solver.time() >= setup.end_time ? static_cast<double>(solver.step()) : steps, setup.end_time)
            << fmt::format(
                   "time: about {} without output; from {:.3g} s per step, measured over the {} on {} just now\n",
                   duration(per_step * steps), per_step,
                   measured > 1   ? fmt::format("first {} steps", measured + 1)
                   : measured > 0 ? "second step"
                                  : "only step",
                   ranks);
}

}  // namespace cobasis
