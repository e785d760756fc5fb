// What fails on one rank fails on all.
#pragma once

#include <functional>
#include <string>

#include "math/errors.hpp"
#include "mesh/mpi.hpp"

namespace cobasis {

/// Throws SystemError on every rank, with the text of the first rank that has one; nothing if none has. Collective.
void throw_together(const Mpi& mpi, const std::string& error);

/// Runs the action on every rank; what it throws on one becomes SystemError on all. Collective.
void do_together(const Mpi& mpi, const std::function<void()>& action);

}  // namespace cobasis
