#include <algorithm>
#include <catch2/catch.hpp>
#include <random>
#include <sstream>

#include "app/atomic_file.hpp"
#include "app/mixture.hpp"
#include "app/output.hpp"
#include "app/sampler.hpp"
#include "math/errors.hpp"
#include "mesh/read_mesh.hpp"
#include "output_scene.hpp"

namespace cobasis::test {
namespace {

std::vector<std::int32_t> cells_at(const Mesh& mesh, std::vector<Point> points) {
  const Sampler sampler(mesh, world(), points, "line 'axis'");
  std::vector<double> found(sampler.cells().begin(), sampler.cells().end());
  found = sampler.in_order(world(), found);
  return {found.begin(), found.end()};
}

TEST_CASE("a point belongs to the cell around it, on a face to the smaller global id, on the boundary to its cell") {
  const double h = GENERATE(1.0, 1e-6, 1.0 / 3.0, 1e5);
  Mesh mesh = squares(4, 3, h);
  for (const bool renumbered : {false, true}) {
    CHECK(cells_at(mesh, points_on_line({0.5 * h, 0.5 * h, 0}, {3.5 * h, 0.5 * h, 0}, 4)) == std::vector{0, 1, 2, 3});
    // x = 0, h, 2h, 3h, 4h at mid height of the second row; then the corner shared by cells 0, 1, 4 and 5
    const std::vector<int> on_faces = renumbered ? std::vector{4, 5, 6, 7, 7} : std::vector{4, 4, 5, 6, 7};
    CHECK(cells_at(mesh, points_on_line({0, 1.5 * h, 0}, {4 * h, 1.5 * h, 0}, 5)) == on_faces);
    CHECK(cells_at(mesh, {{h, h, 0}}) == std::vector{renumbered ? 5 : 0});
    CHECK(cells_at(mesh, {{4 * h, 3 * h * (1 + 1e-15), 0}}) == std::vector{11});
    for (auto& id : mesh.global_id) id = 11 - id;
  }
}

TEST_CASE("samples along any direction are those of the cells the points lie in") {
  const Mesh mesh = squares(7, 5, 1);
  const Point ends[][2] = {
      {{0.1, 0.2, 0}, {6.9, 4.7, 0}}, {{6.9, 0.3, 0}, {0.2, 4.9, 0}}, {{2.5, 4.9, 0}, {2.5, 0.1, 0}}};
  for (const auto& [from, to] : ends) {
    const auto points = points_on_line(from, to, 57);
    const auto cells = cells_at(mesh, points);
    REQUIRE(cells.size() == points.size());
    for (std::size_t p = 0; p < points.size(); ++p) {
      CHECK(cells[p] == static_cast<int>(points[p].x) + 7 * static_cast<int>(points[p].y));
    }
  }
}

/// n^3 hexahedra in the unit cube as MSH 2.2; inner corners moved by up to a quarter of a cell, so that faces are
/// warped.
std::string warped_msh(int n) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> shift(-0.25, 0.25);
  std::ostringstream nodes, elements;
  const auto node = [&](int i, int j, int k) { return 1 + i + (n + 1) * (j + (n + 1) * k); };
  const auto inner = [&](int i) { return i > 0 && i < n; };
  for (int k = 0; k <= n; ++k) {
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i) {
        const bool moves = inner(i) && inner(j) && inner(k);
        nodes << node(i, j, k);
        for (const int c : {i, j, k}) nodes << ' ' << (c + (moves ? shift(random) : 0)) / n;
        nodes << '\n';
      }
    }
  }
  int count = 0;
  const auto face = [&](int a, int b, int c, int d) {
    elements << ++count << " 3 2 1 1 " << a << ' ' << b << ' ' << c << ' ' << d << '\n';
  };
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      for (const int e : {0, n}) {
        face(node(e, i, j), node(e, i + 1, j), node(e, i + 1, j + 1), node(e, i, j + 1));
        face(node(i, e, j), node(i + 1, e, j), node(i + 1, e, j + 1), node(i, e, j + 1));
        face(node(i, j, e), node(i + 1, j, e), node(i + 1, j + 1, e), node(i, j + 1, e));
      }
    }
  }
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        elements << ++count << " 5 2 2 1";
        for (const int top : {0, 1}) {
          elements << ' ' << node(i, j, k + top) << ' ' << node(i + 1, j, k + top) << ' ' << node(i + 1, j + 1, k + top)
                   << ' ' << node(i, j + 1, k + top);
        }
        elements << '\n';
      }
    }
  }
  std::ostringstream text;
  text << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 1 \"outside\"\n3 2 \"inside\"\n"
       << "$EndPhysicalNames\n$Nodes\n"
       << (n + 1) * (n + 1) * (n + 1) << '\n'
       << nodes.str() << "$EndNodes\n"
       << "$Elements\n"
       << count << '\n'
       << elements.str() << "$EndElements\n";
  return text.str();
}

