// A case from its text to a solver, as the program does it, for tests that look at cells.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/case.hpp"
#include "mesh/read_mesh.hpp"
#include "solver/solver.hpp"

namespace cobasis::test {

/// All ranks of the test.
const Mpi& ranks();

/// First order with diffuse interfaces: at the head of a case's text, and as a change to a case.
inline const std::string first_order = "scheme = { order = 1, interface = \"diffuse\", low_mach = \"off\" }\n";
inline const std::pair<std::string, std::string> set_first_order{
    "scheme", "{ order = 1, interface = \"diffuse\", low_mach = \"off\" }"};
/// Second order with sharp interfaces.
inline const std::string second_order = "scheme = { order = 2, interface = \"sharp\" }\n";
inline const std::pair<std::string, std::string> set_second_order{"scheme", "{ order = 2, interface = \"sharp\" }"};

struct SceneOptions {
  SolverOptions solver;
  std::function<int(std::int64_t, int)> partition;
  std::function<void(Mesh&)> change_mesh;  ///< before the solver sees it
};

struct Scene {
  Setup setup;
  Mesh mesh;
  std::unique_ptr<Solver> solver;

  /// Steps to the case's end time, or at most this many.
  void run(std::int64_t steps = 1 << 30);
};

/// `text`: a case file; `mesh = "@box.geo"` names one of the project's meshes. Collective.
Scene make_scene(const std::string& text, const Mpi& mpi, const SceneOptions& options = {});

/// One of the project's cases with changes, as `cobasis run cases/NAME.toml --set …`.
Scene make_case(const std::string& name, const std::vector<std::pair<std::string, std::string>>& set, const Mpi& mpi,
                const SceneOptions& options = {});

/// Every conserved quantity, volume fraction and cobasis component of every cell, by global id, on rank 0.
std::vector<std::vector<double>> state_by_global_cell(const Scene& scene, const Mpi& mpi);

/// Sum over the rank's owned cells of volume times value, over the sum of volumes, over all ranks.
double mean(const Scene& scene, const Mpi& mpi, const std::function<double(std::int32_t cell)>& value);

double total(const Solver& solver, const std::string& column);

}  // namespace cobasis::test
