// Runs a function in a child process, so that a crash or an exit inside a library becomes an error we can report.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace cobasis {

struct ChildLimits {
  std::size_t extra_memory = 0;  ///< bytes the child may allocate beyond what the process holds; 0: no limit
  bool no_side_effects = false;  ///< the system refuses to start programs and to create, change or delete
  ///< files, where it can (seccomp)
};

struct ChildResult {
  std::vector<char> bytes;  ///< what the function returned
  std::string error;        ///< text of the exception that left the function, or how the child died; empty: none
};

/// The child must not use MPI; what it prints is dropped. Throws SystemError if no child can be started.
ChildResult run_in_child(const std::function<std::vector<char>()>& work, const ChildLimits& limits);

}  // namespace cobasis