TEST_CASE("no point falls between warped faces, none far from its cell, none from outside is taken in") {
  const Scratch scratch;
  MeshRequest request;
  request.file = (scratch.path / "warped.msh").string();
  write_atomically(request.file, warped_msh(6));
  const Mesh mesh = read_mesh(request, world());
  for (int line = 0; line < 40; ++line) {
    const double a = line / 39.0;
    const auto points = points_on_line({0, a, 1 - a * a}, {1, 1 - a, a * a}, 500);
    const auto cells = cells_at(mesh, points);
    REQUIRE(cells.size() == points.size());
    double farthest = 0;  // squared, in cells
    for (std::size_t p = 0; p < points.size(); ++p) {
      const Point away = 6.0 * (points[p] - mesh.centroid[cells[p]]);
      farthest = std::max(farthest, dot(away, away));
    }
    CHECK(farthest < 1.2 * 1.2);
  }
  CHECK_THROWS_AS(cells_at(mesh, {{0.5, 0.5, 1.0001}}), InputError);
  CHECK_THROWS_AS(cells_at(mesh, {{0.5, 1.5, 0.5}}), InputError);
}

TEST_CASE("a point outside the mesh is refused with its line and place") {
  const Mesh mesh = squares(4, 3, 1);
  const auto outside = GENERATE(Point{4.001, 1, 0}, Point{-1e-6, 1, 0}, Point{2, 3.5, 0}, Point{2, 1, 0.25});
  CHECK_THROWS_AS(cells_at(mesh, {outside}), InputError);
  CHECK_THROWS_WITH(cells_at(mesh, points_on_line({2, 1, 0}, {9, 1, 0}, 8)),
                    "line 'axis': the point (5, 1, 0) lies outside the mesh");
}

TEST_CASE("the far side of a periodic face is outside, the near side inside") {
  Mesh mesh = squares(4, 2, 1, true);
  CHECK(cells_at(mesh, points_on_line({0, 0.5, 0}, {4, 0.5, 0}, 9)) == std::vector{0, 0, 0, 1, 1, 2, 2, 3, 3});
  CHECK_THROWS_AS(cells_at(mesh, {{4.01, 0.5, 0}}), InputError);
  for (auto& id : mesh.global_id) id = 7 - id;
  CHECK(cells_at(mesh, {{3, 0.5, 0}}) == std::vector{3});
}

TEST_CASE("the mixture is weighted by volume for stress and pressure, by mass for velocity, and a void is its pressure") {
  const Setup setup = three_phases("unused");
  const Snapshot snapshot = three_phase_state(4, 0);
  const Mixture mixture = mix(snapshot, setup.phases);
  // third cell: 1/2 copper (rho 101.25, u 110.25 111.25 112.25, p 120.25), 1/4 gas (201.25, 210.25 ..., 220.25), 1/4
  // void
  CHECK(mixture.density[2] == Approx(0.5 * 101.25 + 0.25 * 201.25).epsilon(1e-15));
  CHECK(mixture.velocity[1][2] ==
        Approx((0.5 * 101.25 * 111.25 + 0.25 * 201.25 * 211.25) / (0.5 * 101.25 + 0.25 * 201.25)).epsilon(1e-15));
  CHECK(mixture.pressure[2] == 0.5 * 120.25 + 0.25 * 220.25 + 0.25 * 10);
  CHECK(mixture.stress[1][2] == 0.5 * 131.25 + 0.25 * 231.25 - 0.25 * 10);
  CHECK(mixture.stress[3][2] == 0.5 * 133.25 + 0.25 * 233.25);
  // first cell: copper alone
  CHECK(mixture.density[0] == 101);
  CHECK(mixture.velocity[0][0] == 110);
  CHECK(mixture.stress[5][0] == 135);
}

TEST_CASE("where there is only void the mixture is at its pressure and at rest") {
  Setup setup = three_phases("unused");
  Snapshot snapshot = three_phase_state(4, 0);
  for (std::size_t k = 0; k < 3; ++k) snapshot.phases[k].alpha[3] = k == 2 ? 1 : 0;
  const Mixture mixture = mix(snapshot, setup.phases);
  CHECK(mixture.density[3] == 0);
  CHECK(mixture.velocity[0][3] == 0);
  CHECK(mixture.pressure[3] == 10);
  CHECK(mixture.stress[0][3] == -10);
  CHECK(mixture.stress[3][3] == 0);
}

