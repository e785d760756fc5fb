#include <catch2/catch.hpp>

#include "small_scene.hpp"

using namespace cobasis;

namespace {

using Spoil = void (*)(Phase&, std::int32_t cell);
void halve_energy(Phase& phase, std::int32_t cell) { phase.conserved[Layout<Plane, Kind::solid>::energy][cell] *= 0.5; }
void spoil_wave_speed(Phase& phase, std::int32_t cell) {
  phase.primitive[Layout<Plane, Kind::solid>::ch2][cell] = -1e12;
}

void overfill_shared_cells(Phase& phase, std::int32_t) {
  for (double& alpha : phase.alpha)
    if (alpha > 0 && alpha < 1) alpha = 1.5;
}

/// A scene of first order whose second step fails a number of times: a number of a cell is spoilt meanwhile.
struct Failing {
  int failures, attempts = 0;
  Spoil spoil;
  double first_step;
  SmallScene scene;

  Failing(const std::vector<std::string>& materials, int failures_of_second, Spoil spoil_with = halve_energy)
      : failures(failures_of_second),
        spoil(spoil_with),
        scene(small_scene(busy_setup(materials, true), small_mesh(CellType::quadrilateral, 9), options())) {
    first_step = scene.solver->advance(1);
    attempts = 0;
  }
  Failing(const Failing&) = delete;

  Phase& phase(int k) { return const_cast<Phase&>(scene.solver->fields().phases[k]); }
  SolverOptions options() {
    SolverOptions options;
    options.before_halo_send = [this] {
      if (scene.solver->step() != 1 || attempts++ >= failures) return;
      const int k = phase(0).is_void ? 1 : 0;
      std::int32_t cell = 0;
      while (!phase(k).alpha.empty() && phase(k).alpha[cell] != 1) ++cell;
      spoil(phase(k), cell);
    };
    return options;
  }
  /// Of the owned cells.
  std::vector<double> state(int k) {
    std::vector<double> values;
    for (std::int32_t cell = 0; cell < scene.mesh->n_owned; ++cell) {
      if (!phase(k).alpha.empty()) values.push_back(phase(k).alpha[cell]);
      for (const auto& component : phase(k).conserved) values.push_back(component[cell]);
    }
    return values;
  }
  std::vector<double> totals() const {
    std::vector<double> values;
    for (const Column& column : scene.solver->totals()) values.push_back(column.value);
    return values;
  }
};

/// What the solver says when the second step fails in all attempts.
std::string report(Failing& run) {
  const double time = run.scene.solver->time();
  std::string text;
  try {
    run.scene.solver->advance(1);
  } catch (const Unphysical& error) {
    text = error.what();
  }
  CHECK(run.attempts == 6);
  CHECK(run.scene.solver->robustness().redone == 5);
  CHECK(run.scene.solver->time() == time);
  return text;
}

}  // namespace

TEST_CASE("a wave speed that is not a number in any attempt at the step stops the run, with the cell and its state") {
  for (const std::string material : {"copper", "water"}) {
    Failing run({material}, 6, spoil_wave_speed);
    const std::string text = report(run);
    CAPTURE(text);
    CHECK(text.find("a wave speed is not a finite number") != std::string::npos);
    CHECK(text.find("'" + material + "'") != std::string::npos);
    CHECK(text.find("step 1,") != std::string::npos);
    CHECK(text.find("nan") == std::string::npos);
  }
}

TEST_CASE("a state that no attempt at the step makes admissible stops the run, with the cell and its state") {
  for (const std::string material : {"copper", "water"}) {
    Failing run({material}, 6);
    const std::string text = report(run);
    CAPTURE(text);
    CHECK(text.find("'" + material + "' left its admissible states in cell") != std::string::npos);
    CHECK(text.find("pressure -") != std::string::npos);
    CHECK(text.find("step 1,") != std::string::npos);
  }
}

TEST_CASE("less than nothing of a void in a cell stops the run too, with the cell and the volume fraction") {
  Failing run({"copper", "void"}, 6, overfill_shared_cells);
  const std::string text = report(run);
  CAPTURE(text);
  CHECK(text.find("'void' left its admissible states in cell") != std::string::npos);
  CHECK(text.find("volume fraction -0.") != std::string::npos);
}

TEST_CASE("a step taken again from the state before gives the bits of one that had not failed") {
  for (const std::vector<std::string>& materials :
       {std::vector<std::string>{"copper"}, {"water"}, {"copper", "void"}, {"void", "water"}})
    for (const Spoil spoil : {halve_energy, spoil_wave_speed}) {
      Failing run(materials, 1, spoil), smooth(materials, 0);
      for (int step = 0; step < 3; ++step) CHECK(run.scene.solver->advance(1) == smooth.scene.solver->advance(1));
      CHECK(run.scene.solver->robustness().redone == 1);
      CHECK(smooth.scene.solver->robustness().redone == 0);
      for (int k = 0; k < static_cast<int>(materials.size()); ++k) {
        CAPTURE(materials[0], materials.size(), k, spoil == halve_energy);
        CHECK(run.state(k) == smooth.state(k));
      }
      CHECK(run.totals() == smooth.totals());
    }
}

TEST_CASE("from the third attempt on a step is halved") {
  for (int failures = 2; failures <= 5; ++failures) {
    Failing run({"copper", "water"}, failures), smooth({"copper", "water"}, 0);
    const double halved = std::ldexp(smooth.scene.solver->advance(1), 1 - failures);
    CHECK(run.scene.solver->advance(1) == halved);
    CHECK(run.scene.solver->robustness().redone == failures);
    CHECK(run.scene.solver->step() == 2);
    CHECK(run.scene.solver->time() == run.first_step + halved);
  }
}
