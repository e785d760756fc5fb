// What a step costs per scene, with the kernels on packs and, in turn, on single numbers.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iostream>

#include "support/scene.hpp"

using namespace cobasis;
using namespace cobasis::test;

namespace {

struct Cost {
  double seconds = 0, kernels = 0, sweeps = 0;  ///< per step
};

/// The fastest of several rounds of steps.
Cost measure(Scene& scene, int rounds, int steps) {
  Cost best{infinity, infinity, infinity};
  for (int round = 0; round < rounds; ++round) {
    const StepClock before = scene.solver->clock();
    for (int i = 0; i < steps; ++i) scene.solver->advance(infinity);
    const StepClock& after = scene.solver->clock();
    best.seconds = std::min(best.seconds, (after.total - before.total) / steps);
    best.kernels = std::min(best.kernels, (after.kernels - before.kernels) / steps);
    best.sweeps = std::min(best.sweeps, (after.sweeps - before.sweeps) / steps);
  }
  return best;
}

std::size_t bytes_per_cell(const Fields& fields) {
  std::size_t numbers = 0;
  for (const Phase& phase : fields.phases)
    if (!phase.is_void) numbers += phase.numbers_per_cell();
  return numbers * sizeof(double);
}

void benchmark(const std::string& name, const std::string& scene, int steps) {
  const std::string text = first_order + scene;
  SceneOptions scalar;
  scalar.solver.scalar = true;
  Scene packs = make_scene(text, ranks()), numbers = make_scene(text, ranks(), scalar);
  measure(packs, 1, 5);
  measure(numbers, 1, 2);
  Cost pack{infinity, infinity, infinity}, single = pack;
  for (int round = 0; round < 5; ++round) {  // in turn: a machine that slows down slows both
    const Cost p = measure(packs, 1, steps), s = measure(numbers, 1, std::max(1, steps / 4));
    pack = {std::min(pack.seconds, p.seconds), std::min(pack.kernels, p.kernels), std::min(pack.sweeps, p.sweeps)};
    single = {std::min(single.seconds, s.seconds), std::min(single.kernels, s.kernels),
              std::min(single.sweeps, s.sweeps)};
  }
  const double cells = static_cast<double>(packs.mesh.n_global), faces = packs.mesh.n_faces();
  const int equations = packs.solver->equations();
  std::cout << fmt::format("{:<34} {:>8} {:>4} {:>6} {:>9.1f} {:>9.2f} {:>9.1f} {:>7.1f} {:>7.1f} {:>6.0f}\n", name,
                           packs.mesh.n_global, equations, bytes_per_cell(packs.solver->fields()),
                           1e9 * pack.seconds / cells, 1e9 * pack.seconds / cells / equations,
                           1e9 * pack.sweeps / faces, single.sweeps / pack.sweeps, single.seconds / pack.seconds,
                           100 * pack.kernels / pack.seconds);
}

/// Steps of second order, with diffuse and with sharp interfaces, in steps of first order.
void benchmark_orders(const std::string& name, const std::string& text, int steps) {
  const auto with = [&](const std::string& scheme) {
    return make_scene("scheme = { low_mach = \"off\", " + scheme + " }\n" + text, ranks());
  };
  std::array<Scene, 3> scenes{with("order = 1, interface = \"diffuse\""), with("order = 2, interface = \"diffuse\""),
                              with("order = 2, interface = \"sharp\"")};
  std::array<double, 3> seconds;
  seconds.fill(infinity);
  for (int round = 0; round < 6; ++round)  // in turn: a machine that slows down slows all
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      const double of_round = measure(scenes[i], 1, steps).seconds;
      if (round > 0) seconds[i] = std::min(seconds[i], of_round);
    }
  std::cout << fmt::format("{:<34} {:>8} {:>9.2f}", name, scenes[0].mesh.n_global, seconds[1] / seconds[0]);
  if (scenes[0].solver->fields().multiphase()) std::cout << fmt::format(" {:>9.2f}", seconds[2] / seconds[0]);
  std::cout << std::endl;
}

std::string scene(const std::string& mesh, const std::string& phases, const std::string& regions) {
  return "mesh = \"@" + mesh + "\"\nend_time = 1e9\n" + phases + regions + "[boundary]\n\"*\" = \"wall\"\n";
}

const std::string solid = "[phase.aluminium]\nmaterial = \"aluminium\"\n", gas = "[phase.air]\nmaterial = \"air\"\n",
                  copper = "[phase.copper]\nmaterial = \"copper\"\n",
                  nothing = "[phase.surroundings]\nvoid = { pressure = 1e5 }\n";

std::string fill(const std::string& shape, const std::string& phase, const std::string& velocity) {
  return "[[region]]\n" + shape + "\nfill = \"" + phase + "\"\npressure = 1e5\n" +
         (velocity.empty() ? "" : "velocity = [" + velocity + "]\n");
}

}  // namespace

