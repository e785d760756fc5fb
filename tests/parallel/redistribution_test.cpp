// Averages and exchanges of volumes between ranks: the same bits, whoever owns which cell.
#include "solver/redistribution.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <map>
#include <numeric>

#include "../unit/solver/sample_fields.hpp"
#include "mesh/read_mesh.hpp"
#include "solver/volume_exchange.hpp"
#include "support/scene.hpp"

using namespace cobasis;
using namespace cobasis::test;

namespace {

/// What happened, summed over ranks.
struct Events {
  std::int64_t merged, alone, apart, exchanges, kept, dust;
  bool operator==(const Events&) const = default;
};

struct Outcome {
  std::map<double, std::vector<double>> state;  ///< of each cell, by global number; on rank 0
  Events events;
};

/// Of each phase and component over all ranks: content, and the sum of its magnitudes.
std::vector<std::pair<double, double>> totals(const Fields& fields, const Mpi& mpi) {
  std::vector<std::pair<double, double>> sums;
  for (int k = 0; k < fields.n_phases(); ++k)
    for (int c = 0; c < fields.phases[k].n_conserved(); ++c) {
      const auto [sum, scale] = content(fields, k, c);
      sums.emplace_back(mpi.exact_sum(std::array{sum}), mpi.exact_sum(std::array{scale}));
    }
  return sums;
}

void check_same(const std::vector<std::pair<double, double>>& a, const std::vector<std::pair<double, double>>& b,
                double tolerance) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    CAPTURE(i);
    CHECK(std::fabs(a[i].first - b[i].first) < tolerance * b[i].second);
  }
}

/// Three times over on the ranks of `mpi`: redistribution, then the exchange of small volumes.
Outcome outcome(const MeshRequest& request, const Mpi& mpi) {
  const Mesh mesh = read_mesh(request, mpi);
  const Faces faces = make_faces(mesh);
  Fields fields = random_fields(mesh, true);
  Redistribution redistribution(mpi, mesh, fields);
  VolumeExchange exchange(mpi, mesh, fields, sharp_exchange);
  std::vector<std::int32_t> candidates(mesh.n_owned);
  std::iota(candidates.begin(), candidates.end(), 0);
  const auto contents = totals(fields, mpi);
  for (int i = 0; i < 3; ++i) {
    redistribution.run(mesh, faces, fields, candidates);
    check_same(totals(fields, mpi), contents, i == 0 ? 1e-14 : 1e-10);
    exchange.run(mesh, faces, fields, 1, candidates, {});  // sweeps up volumes below 1e-11, and their cobasis
    check_same(totals(fields, mpi), contents, 1e-10);
  }
  std::vector<double> own;
  std::size_t size = 0;
  for (std::int32_t cell = 0; cell < mesh.n_owned; ++cell) {
    const std::size_t before = own.size();
    own.push_back(static_cast<double>(mesh.global_id[cell]));
    for (const Phase& phase : fields.phases) {
      own.push_back(phase.alpha[cell]);
      for (const auto& component : phase.conserved) own.push_back(component[cell]);
    }
    size = own.size() - before;
  }
  CHECK(std::none_of(own.begin(), own.end(), [](double value) { return std::isnan(value); }));
  Outcome result;
  const std::vector<double> all = mpi.gather(own);
  size = static_cast<std::size_t>(mpi.max(static_cast<double>(size)));
  for (std::size_t at = 0; at < all.size(); at += size)
    result.state.emplace(all[at], std::vector<double>(&all[at] + 1, &all[at] + size));
  const RedistributionCounters& r = redistribution.counters();
  const ExchangeCounters& e = exchange.counters();
  result.events = {mpi.sum(r.merged),    mpi.sum(r.alone), mpi.sum(r.apart),
                   mpi.sum(e.exchanges), mpi.sum(e.kept),  mpi.sum(e.dust)};
  return result;
}

Outcome outcome_on(int n, const MeshRequest& request) {
  MPI_Comm comm;
  MPI_Comm_split(MPI_COMM_WORLD, ranks().rank() < n ? 0 : MPI_UNDEFINED, ranks().rank(), &comm);
  Outcome result{};
  if (comm != MPI_COMM_NULL) {
    result = outcome(request, Mpi(comm));
    MPI_Comm_free(&comm);
  }
  ranks().barrier();
  return result;
}

void check_bits(MeshRequest request) {
  const Outcome serial = outcome_on(1, request);
  if (ranks().root()) {
    CHECK(serial.events.merged > 0);
    CHECK(serial.events.exchanges > 0);
    CHECK(serial.events.kept > 0);
  }
  for (int n = 2; n <= 2 * ranks().size(); ++n) {
    if (n > ranks().size())
      request.partition = [n](std::int64_t cell, int parts) {
        return static_cast<int>(std::mt19937(n * cell)() % parts);
      };
    CAPTURE(n);
    const Outcome parallel = outcome_on(std::min(n, ranks().size()), request);
    if (ranks().root()) {
      CHECK(parallel.state == serial.state);
      CHECK(parallel.events == serial.events);
    }
  }
}

}  // namespace

TEST_CASE("redistribution and exchange of small volumes give the same bits on any number of ranks") {
  MeshRequest request;
  request.file = SOURCE_DIR "/meshes/box.geo";
  SECTION("triangles") { request.parameters = {{"n", 20}, {"element", 3}}; }
  SECTION("hexahedra, periodic") {
    request.file = SOURCE_DIR "/meshes/box_space.geo";
    request.parameters = {{"n", 6}};
    request.periodic = {{"left", "right"}};
  }
  SECTION("two cells high and periodic, so that pairs of cells share two faces") {
    request.parameters = {{"n", 100}, {"length", 50}};
    request.periodic = {{"bottom", "top"}};
  }
  check_bits(request);
}
