// Scenes that are special cases of others give their results: a plane is a layer in space, a solid without shear
// modulus is a fluid, phases that are the same are one.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "measures.hpp"

using namespace cobasis;
using namespace cobasis::test;

namespace {

const std::string square =
    first_order + "mesh = \"@box.geo\"\nmesh_parameters = { n = 24, element = 3 }\nend_time = 1\n";
const std::string walls = "[boundary]\n\"*\" = \"wall\"\n";

/// Cells of `b` with the same place in the plane as those of `a`.
std::vector<std::int32_t> same_place(const Mesh& a, const Mesh& b) {
  std::vector<std::int32_t> found;
  for (std::int32_t i = 0; i < a.n_owned; ++i)
    for (std::int32_t j = 0; j < b.n_owned; ++j)
      if (std::hypot(a.centroid[i].x - b.centroid[j].x, a.centroid[i].y - b.centroid[j].y) < 1e-9) found.push_back(j);
  REQUIRE(a.n_owned == b.n_owned);
  REQUIRE(found.size() == static_cast<std::size_t>(a.n_owned));
  return found;
}

/// A box of copper runs into aluminium under prestrain, in air.
Scene layer(int element, double thickness) {
  return make_scene(first_order +
                        fmt::format("mesh = \"{}/tests/verification/layer.geo\"\nmesh_parameters = {{ n = 16, element "
                                    "= {}, thickness = {} }}\n",
                                    SOURCE_DIR, element, thickness) +
                        R"(end_time = 1
[phase.copper]
material = "copper"
[phase.air]
material = "air"
[phase.aluminium]
material = "aluminium"
[[region]]
shape = "everywhere"
fill = "air"
pressure = 1e5
velocity = [0.0, 0.0]
[[region]]
shape = "half_space"
fill = "aluminium"
pressure = 1e8
point = [0.55, 0.5]
normal = [0.96, 0.28]
velocity = [-100.0, 30.0]
phase.aluminium = { cobasis = [[1.01, 0.12, 0.0], [0.03, 0.99, 0.0], [0.0, 0.0, 1.02]] }
[[region]]
shape = "box"
fill = "copper"
pressure = 1e5
)" + (thickness > 0 ? "low = [0.1, 0.2, -1.0]\nhigh = [0.5, 0.7, 1.0]\n" : "low = [0.1, 0.2]\nhigh = [0.5, 0.7]\n") +
                        R"(velocity = [300.0, -20.0]
[boundary]
sides = "wall"
)" + (thickness > 0 ? "back = \"symmetry\"\nfront = \"symmetry\"\n" : ""),
                    ranks());
}

}  // namespace

TEST_CASE("a plane scene is one layer of a scene in space between symmetry planes") {
  const int element = GENERATE(3, 4);
  const double thickness = 0.05, dt = 1.2e-6;  // the same steps: the layer's faces in front and behind shorten its own
  Scene plane = layer(element, 0), space = layer(element, thickness);
  advance_by(plane, dt, 100);
  advance_by(space, dt, 100);
  const double difference = largest_difference(plane, space, same_place(plane.mesh, space.mesh));
  INFO((element == 3 ? "triangles and prisms" : "quadrilaterals and hexahedra")
       << ": relative difference " << difference);
  CHECK(difference < 1e-12);
}

TEST_CASE("a solid without shear modulus is a fluid") {
  const auto run = [](const std::string& elastic) {
    Scene scene =
        make_scene(square + "[phase.liquid]\neos = { type = \"stiffened_gas\", gamma = 3.4, p_inf = 21.5e9 }\n" +
                       elastic + R"([phase.copper]
material = "copper"
[[region]]
shape = "everywhere"
fill = "liquid"
pressure = 1e5
velocity = [100.0, -50.0]
phase.liquid = { density = 2700.0 }
[[region]]
shape = "sphere"
center = [0.4, 0.5]
radius = 0.2
fill = "copper"
pressure = 1e5
velocity = [300.0, 20.0]
)" + walls,
                   ranks());
    scene.run(100);
    CHECK(scene.solver->step() == 100);
    return scene;
  };
  const std::string none, zero = "elastic = { mu = 0.0, rho0 = 2700.0, a = 0.5 }\n";
  const Scene fluid = run(none), solid = run(zero);
  const Result f(fluid), s(solid);
  CHECK(s.phase("liquid").is_solid);
  double largest = 0;
  const auto compare = [&](double scale, auto&& value) {
    for (std::int32_t cell = 0; cell < f.cells(); ++cell)
      largest = std::max(largest, std::fabs(value(f, cell) - value(s, cell)) / scale);
  };
  for (const std::string name : {"liquid", "copper"}) {
    compare(1, [&](const Result& r, std::int32_t c) { return r.phase(name).alpha[c]; });
    compare(8900, [&](const Result& r, std::int32_t c) { return r.phase(name).alpha[c] * r.phase(name).density[c]; });
    compare(1e10, [&](const Result& r, std::int32_t c) { return r.phase(name).alpha[c] * r.phase(name).pressure[c]; });
    for (int i = 0; i < 2; ++i)
      compare(300,
              [&](const Result& r, std::int32_t c) { return r.phase(name).alpha[c] * r.phase(name).velocity[i][c]; });
  }
  INFO("relative difference " << largest);
  CHECK(largest < 1e-12);
}

TEST_CASE("two phases that are the same, everywhere in the same proportion, are one") {
  const std::string material = GENERATE(as<std::string>{}, "aluminium", "water");
  const auto run = [&](bool two) {
    const std::string fill = two ? "alpha = { one = 0.3, other = 0.7 }" : "fill = \"one\"";
    Scene scene =
        make_scene(square + fmt::format("[phase.one]\nmaterial = \"{}\"\n", material) +
                       (two ? fmt::format("[phase.other]\nmaterial = \"{}\"\n", material) : "") +
                       "[[region]]\nshape = \"everywhere\"\npressure = 1e5\nvelocity = [\"200*x\", \"-100*x*y\"]\n" +
                       fill + "\n[[region]]\nshape = \"half_space\"\npoint = [0.5, 0.5]\nnormal = [0.8, 0.6]\n" +
                       "pressure = 3e9\nvelocity = [-100.0, 50.0]\n" + fill + "\n" + walls,
                   ranks());
    scene.run(100);
    CHECK(scene.solver->step() == 100);
    return scene;
  };
  const Scene one = run(false), two = run(true);
  const Result a(one), b(two);
  double largest = 0;
  for (std::int32_t cell = 0; cell < a.cells(); ++cell) {
    const PhaseSnapshot& p = a.phase("one");
    largest = std::max(largest, std::fabs(b.phase("one").alpha[cell] - 0.3));
    for (const std::string name : {"one", "other"}) {
      const PhaseSnapshot& q = b.phase(name);
      largest = std::max(largest, std::fabs(p.density[cell] - q.density[cell]) / 2700);
      for (int i = 0; i < 2; ++i)
        largest = std::max(largest, std::fabs(p.velocity[i][cell] - q.velocity[i][cell]) / 200);
      for (int i = 0; i < 6; ++i) largest = std::max(largest, std::fabs(p.stress[i][cell] - q.stress[i][cell]) / 3e9);
      for (int i = 0; i < 9 && p.is_solid; ++i)
        largest = std::max(largest, std::fabs(p.cobasis[i][cell] - q.cobasis[i][cell]));
    }
  }
  INFO(material << ": relative difference " << largest);
  CHECK(largest < 1e-12);
}