TEST_CASE("a line's table has coordinates, phases in order, then the mixture, and nan where a phase is absent") {
  const Scratch scratch;
  const Mesh mesh = squares(4, 1, 1);
  Setup setup = three_phases(scratch.path);
  setup.output.fields = {"alpha", "density", "velocity", "stress", "cobasis"};
  setup.lines = {{"axis", {0.5, 0.5, 0}, {3.5, 0.5, 0}, 4}};
  Output output(setup, Geometry::plane, mesh, world());
  output.write(three_phase_state(4, 0));
  output.write(three_phase_state(4, 0.1));
  const auto rows = table(read(scratch.path / "axis.csv"));
  REQUIRE(rows.size() == 5);
  const std::vector<std::string> expected = {"x",
                                             "y",
                                             "z",
                                             "alpha.copper",
                                             "density.copper",
                                             "velocity.copper.x",
                                             "velocity.copper.y",
                                             "velocity.copper.z",
                                             "stress.copper.xx",
                                             "stress.copper.yy",
                                             "stress.copper.zz",
                                             "stress.copper.xy",
                                             "stress.copper.yz",
                                             "stress.copper.xz",
                                             "cobasis.copper.e1.x",
                                             "cobasis.copper.e1.y",
                                             "cobasis.copper.e1.z",
                                             "cobasis.copper.e2.x",
                                             "cobasis.copper.e2.y",
                                             "cobasis.copper.e2.z",
                                             "cobasis.copper.e3.x",
                                             "cobasis.copper.e3.y",
                                             "cobasis.copper.e3.z",
                                             "alpha.gas",
                                             "density.gas",
                                             "velocity.gas.x",
                                             "velocity.gas.y",
                                             "velocity.gas.z",
                                             "stress.gas.xx",
                                             "stress.gas.yy",
                                             "stress.gas.zz",
                                             "stress.gas.xy",
                                             "stress.gas.yz",
                                             "stress.gas.xz",
                                             "alpha.outside",
                                             "density",
                                             "velocity.x",
                                             "velocity.y",
                                             "velocity.z",
                                             "stress.xx",
                                             "stress.yy",
                                             "stress.zz",
                                             "stress.xy",
                                             "stress.yz",
                                             "stress.xz"};
  CHECK(rows[0] == expected);
  CHECK(cell_of(rows, 2, "x") == "1.5");
  CHECK(cell_of(rows, 2, "velocity.copper.y") == "111.125");
  CHECK(cell_of(rows, 2, "density.gas") == "nan");
  CHECK(cell_of(rows, 2, "alpha.gas") == "0");
  CHECK(cell_of(rows, 3, "alpha.outside") == "0.25");
  CHECK(cell_of(rows, 4, "stress.yz") == cell_of(rows, 4, "stress.gas.yz"));
  CHECK(read(scratch.path / "axis.csv") == read(scratch.path / "lines/axis_0001.csv"));
  const std::string series = read(scratch.path / "axis.series");
  CHECK(read(scratch.path / "axis.csv.series") == series);
  CHECK_THAT(series, Catch::Contains("\"name\": \"lines/axis_0000.csv\", \"time\": 0 }"));
  CHECK_THAT(series, Catch::Contains("\"name\": \"lines/axis_0001.csv\", \"time\": 0.1 }"));
}

TEST_CASE("a scene of one phase has no volume fraction") {
  const Scratch scratch;
  const Mesh mesh = squares(4, 1, 1);
  Setup setup = three_phases(scratch.path);
  setup.phases.resize(1);
  setup.lines = {{"axis", {0.5, 0.5, 0}, {3.5, 0.5, 0}, 4}};
  Snapshot snapshot;
  snapshot.phases = {phase_state("copper", {1, 1, 1, 1}, 0, true)};
  Output output(setup, Geometry::plane, mesh, world());
  output.write(snapshot);
  const auto rows = table(read(scratch.path / "axis.csv"));
  CHECK(cell_of(rows, 1, "alpha.copper") == "no such column");
  CHECK(cell_of(rows, 3, "density.copper") == "1.25");
  CHECK(cell_of(rows, 3, "density") == "1.25");
}

}  // namespace
}  // namespace cobasis::test
