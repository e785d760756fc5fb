#include "solver/redistribution.hpp"

#include <catch2/catch.hpp>
#include <numeric>

#include "sample_fields.hpp"
#include "small_scene.hpp"

using namespace cobasis;

namespace {

RedistributionCounters redistribute(const Mesh& mesh, Fields& fields, int times = 1) {
  const Faces faces = make_faces(mesh);
  Redistribution redistribution(one_rank(), mesh, fields);
  std::vector<std::int32_t> candidates(mesh.n_owned);
  std::iota(candidates.begin(), candidates.end(), 0);
  for (int i = 0; i < times; ++i) redistribution.run(mesh, faces, fields, candidates);
  return redistribution.counters();
}

std::vector<double> owned(const Mesh& mesh, const AlignedVector<double>& values) {
  return {values.begin(), values.begin() + mesh.n_owned};
}

/// One fluid in rectangles of height 1, and the void; the cells' states are `Q`, in all components.
struct Row {
  Mesh mesh;
  Fields fields;
  std::vector<std::int32_t> cell;

  Row(const std::vector<double>& x, const std::vector<double>& alpha, const std::vector<double>& Q)
      : mesh(strip(x)), fields(empty_fields(mesh)) {
    for (std::size_t i = 0; i < alpha.size(); ++i) {
      cell.push_back(cell_at(mesh, 0.5 * (x[i] + x[i + 1])));
      fields.phases[0].alpha[cell[i]] = alpha[i];
      fields.phases[1].alpha[cell[i]] = 0;
      fields.phases[2].alpha[cell[i]] = 1 - alpha[i];
      for (int c = 0; c < 4; ++c) set_intensive(fields, 0, c, cell[i], Q[i]);
      for (auto& component : fields.phases[1].conserved) component[cell[i]] = 0;
    }
  }
  RedistributionCounters run() { return redistribute(mesh, fields); }
  void check(const std::vector<double>& Q) const {
    for (std::size_t i = 0; i < Q.size(); ++i)
      for (int c = 0; c < 4; ++c) {
        CAPTURE(i, c);
        CHECK(intensive(fields, 0, c, cell[i]) == Approx(Q[i]).epsilon(1e-14));
      }
  }
};

/// Per cell the smallest and largest Q of a phase among the cell, its neighbours and theirs.
std::array<std::vector<double>, 2> range_around(const Mesh& mesh, const Fields& fields, int k, int c) {
  std::vector<double> low(mesh.n_owned, infinity), high(mesh.n_owned, -infinity);
  for (std::int32_t i = 0; i < mesh.n_owned; ++i)
    if (fields.phases[k].alpha[i] > 0) low[i] = high[i] = intensive(fields, k, c, i);
  for (int ring = 0; ring < 2; ++ring) {
    const auto low_before = low, high_before = high;
    for (std::int32_t f = 0; f < mesh.n_interior_faces; ++f)
      for (const auto& [a, b] : {std::pair(mesh.left[f], mesh.right[f]), std::pair(mesh.right[f], mesh.left[f])}) {
        low[a] = std::min(low[a], low_before[b]);
        high[a] = std::max(high[a], high_before[b]);
      }
  }
  return {low, high};
}

}  // namespace

TEST_CASE("redistribution conserves mass, momentum, energy and volume times cobasis of each phase") {
  for (const CellType type : {CellType::triangle, CellType::hexahedron}) {
    for (const bool negative : {false, true}) {
      const Mesh mesh = small_mesh(type, type == CellType::triangle ? 16 : 7);
      const Fields before = random_fields(mesh, negative);
      Fields fields = random_fields(mesh, negative);
      const RedistributionCounters counters = redistribute(mesh, fields);
      CHECK(counters.merged > 100);
      CHECK(counters.alone > 0);
      for (int k = 0; k < 2; ++k) {
        CHECK(owned(mesh, fields.phases[k].alpha) == owned(mesh, before.phases[k].alpha));
        CHECK(owned(mesh, fields.phases[k].conserved[0]) != owned(mesh, before.phases[k].conserved[0]));
        for (int c = 0; c < fields.phases[k].n_conserved(); ++c) {
          const auto [old_sum, scale] = content(before, k, c);
          CAPTURE(negative, k, c);
          CHECK(std::fabs(content(fields, k, c).first - old_sum) < 1e-14 * scale);
        }
      }
    }
  }
}

