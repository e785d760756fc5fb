#include "solver/initial_condition.hpp"

#include <catch2/catch.hpp>

#include "math/errors.hpp"
#include "sample_cells.hpp"

using namespace cobasis;
using Catch::Matchers::Contains;

namespace {

RegionSetup region(Shape shape, std::vector<double> alpha, const std::string& where = "case.toml:1") {
  return {std::move(shape), {alpha, std::vector<PhaseState>(alpha.size())}, where};
}

}  // namespace

TEST_CASE("an interface fitted to the mesh gives exactly pure cells") {
  const Mesh mesh = sample_cells(CellType::triangle, 10);
  const InitialState state =
      paint({region(Everywhere{}, {0, 1}), region(HalfSpace{{0.3, 0, 0}, {-1, 0, 0}}, {1, 0})}, 2, mesh);
  for (int cell = 0; cell < mesh.n_owned; ++cell) {
    const bool left = mesh.centroid[cell].x < 0.3;
    CHECK(state.alpha[0][cell] == (left ? 1 : 0));
    CHECK(state.alpha[1][cell] == (left ? 0 : 1));
    CHECK(state.region[0][cell] == (left ? 1 : -1));
    CHECK(state.region[1][cell] == (left ? -1 : 0));
  }
}

TEST_CASE("a cut cell gets the cut's volume fraction, and each phase the state of the region it comes from") {
  const Mesh mesh = sample_cells(CellType::quadrilateral, 1);
  const InitialState state =
      paint({region(Everywhere{}, {0, 1}), region(HalfSpace{{0.3, 0, 0}, {-1, 0, 0}}, {1, 0})}, 2, mesh);
  CHECK(state.alpha[0][0] == Approx(0.3).epsilon(1e-14));
  CHECK(state.alpha[1][0] == Approx(0.7).epsilon(1e-14));
  CHECK(state.region[0][0] == 1);
  CHECK(state.region[1][0] == 0);
}

TEST_CASE("a later region covers an earlier one") {
  const Mesh mesh = sample_cells(CellType::quadrilateral, 4);
  const Box lower{{0, 0, 0}, {1, 0.5, 0}};
  const InitialState state =
      paint({region(Everywhere{}, {1, 0}), region(lower, {0, 1}), region(lower, {1, 0})}, 2, mesh);
  for (int cell = 0; cell < mesh.n_owned; ++cell) {
    CHECK(state.alpha[0][cell] == 1);
    CHECK(state.alpha[1][cell] == 0);
    CHECK(state.region[0][cell] == (mesh.centroid[cell].y < 0.5 ? 2 : 0));
    CHECK(state.region[1][cell] == -1);
  }
}

TEST_CASE("of several regions in a cell the state is that with most of the phase, of equals the later") {
  const Mesh mesh = sample_cells(CellType::quadrilateral, 1);
  const auto regions = [&](double x) {
    return std::vector{region(Everywhere{}, {1}), region(HalfSpace{{x, 0, 0}, {-1, 0, 0}}, {1})};
  };
  CHECK(paint(regions(0.25), 1, mesh).region[0][0] == 0);
  CHECK(paint(regions(0.75), 1, mesh).region[0][0] == 1);
  CHECK(paint(regions(0.5), 1, mesh).region[0][0] == 1);
  CHECK(paint(regions(0.25), 1, mesh).alpha[0][0] == Approx(1).epsilon(1e-15));
}

TEST_CASE("three phases: mixtures are painted over by their fractions and volumes add up to the domain") {
  const Mesh mesh = sample_cells(CellType::hexahedron, 6, 0.2);
  const InitialState state =
      paint({region(Everywhere{}, {0, 0.25, 0.75}), region(HalfSpace{{0.5, 0.5, 0.5}, {1, 2, 3}}, {1, 0, 0}),
             region(Box{{0.1, 0.1, 0.1}, {0.35, 0.4, 0.3}}, {0, 1, 0})},
            3, mesh);
  double volume[3] = {};
  for (int cell = 0; cell < mesh.n_owned; ++cell) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      sum += state.alpha[k][cell];
      volume[k] += state.alpha[k][cell] * mesh.volume[cell];
      CHECK((state.region[k][cell] == -1) == (state.alpha[k][cell] == 0));
    }
    CHECK(sum == Approx(1).epsilon(1e-14));
  }
  // The box lies outside the half-space (1*0.35 + 2*0.4 + 3*0.3 < 3), so the volumes are exact.
  const double box = 0.25 * 0.3 * 0.2;
  CHECK(volume[0] == Approx(0.5).epsilon(1e-12));
  CHECK(volume[1] == Approx(box + 0.25 * (0.5 - box)).epsilon(1e-12));
  CHECK(volume[2] == Approx(0.75 * (0.5 - box)).epsilon(1e-12));
}

TEST_CASE("a cell that no region covers is refused with its place") {
  const Mesh mesh = sample_cells(CellType::quadrilateral, 2);
  const auto half = region(HalfSpace{{0.5, 0, 0}, {-1, 0, 0}}, {1}, "impact.toml:12");
  CHECK_THROWS_AS(paint({half}, 1, mesh), InputError);
  CHECK_THROWS_WITH(paint({half}, 1, mesh), Contains("impact.toml:12") && Contains("(0.75, 0.25, 0)"));
  const auto most = region(HalfSpace{{0.9, 0, 0}, {-1, 0, 0}}, {1}, "impact.toml:12");
  CHECK_THROWS_WITH(paint({most}, 1, mesh), Contains("80 %"));
  CHECK_THROWS_WITH(paint({}, 1, mesh), Contains("(0.25, 0.25, 0)"));
}

TEST_CASE("an unknown physical group is refused, naming the mesh's own") {
  Mesh mesh = sample_cells(CellType::quadrilateral, 2);
  mesh.region_names = {"jelly", "surroundings"};
  const auto regions = std::vector{region(Everywhere{}, {1}), region(PhysicalGroup{"jely"}, {1}, "drop.toml:7")};
  CHECK_THROWS_WITH(paint(regions, 1, mesh), Contains("drop.toml:7") && Contains("jely") && Contains("jelly, surr"));
  mesh.region_names.clear();
  CHECK_THROWS_WITH(paint(regions, 1, mesh), Contains("names none"));
}

TEST_CASE("for the partition a cell of void costs next to nothing, and a solid more than a fluid") {
  Setup setup;
  setup.phases.resize(3);
  setup.phases[0].elastic = HyperelasticMaterial{};
  setup.phases[2].void_pressure = 1e5;
  const auto fill = [&](Shape shape, std::vector<double> alpha) {
    setup.regions.push_back({std::move(shape), {std::move(alpha), std::vector<PhaseState>(3)}, ""});
  };
  fill(Everywhere{}, {0, 0, 1});
  fill(PhysicalGroup{"jelly"}, {1, 0, 0});
  fill(Sphere{{5, 0, 0}, 1}, {0, 1, 0});
  fill(HalfSpace{{0, 10, 0}, {0, 1, 0}}, {0.5, 0.5, 0});
  const int nothing = cell_cost(setup, {0, 0, 0}, ""), solid = cell_cost(setup, {0, 0, 0}, "jelly"),
            fluid = cell_cost(setup, {5.5, 0, 0}, "jelly"), both = cell_cost(setup, {0, 11, 0}, "");
  CHECK(nothing == 1);
  CHECK(fluid > 4 * nothing);
  CHECK(solid > fluid);
  CHECK(both > solid);
}
