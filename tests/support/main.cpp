// Runs the tests on all ranks alike; the first rank reports, the others only what failed on them.
#define CATCH_CONFIG_RUNNER
#define CATCH_CONFIG_NOSTDOUT  // Catch::cout is ours
#include <catch2/catch.hpp>
#include <cstdio>
#include <iostream>
#include <sstream>

#include "mesh/mpi.hpp"

namespace {

std::ostringstream& kept() {
  static std::ostringstream stream;
  return stream;
}
bool keep_output = false;

}  // namespace

namespace Catch {

std::ostream& cout() { return keep_output ? kept() : std::cout; }
std::ostream& cerr() { return std::cerr; }
std::ostream& clog() { return std::clog; }

}  // namespace Catch

int main(int argc, char** argv) {
  const cobasis::Mpi mpi(argc, argv);
  keep_output = !mpi.root();
  const int failed = Catch::Session().run(argc, argv);
  if (failed != 0 && !mpi.root()) std::fprintf(stderr, "rank %d:\n%s", mpi.rank(), kept().str().c_str());
  return mpi.any(failed != 0) ? 1 : 0;
}
