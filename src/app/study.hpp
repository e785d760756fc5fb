// How far a case's numbers are from those of an infinitely fine mesh, and what it costs to get closer.
#pragma once

#include "app/command_line.hpp"
#include "mesh/mpi.hpp"

namespace cobasis {

/// `cobasis study`: runs the case on a sequence of meshes, coarse to fine, each into mesh_<i> of the output directory;
/// then leaves study.csv, meshes.csv, forecast.csv and study.png there. Collective. Throws InputError, SystemError,
/// Unphysical.
void study_case(const CommandLine& command, const Mpi& mpi);

}  // namespace cobasis