int main() {
  int no_arguments = 0;
  char** arguments = nullptr;
  const Mpi mpi(no_arguments, arguments);
  const auto mesh = [](const std::string& file, int n, int element) {
    return file + ".geo\"\nmesh_parameters = { n = " + std::to_string(n) + ", element = " + std::to_string(element) +
           " }\n#\"";
  };
  const std::string triangles = mesh("box", 200, 3), hexahedra = mesh("box_space", 40, 8),
                    tetrahedra = mesh("box_space", 26, 4);
  const std::string all = "shape = \"everywhere\"";
  const std::string disc = "shape = \"sphere\"\ncenter = [0.5, 0.5]\nradius = 0.3",
                    ball = "shape = \"sphere\"\ncenter = [0.5, 0.5, 0.5]\nradius = 0.3";
  std::cout << fmt::format("{} lanes; one core; the fastest of five rounds\n", pack_width)
            << fmt::format("{:<34} {:>8} {:>4} {:>6} {:>9} {:>9} {:>9} {:>7} {:>7} {:>6}\n", "scene", "cells", "eqs",
                           "B/cell", "ns/cell", "ns/c/eq", "sweep", "sweep", "step", "in")
            << fmt::format("{:<34} {:>8} {:>4} {:>6} {:>9} {:>9} {:>9} {:>7} {:>7} {:>6}\n", "", "", "", "", "", "",
                           "ns/face", "gain", "gain", "packs%");
  benchmark("plane, triangles: gas", scene(triangles, gas, fill(all, "air", "\"100*y\", 0")), 40);
  benchmark("plane, triangles: solid", scene(triangles, solid, fill(all, "aluminium", "\"100*y\", 0")), 40);
  benchmark("plane, triangles: solid in gas",
            scene(triangles, solid + gas, fill(all, "air", "") + fill(disc, "aluminium", "100, 20")), 40);
  benchmark("plane, triangles: solid in void",
            scene(triangles, solid + nothing, fill(all, "surroundings", "") + fill(disc, "aluminium", "100, 20")), 40);
  benchmark("plane, triangles: solid in solid",
            scene(triangles, solid + copper, fill(all, "copper", "") + fill(disc, "aluminium", "100, 20")), 40);
  benchmark("space, hexahedra: gas", scene(hexahedra, gas, fill(all, "air", "\"100*y\", 0, 0")), 20);
  benchmark("space, hexahedra: solid", scene(hexahedra, solid, fill(all, "aluminium", "\"100*y\", 0, 0")), 20);
  benchmark("space, tetrahedra: solid", scene(tetrahedra, solid, fill(all, "aluminium", "\"100*y\", 0, 0")), 20);
  benchmark("plane, triangles: solid, in cache",
            scene(mesh("box", 30, 3), solid, fill(all, "aluminium", "\"100*y\", 0")), 400);
  benchmark("space, hexahedra: solid, in cache",
            scene(mesh("box_space", 12, 8), solid, fill(all, "aluminium", "\"100*y\", 0, 0")), 400);
  benchmark("space, hexahedra: solid in gas",
            scene(hexahedra, solid + gas, fill(all, "air", "") + fill(ball, "aluminium", "100, 20, 0")), 20);
  benchmark("space, hexahedra: solid in void",
            scene(hexahedra, solid + nothing, fill(all, "surroundings", "") + fill(ball, "aluminium", "100, 20, 0")),
            20);

  std::cout << fmt::format("\n{:<34} {:>8} {:>9} {:>9}\n", "a step of order 2, in ones of order 1", "cells", "diffuse",
                           "sharp");
  benchmark_orders("plane, triangles: solid", scene(triangles, solid, fill(all, "aluminium", "\"100*y\", 0")), 20);
  benchmark_orders("plane, triangles: solid in gas",
                   scene(triangles, solid + gas, fill(all, "air", "") + fill(disc, "aluminium", "100, 20")), 20);
  benchmark_orders(
      "plane, triangles: solid in void",
      scene(triangles, solid + nothing, fill(all, "surroundings", "") + fill(disc, "aluminium", "100, 20")), 20);
  benchmark_orders("space, hexahedra: solid", scene(hexahedra, solid, fill(all, "aluminium", "\"100*y\", 0, 0")), 10);
  benchmark_orders("space, tetrahedra: solid", scene(tetrahedra, solid, fill(all, "aluminium", "\"100*y\", 0, 0")), 10);
  benchmark_orders("space, hexahedra: solid in gas",
                   scene(hexahedra, solid + gas, fill(all, "air", "") + fill(ball, "aluminium", "100, 20, 0")), 10);
  benchmark_orders(
      "space, hexahedra: solid in void",
      scene(hexahedra, solid + nothing, fill(all, "surroundings", "") + fill(ball, "aluminium", "100, 20, 0")), 10);
}
