// A case from its file to its results.
#pragma once

#include "app/command_line.hpp"
#include "mesh/mpi.hpp"

namespace cobasis {

/// `cobasis run`. Collective. Throws InputError, SystemError, Unphysical.
void run_case(const CommandLine& command, const Mpi& mpi);

/// `cobasis check`: validates case and mesh, and says what the scene requires. Collective.
void check_case(const CommandLine& command, const Mpi& mpi);

}  // namespace cobasis