TEST_CASE("uniform velocity, pressure and cobasis stay so, whatever the density") {
  constexpr double gamma = 4.4, p_inf = 6e8, p = 1e5, u = 20, v = -7;
  const Mesh mesh = small_mesh(CellType::triangle, 16);
  Fields fields = random_fields(mesh, true);
  for (std::int32_t cell = 0; cell < mesh.n_owned; ++cell)
    for (int k = 0; k < 2; ++k) {
      const double rho = intensive(fields, k, 0, cell);
      set_intensive(fields, k, 1, cell, rho * u);
      set_intensive(fields, k, 2, cell, rho * v);
      set_intensive(fields, k, 3, cell, (p + gamma * p_inf) / (gamma - 1) + rho * (u * u + v * v) / 2);
      for (int c = 4; c < fields.phases[k].n_conserved(); ++c) set_intensive(fields, k, c, cell, 0.3 * c);
    }
  CHECK(redistribute(mesh, fields, 10).merged > 1000);
  for (std::int32_t cell = 0; cell < mesh.n_owned; ++cell)
    for (int k = 0; k < 2; ++k) {
      if (fields.phases[k].alpha[cell] == 0) continue;
      const double rho = intensive(fields, k, 0, cell);
      CHECK(intensive(fields, k, 1, cell) == Approx(rho * u).epsilon(1e-13));
      CHECK(intensive(fields, k, 2, cell) == Approx(rho * v).epsilon(1e-13));
      // to what the energy's digits allow
      const double rho_e = intensive(fields, k, 3, cell) - rho * (u * u + v * v) / 2;
      CHECK(std::fabs((gamma - 1) * rho_e - gamma * p_inf - p) < 1e-14 * gamma * p_inf);
      for (int c = 4; c < fields.phases[k].n_conserved(); ++c)
        CHECK(intensive(fields, k, c, cell) == Approx(0.3 * c).epsilon(1e-13));
    }
}

TEST_CASE("for positive volumes no state leaves the range of those around it") {
  const Mesh mesh = small_mesh(CellType::hexahedron, 7);
  Fields fields = random_fields(mesh, false);
  const Fields before = random_fields(mesh, false);
  redistribute(mesh, fields);
  for (int k = 0; k < 2; ++k)
    for (int c = 0; c < fields.phases[k].n_conserved(); ++c) {
      const auto [low, high] = range_around(mesh, before, k, c);
      for (std::int32_t cell = 0; cell < mesh.n_owned; ++cell) {
        if (fields.phases[k].alpha[cell] == 0) continue;
        const double value = intensive(fields, k, c, cell), margin = 1e-14 * (c == 0 ? 3000 : 3);
        CHECK(value >= low[cell] - margin);
        CHECK(value <= high[cell] + margin);
      }
    }
}

TEST_CASE("a cell that is neither small nor chosen keeps its bits, and so does a small one beside none with more") {
  Row row({0, 1, 2, 3, 4}, {0.3, 0.3, 0, 0.7}, {1.1, 2.3, 0, 7.7});
  const double first = row.fields.phases[0].conserved[0][row.cell[0]],
               last = row.fields.phases[0].conserved[3][row.cell[3]];
  const RedistributionCounters counters = row.run();
  CHECK(row.fields.phases[0].conserved[0][row.cell[0]] == first);
  CHECK(row.fields.phases[0].conserved[3][row.cell[3]] == last);
  CHECK(counters.merged == 0);
  CHECK(counters.alone == 2);
}

TEST_CASE("a chain of ever smaller volumes: each is averaged with the next larger one") {
  // volumes of the phase 1.2, 0.3, 0.1, 0.02, of which 0.55 of a cell misses 0, 0.25, 0.45, 0.53
  Row row({0, 2, 3, 4, 5}, {0.6, 0.3, 0.1, 0.02}, {1, 2, 5, 40});
  const double lent = 0.25 / 1.2;  // by the first; the others then lend half of what they have become
  const double q1 = (0.3 * 2 + 0.25 * 1) / 0.55, q2 = (0.05 * 5 + 0.15 * q1) / 0.2, q3 = (0.02 * 40 + 0.05 * 5) / 0.07;
  CHECK(row.run().merged == 3);
  row.check({(1 - lent) * 1 + lent * q1, (q1 + q2) / 2, (q2 + q3) / 2, q3});
}

