// A case from its file to its results.
#pragma once

#include <cstdint>
#include <vector>

#include "app/command_line.hpp"
#include "mesh/mesh.hpp"
#include "mesh/mpi.hpp"
#include "solver/setup.hpp"
#include "solver/snapshot.hpp"

namespace cobasis {

/// A case on its mesh, ready to be computed.
struct Scene {
  Setup setup;
  Geometry geometry = Geometry::plane;
  Mesh mesh;
  double seconds = 0;  ///< that it took to get here
};

/// The mesh is cut `splits` times. Collective. Throws InputError.
Scene open_scene(const Setup& setup, bool trust_geo, int splits, const Mpi& mpi);

/// What a run says on standard output.
enum class Speech {
  all,        ///< what the scene requires, progress, integrals, the line for programs
  progress,   ///< alone
  last_line,  ///< alone: for programs
  nothing
};

struct RunOptions {
  Speech speech = Speech::all;
  bool checkpoints = false;
  bool restart = false;  ///< from the newest of them
};

/// Seconds are this rank's, of the wall clock.
struct RunResult {
  std::int64_t steps = 0, rows = 0;  ///< rows: of the history
  double step_seconds = 0, history_seconds = 0, other_seconds = 0;
  std::vector<Column> values;  ///< at the end: integrals and, on rank 0, probes
};

/// Computes the scene and writes its outputs; with the fields before the step, if one turns unphysical. Collective.
/// Throws InputError, SystemError, Unphysical.
RunResult run_scene(const Scene& scene, const Mpi& mpi, const RunOptions& options);

/// `cobasis run`. Collective. Throws InputError, SystemError, Unphysical.
void run_case(const CommandLine& command, const Mpi& mpi);

/// `cobasis check`: validates case and mesh, and says what the scene requires. Collective.
void check_case(const CommandLine& command, const Mpi& mpi);

}  // namespace cobasis
