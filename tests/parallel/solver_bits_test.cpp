// The same results to the last bit, whoever owns which cell.
#include <catch2/catch.hpp>
#include <chrono>
#include <random>
#include <thread>

#include "support/scene.hpp"

using namespace cobasis;
using namespace cobasis::test;

namespace {

/// The state after some steps of the case on the first `n` ranks of this test; empty on the others.
std::vector<std::vector<double>> state_on(int n, std::int64_t steps, const std::string& name,
                                          const std::vector<std::pair<std::string, std::string>>& set,
                                          const SceneOptions& options = {}) {
  MPI_Comm comm;
  MPI_Comm_split(MPI_COMM_WORLD, ranks().rank() < n ? 0 : MPI_UNDEFINED, ranks().rank(), &comm);
  std::vector<std::vector<double>> state;
  if (comm != MPI_COMM_NULL) {
    const Mpi mpi(comm);
    Scene scene = make_case(name, set, mpi, options);
    scene.run(steps);
    CHECK(scene.solver->step() == steps);
    state = state_by_global_cell(scene, mpi);
    MPI_Comm_free(&comm);
  }
  ranks().barrier();
  return state;
}

void check_bits(std::int64_t steps, const std::string& name,
                const std::vector<std::pair<std::string, std::string>>& set) {
  const auto serial = state_on(1, steps, name, set);
  if (ranks().root()) REQUIRE(serial.size() > 100);
  for (int n = 2; n <= ranks().size(); ++n) {
    CAPTURE(name, n);
    const bool same = state_on(n, steps, name, set) == serial;
    if (ranks().root()) CHECK(same);
  }
  SceneOptions options;
  options.partition = [](std::int64_t cell, int parts) { return static_cast<int>(std::mt19937(cell)() % parts); };
  const bool same = state_on(ranks().size(), steps, name, set, options) == serial;
  if (ranks().root()) CHECK(same);
}

}  // namespace

TEST_CASE("500 steps of the droplet give the same bits on any number of ranks and for a random partition") {
  check_bits(500, "droplet", {{"mesh_parameters.h", "1e-3"}});
  check_bits(60, "droplet", {{"mesh_parameters.h", "1e-3"}, {"mesh_parameters.element", "4"}});
}

TEST_CASE("two solids, and a solid in gas, give the same bits on any number of ranks") {
  check_bits(150, "impact",
             {{"end_time", "1"},
              {"mesh", "../meshes/box.geo"},
              {"mesh_parameters", "{ n = 20, element = 3 }"},
              {"boundary.bottom", "wall"},
              {"boundary.top", "wall"},
              {"region.1.normal", "[-0.866, -0.5]"},
              {"region.1.point", "[0.5, 0.5]"}});
  check_bits(150, "advection", {{"mesh_parameters", "{ n = 100, element = 3 }"}});
}

TEST_CASE("faces inside a rank are swept while the halo of a late neighbour is on its way") {
  constexpr auto delay = std::chrono::milliseconds(300);
  SceneOptions options;
  options.solver.before_halo_send = [&] {
    if (ranks().rank() == 1) std::this_thread::sleep_for(delay);
  };
  Scene scene = make_case("shear", {{"mesh_parameters", "{ n = 300 }"}}, ranks(), options);
  scene.run(1);
  bool waits_for_one = false;
  for (const Neighbour& neighbour : scene.mesh.neighbours) waits_for_one = waits_for_one || neighbour.rank == 1;
  CHECK(ranks().any(waits_for_one));
  const double late = std::chrono::duration<double>(delay).count();
  if (waits_for_one) {
    CHECK(scene.solver->clock().inside_swept < 0.5 * late);
    CHECK(scene.solver->clock().halo_received > 0.9 * late);
  }
}
