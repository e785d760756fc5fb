#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "app/integrals.hpp"
#include "output_scene.hpp"

namespace cobasis::test {
namespace {

using Catch::Matchers::Contains;

double integral(const Mesh& mesh, std::vector<double> alpha, const decltype(IntegralSetup::what)& what,
                Geometry geometry = Geometry::plane) {
  Snapshot snapshot;
  snapshot.phases.resize(1);
  snapshot.phases[0].alpha = std::move(alpha);
  return Integrals({{"value", what}}, geometry, mesh, world()).evaluate(snapshot).at(0);
}

TEST_CASE("the extent lies where the interpolated volume fraction has the value") {
  const Mesh mesh = squares(5, 1, 2);  // centroids at 1, 3, 5, 7, 9
  CHECK(integral(mesh, {1, 1, 0.75, 0.25, 0}, Extent{0, 0.5, Axis::x}) == 6);
  CHECK(integral(mesh, {1, 1, 0.6, 0.2, 0}, Extent{0, 0.3, Axis::x}) == Approx(5 + 2 * 0.75).epsilon(1e-15));
  CHECK(integral(mesh, {0, 0.25, 0.75, 1, 1}, Extent{0, 0.5, Axis::x}) == 10);  // touches the boundary
  CHECK(integral(mesh, {1, 0, 0, 0.9, 0}, Extent{0, 0.5, Axis::x}) == Approx(7 + 2 * 4 / 9.0).epsilon(1e-15));
  CHECK(integral(mesh, {1, 1, 0.75, 0.25, 0}, Extent{0, 0.5, Axis::y}) == 2);
}

TEST_CASE("the extent of what is nowhere is not a number") {
  CHECK(std::isnan(integral(squares(3, 1, 1), {0.1, 0.2, 0.4}, Extent{0, 0.5, Axis::x})));
}

TEST_CASE("the extent in a box is that of the cells and of the places between them in the box") {
  const Mesh mesh = squares(4, 2, 1);
  const std::vector<double> alpha = {1, 0.75, 0.25, 0,  // reaches 2
                                     1, 1,    1,    0};
  const auto reach = [&](const Point& low, const Point& high) {
    return integral(mesh, alpha, Extent{0, 0.5, Axis::x, Box{low, high}});
  };
  CHECK(reach({0, 0, 0}, {4, 0.75, 0}) == 2);
  CHECK(reach({0, 1, 0}, {4, 2, 0}) == 3);
  CHECK(reach({0, 0, 0}, {2.75, 2, 0}) == 2.5);  // the contour at 3 is beyond
  CHECK(std::isnan(reach({3.25, 0, 0}, {4, 2, 0})));
  CHECK_THROWS_WITH(reach({5, 0, 0}, {6, 2, 0}), Contains("the box lies outside the mesh"));
}

TEST_CASE("the extent does not jump through a periodic pair") {
  const Mesh mesh = squares(5, 1, 2, true);
  CHECK(integral(mesh, {1, 0.75, 0.25, 0, 0}, Extent{0, 0.5, Axis::x}) == 4);
}

TEST_CASE("radial is the distance from the axis: |y| in a plane, that in x and y in space") {
  CHECK(coordinate({3, -4, 7}, Axis::radial, Geometry::plane) == 4);
  CHECK(coordinate({3, -4, 7}, Axis::radial, Geometry::space) == 5);
  CHECK(coordinate({3, -4, 7}, Axis::z, Geometry::space) == 7);
}

TEST_CASE("the quantile holds the fraction of the phase's volume, spread evenly over each cell") {
  const Mesh mesh = squares(4, 1, 1);
  const std::vector<double> alpha = {1, 1, 0.5, 0};  // 2.5 in all
  CHECK(integral(mesh, alpha, Quantile{0, 0.6, Axis::x}) == Approx(1.5).epsilon(1e-12));
  CHECK(integral(mesh, alpha, Quantile{0, 0.4, Axis::x}) == Approx(1.0).epsilon(1e-12));
  CHECK(integral(mesh, alpha, Quantile{0, 0.75, Axis::x}) == Approx(1.875).epsilon(1e-12));
  CHECK(integral(mesh, alpha, Quantile{0, 0.95, Axis::x}) == Approx(2.75).epsilon(1e-12));
  CHECK(std::isnan(integral(mesh, {0, 0, 0, 0}, Quantile{0, 0.5, Axis::x})));
}

TEST_CASE("the quantile does not depend on how many cells lie side by side") {
  const std::vector<double> row = {1, 1, 0.5, 0};
  std::vector<double> alpha;
  for (int j = 0; j < 6; ++j) alpha.insert(alpha.end(), row.begin(), row.end());
  const double fraction = GENERATE(0.1, 0.3, 0.5, 0.8, 0.99);
  CHECK(integral(squares(4, 6, 1), alpha, Quantile{0, fraction, Axis::x}) ==
        Approx(integral(squares(4, 1, 1), row, Quantile{0, fraction, Axis::x})).epsilon(1e-12));
}

TEST_CASE("the quantile of a full disc's radius is that of the circle") {
  const int n = 60;
  const Mesh mesh = squares(n, n, 1.0 / n);
  std::vector<double> alpha;
  for (const Point& x : mesh.centroid) alpha.push_back(x.x * x.x + x.y * x.y < 0.64 ? 1 : 0);
  // a quarter of a disc of radius 0.8: the radius that holds a fraction f is 0.8 sqrt(f), within a fraction of a cell
  CHECK(integral(mesh, alpha, Quantile{0, 0.5, Axis::radial}, Geometry::space) ==
        Approx(0.8 * std::sqrt(0.5)).margin(0.2 / n));
}

TEST_CASE("integrals keep their bits when cells are stored in another order") {
  const Mesh mesh = squares(6, 5, 1);
  std::vector<double> alpha;
  for (int i = 0; i < 30; ++i) alpha.push_back(0.5 + 0.5 * std::sin(3.7 * i));
  Mesh reversed = mesh;
  std::vector<double> reversed_alpha(alpha.rbegin(), alpha.rend());
  std::reverse(reversed.centroid.begin(), reversed.centroid.end());
  std::reverse(reversed.global_id.begin(), reversed.global_id.end());
  std::reverse(reversed.cell_nodes.begin(), reversed.cell_nodes.end());  // four corners each
  for (int fraction = 1; fraction < 10; ++fraction) {
    const Quantile what{0, 0.1 * fraction, Axis::radial};
    CHECK(integral(mesh, alpha, what, Geometry::space) == integral(reversed, reversed_alpha, what, Geometry::space));
  }
}

}  // namespace
}  // namespace cobasis::test