TEST_CASE("3 % of a cell have no state to share: what hangs on them takes the mean with the next that has") {
  Row row({0, 2, 3, 4, 5}, {0.6, 0.3, 0.03, 0.02}, {1, 2, 5, 40});
  const double lent = 0.25 / 1.2, q1 = (0.3 * 2 + 0.25 * 1) / 0.55, q2 = (0.03 * 5 + 0.15 * q1) / 0.18;
  const double mean = (0.3 * (q1 + q2) / 2 + 0.03 * q2 + 0.02 * 40) / 0.35;
  CHECK(row.run().merged == 2);
  row.check({(1 - lent) * 1 + lent * q1, mean, mean, mean});
}

TEST_CASE("debris beyond a volume smaller than itself is no part of the body") {
  Row row({0, 1, 2, 3}, {0.6, 0.01, 0.02}, {1, 2, 3});
  const double q = (0.01 * 2 + 0.3 * 1) / 0.31;
  CHECK(row.run().alone == 1);
  row.check({(1 + q) / 2, q, 3});
}

TEST_CASE("a donor lends what brings a small volume to 0.55 of a cell: what nearly is that is hardly averaged") {
  Row row({0, 1, 2}, {0.4, 1}, {3, 1});
  const double q = (0.4 * 3 + 0.15 * 1) / 0.55;
  CHECK(row.run().merged == 1);
  row.check({q, 0.85 * 1 + 0.15 * q});

  constexpr double missing = 1e-6;
  Row nearly({0, 1, 2}, {0.55 - missing, 1}, {3, 1});
  const double mean = ((0.55 - missing) * 3 + missing * 1) / 0.55;
  CHECK(nearly.run().merged == 1);
  nearly.check({mean, (1 - missing) * 1 + missing * mean});

  Row enough({0, 1, 2}, {0.55, 1}, {3, 1});
  CHECK(enough.run().merged == 0);
  enough.check({3, 1});
}

TEST_CASE("a cell chosen by several gives each what it needs, and not more than an equal share") {
  Row row({0, 1, 1.5, 3}, {0.2, 0.9, 0.3}, {3, 1, 8});
  const double q0 = (0.2 * 3 + 0.15 * 1) / 0.35, q2 = (0.45 * 8 + 0.15 * 1) / 0.6;
  CHECK(row.run().merged == 2);
  row.check({q0, (1 + q0 + q2) / 3, q2});

  Row large({0, 1, 3, 4}, {0.2, 0.9, 0.3}, {3, 1, 8});  // 0.35 and 0.25 of the 1.8 in the middle
  const double p0 = (0.2 * 3 + 0.35 * 1) / 0.55, p2 = (0.3 * 8 + 0.25 * 1) / 0.55;
  CHECK(large.run().merged == 2);
  large.check({p0, (1.2 * 1 + 0.35 * p0 + 0.25 * p2) / 1.8, p2});
}

TEST_CASE("the partner is the neighbour with most of the phase, of equals the one with the smaller global number") {
  Row more({0, 1, 2, 3}, {0.6, 0.2, 0.7}, {1, 2, 3});
  more.run();
  const double q = (0.2 * 2 + 0.35 * 3) / 0.55;
  more.check({1, q, (0.35 * 3 + 0.35 * q) / 0.7});

  Row equal({0, 1, 2, 3}, {0.6, 0.2, 0.6}, {1, 2, 3});
  equal.run();
  if (equal.mesh.global_id[equal.cell[0]] < equal.mesh.global_id[equal.cell[2]]) {
    const double mean = (0.2 * 2 + 0.3 * 1) / 0.5;  // a donor lends half of itself at most
    equal.check({(1 + mean) / 2, mean, 3});
  } else {
    const double mean = (0.2 * 2 + 0.3 * 3) / 0.5;
    equal.check({1, mean, (3 + mean) / 2});
  }
}

