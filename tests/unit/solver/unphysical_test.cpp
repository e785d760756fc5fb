#include <catch2/catch.hpp>

#include "small_scene.hpp"

using namespace cobasis;

namespace {

/// Spoils one number of a phase in the middle of the mesh, and returns what the solver says within two steps.
std::string report(const std::string& material, const std::function<void(Phase&, std::int32_t)>& spoil) {
  SmallScene scene = small_scene(busy_setup({material}, true), small_mesh(CellType::quadrilateral, 9));
  scene.solver->advance(1);
  auto& phase = const_cast<Phase&>(scene.solver->fields().phases[0]);
  spoil(phase, 40);
  try {
    scene.solver->advance(1);
    scene.solver->advance(1);
  } catch (const Unphysical& error) {
    return error.what();
  }
  return "";
}

constexpr int ch2 = Layout<Plane, Kind::solid>::ch2, energy = Layout<Plane, Kind::solid>::energy;

}  // namespace

TEST_CASE("a wave speed that is not a number stops the run before the step, with the cell and its state") {
  for (const std::string material : {"copper", "water"}) {
    const std::string text =
        report(material, [](Phase& phase, std::int32_t cell) { phase.primitive[ch2][cell] = -1e12; });
    CAPTURE(text);
    CHECK(text.find("a wave speed is not a finite number") != std::string::npos);
    CHECK(text.find("'" + material + "'") != std::string::npos);
    CHECK(text.find("step 1,") != std::string::npos);
    CHECK(text.find("nan") == std::string::npos);
  }
}

TEST_CASE(
    "a pressure below the lowest of the equation of state stops the run after the step, with the cell and its state") {
  for (const std::string material : {"copper", "water"}) {
    const std::string text =
        report(material, [](Phase& phase, std::int32_t cell) { phase.conserved[energy][cell] *= 0.5; });
    CAPTURE(text);
    CHECK(text.find("'" + material + "' left its admissible states in cell") != std::string::npos);
    CHECK(text.find("pressure -") != std::string::npos);
    CHECK(text.find("step 2,") != std::string::npos);
  }
}
