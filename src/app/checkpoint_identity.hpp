// What a case and a mesh are to a checkpoint: what must be the same for a run to go on.
#pragma once

#include <string>

#include "mesh/mesh.hpp"
#include "mesh/mpi.hpp"
#include "solver/setup.hpp"

namespace cobasis {

/// Number of cells and a checksum over volumes, centroids, faces, neighbours and groups; the same for any partition.
/// Collective.
std::string identity_of(const Mesh& mesh, const Mpi& mpi);

/// The keys of the case and their values, a line each, without those that may change: the mesh's (it has its own
/// identity), end_time, max_steps, cfl, checkpoint_every, title, the output directory and when there is output.
std::string identity_of(const Setup& setup, Geometry geometry);

/// Which lines differ, in words: "phase.copper.elastic.mu = 2 instead of 1; ...".
std::string differences(const std::string& before, const std::string& now);

}  // namespace cobasis