TEST_CASE("at second order what varies linearly with the middle of the phase stays, the rest keeps the difference") {
  constexpr double alpha = 0.2, slope = 0.3, u = 5, v = -2, E = 27;  // the phase fills 0 … 1 and, of the rest, 1 … 1.2
  constexpr double gamma = 1.4, e = E - 0.5 * (u * u + v * v);
  const auto rho = [](double x) { return 2 + slope * x; };
  for (const double more : {0.0, 0.4}) {  // beyond what the slope says
    Row row({0, 1, 2}, {1, alpha}, {0, 0});
    Phase& phase = row.fields.phases[0];
    using L = Layout<Plane, Kind::fluid>;
    phase.eos = StiffenedGas{gamma, 0};
    phase.centre = CellNumbers(row.mesh.n_all(), 2);
    phase.used_slopes = CellNumbers(row.mesh.n_all(), 2 * L::ch2);
    phase.centre.component(0)[row.cell[1]] = 1 + alpha / 2 - 1.5;
    phase.used_slopes.component(2 * L::rho)[row.cell[0]] = slope;
    phase.used_slopes.component(2 * L::p)[row.cell[0]] = (gamma - 1) * slope * e;  // of constant energy
    const double donor[] = {rho(0.5), u, v, (gamma - 1) * rho(0.5) * e};
    phase.primitive.assign(L::n_primitive, AlignedVector<double>(row.mesh.n_all(), 0));
    for (int c = 0; c < L::ch2; ++c) phase.primitive[c][row.cell[0]] = donor[c];
    const auto set = [&](std::int32_t cell, double density) {
      const double Q[] = {density, density * u, density * v, density * E};
      for (int c = 0; c < 4; ++c) set_intensive(row.fields, 0, c, cell, Q[c]);
    };
    const double beside = rho(1 + alpha / 2);
    set(row.cell[0], rho(0.5)), set(row.cell[1], beside + more);
    CHECK(row.run().merged == 1);
    const double lent = 0.55 - alpha, mean_more = alpha * more / 0.55;
    const double expected[] = {rho(0.5) + lent * mean_more, beside + mean_more};
    for (const int i : {0, 1}) {
      const double Q[] = {expected[i], expected[i] * u, expected[i] * v, expected[i] * E};
      for (int c = 0; c < 4; ++c) {
        CAPTURE(more, i, c);
        CHECK(intensive(row.fields, 0, c, row.cell[i]) == Approx(Q[c]).epsilon(1e-14));
      }
    }
  }
}

TEST_CASE("a negative volume takes the state of its neighbourhood, unless it nearly cancels the neighbour's") {
  Row row({0, 1, 2}, {-1e-3, 0.8}, {3, 1});
  const double q = (-1e-3 * 3 + 0.4 * 1) / 0.399;
  CHECK(row.run().merged == 1);
  row.check({q, (1 + q) / 2});

  for (const double alpha : {0.35, 0.62}) {  // the shares are -0.3 and half of this
    Row cancel({0, 1, 2}, {-0.3, alpha}, {3, 1});
    const RedistributionCounters counters = cancel.run();
    CHECK(counters.merged == 1);
    CHECK(counters.apart == 1);
    cancel.check({3, 1});
  }
}

TEST_CASE("small volumes with only small ones around them have one state with the nearest cell that has enough") {
  const std::vector<double> alpha{1, 0.02, 1e-3, 1e-5, 0}, Q{5, 7, 100, -3, 0};
  Row row({0, 1, 2, 3, 4, 5}, alpha, Q);
  const RedistributionCounters counters = row.run();
  double volume = 0, sum = 0;
  for (std::size_t i = 0; i < alpha.size(); ++i) volume += alpha[i], sum += alpha[i] * Q[i];
  row.check(std::vector<double>(4, sum / volume));
  CHECK(counters.alone == 0);
}
TEST_CASE("a small volume too far from a cell that has enough stays alone") {
  const std::vector<double> Q{5, 5, 5, 5, 5, 40, 60};
  Row row({0, 1, 2, 3, 4, 5, 6, 7}, {1, 2e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7}, Q);
  const RedistributionCounters counters = row.run();
  row.check(Q);
  CHECK(counters.alone == 2);
}
TEST_CASE("a negative volume far from the others joins their state without spoiling it") {
  Row row({0, 1, 2, 3, 4}, {1, 0.02, 1e-3, -1e-5}, {5, 5, 5, 300});
  row.run();
  row.check(std::vector<double>(4, (1.021 * 5 - 1e-5 * 300) / (1.021 - 1e-5)));
}
