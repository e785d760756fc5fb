#include "solver/plane_cut.hpp"

#include <catch2/catch.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>

#include "random_cells.hpp"
#include "solver/cut_cell.hpp"

using namespace cobasis;

TEST_CASE("the simplices of a cell have the volume that the mesh measures") {
  for_random_cells(20, 0.2, [](Random&, const Mesh& mesh, const CellCorners& cell) {
    CHECK(cell.volume == Approx(mesh.volume[0]).epsilon(2e-14).margin(0));
  });
}

TEST_CASE("the volume below a plane is that of a half-space") {
  for_random_cells(20, 0.2, [](Random& random, const Mesh& mesh, const CellCorners& cell) {
    const Point n = random.direction(mesh.dimension);
    const auto [low, high] = range(cell, n);
    const double d = random(low, high);
    const double expected = inside_fraction(HalfSpace{mesh.centroid[0] + d * n, -1.0 * n}, mesh, 0);
    CHECK(volume_below(cell, {n, d}) == Approx(expected).epsilon(1e-12).margin(1e-13));
  });
}

TEST_CASE("the two sides of a plane fill the cell") {
  for_random_cells(40, 0.2, [](Random& random, const Mesh& mesh, const CellCorners& cell) {
    const Point n = random.direction(mesh.dimension);
    const auto [low, high] = range(cell, n);
    const CutPlane plane{n, random(low, high)};
    CHECK(volume_below(cell, plane) + volume_below(cell, complement(plane)) == Approx(1).epsilon(1e-14));
    const PlaneSection one = section(cell, plane), other = section(cell, complement(plane));
    CHECK(one.area == Approx(other.area).epsilon(1e-12));
    CHECK(length(one.centroid - other.centroid) < 1e-12 * size_of(mesh));
  });
}

TEST_CASE("a plane that misses the cell leaves it exactly full or empty") {
  for_random_cells(4, 0.2, [](Random& random, const Mesh& mesh, const CellCorners& cell) {
    const Point n = random.direction(mesh.dimension);
    const auto [low, high] = range(cell, n);
    CHECK(volume_below(cell, {n, low}) == 0);
    CHECK(volume_below(cell, {n, high}) == 1);
    CHECK(volume_below(cell, {n, -1e9}) == 0);
    CHECK(volume_below(cell, {n, 1e9}) == 1);
    CHECK(section(cell, {n, low - 1e-3}).area == 0);
    CHECK(section(cell, {n, high + 1e-3}).area == 0);
    CHECK(place_plane(cell, n, 0) == low);
    CHECK(place_plane(cell, n, 1) == high);
  });
}

TEST_CASE("a placed plane has the wanted volume below it, slivers included") {
  for_random_cells(40, 0.2, [](Random& random, const Mesh& mesh, const CellCorners& cell) {
    const Point n = random.direction(mesh.dimension);
    const auto [low, high] = range(cell, n);
    const double tick = 1e-16 * (high - low);  // of d
    for (const double f : {1e-15, 1e-12, 1e-9, 1e-6, 1e-3, 0.1, 0.3, 0.5, 0.7, 0.9, 1 - 1e-3, 1 - 1e-6, 1 - 1e-9}) {
      const double d = place_plane(cell, n, f);
      const double of_tick = 4 * tick * section(cell, {n, d}).area / cell.volume;
      const double below = volume_below(cell, {n, d}), above = volume_below(cell, complement({n, d}));
      CAPTURE(f, below, above, of_tick);
      CHECK(std::abs(below - f) <= std::min(1e-14, 1e-13 * f) + of_tick + (f > 0.5 ? 2e-15 : 0));
      CHECK(std::abs(above - (1 - f)) <= std::min(1e-14, 1e-13 * (1 - f)) + of_tick + (f < 0.5 ? 2e-15 : 0));
      CHECK(of_tick < 1e-3 * std::min(f, 1 - f));
      CHECK(place_plane(cell, -1.0 * n, 1 - f) == Approx(-d).margin(1e-9 * size_of(mesh)));
    }
  });
}

TEST_CASE("planes along the faces of a cell are placed exactly") {
  // The volume is then a polynomial with few pieces, and most corners have equal heights.
  const auto turned = [](const Point& p) { return Point{0.6 * p.x - 0.8 * p.y, 0.8 * p.x + 0.6 * p.y, p.z}; };
  for (const CellType type : all_types) {
    INFO(shape_of(type).name);
    const Mesh mesh = one_cell(type, turned);
    const CellCorners cell = corners_of(mesh, 0);
    for (int face = 0; face < mesh.n_faces(); ++face) {
      const Point n = normal(mesh, face);
      const auto [low, high] = range(cell, n);
      const double there = dot(n, mesh.face_centroid[face] - mesh.centroid[0]);
      CHECK(section(cell, {n, there}).area == Approx(mesh.area[face]).epsilon(1e-12));
      CHECK(section(cell, complement({n, there})).area == 0);
      for (const double f : {1e-9, 1e-3, 0.25, 0.5, 0.75, 1 - 1e-3, 1 - 1e-9}) {
        const double d = place_plane(cell, n, f);
        CAPTURE(f);
        CHECK(volume_below(cell, {n, d}) == Approx(f).epsilon(2e-15 / std::min(f, 1 - f)));
        CHECK((d > low && d < high));
      }
    }
  }
}

TEST_CASE("planes through corners and along edges of a cube cut off what they must") {
  const Mesh mesh = one_cell(CellType::hexahedron, [](const Point& p) { return p; });
  const CellCorners cell = corners_of(mesh, 0);
  const double half = std::sqrt(0.5), third = 1 / std::sqrt(3);
  // along the diagonal of two faces
  CHECK(volume_below(cell, {{half, half, 0}, 0}) == Approx(0.5).epsilon(1e-15));
  CHECK(section(cell, {{half, half, 0}, 0}).area == Approx(std::sqrt(2.0)).epsilon(1e-15));
  CHECK(length(section(cell, {{half, half, 0}, 0}).centroid) < 1e-15);
  // through three corners
  CHECK(volume_below(cell, {{third, third, third}, -0.5 * third}) == Approx(1.0 / 6).epsilon(1e-14));
  const PlaneSection triangle = section(cell, {{third, third, third}, -0.5 * third});
  CHECK(triangle.area == Approx(std::sqrt(3.0) / 2).epsilon(1e-14));
  CHECK(length(triangle.centroid - Point{-1.0 / 6, -1.0 / 6, -1.0 / 6}) < 1e-15);
  // the regular hexagon in the middle
  CHECK(section(cell, {{third, third, third}, 0}).area == Approx(0.75 * std::sqrt(3.0)).epsilon(1e-14));
  // only an edge, only a corner
  CHECK(section(cell, {{half, half, 0}, half}).area < 1e-14);
  CHECK(section(cell, {{third, third, third}, 1.5 * third}).area < 1e-14);
}

TEST_CASE("the moment of a section is the change of volume when the plane turns") {
  for_random_cells(20, 0.2, [](Random& random, const Mesh& mesh, const CellCorners& cell) {
    const Point n = random.direction(mesh.dimension), e = random.direction(mesh.dimension);
    const auto [low, high] = range(cell, n);
    const CutPlane plane{n, random(0.8 * low, 0.8 * high)};
    const PlaneSection cut = section(cell, plane);
    const double size = size_of(mesh), step = 1e-5;
    const double change = volume_below(cell, {n + step * e, plane.d}) - volume_below(cell, {n - step * e, plane.d});
    const double moment = -change * cell.volume / (2 * step);
    CHECK(cut.area * dot(e, cut.centroid) == Approx(moment).margin(2e-7 * cell.volume * size));
    CHECK(dot(n, cut.centroid) == Approx(plane.d).margin(1e-14 * size));
    const double push = 1e-5 * size;
    const double growth = volume_below(cell, {n, plane.d + push}) - volume_below(cell, {n, plane.d - push});
    CHECK(cut.area == Approx(growth * cell.volume / (2 * push)).margin(2e-4 * cell.volume / size));
  });
}

TEST_CASE("the centroids of the two sides of a plane balance, and move as the section between them") {
  for_random_cells(20, 0.2, [](Random& random, const Mesh& mesh, const CellCorners& cell) {
    const Point n = random.direction(mesh.dimension);
    const auto [low, high] = range(cell, n);
    const auto moment = [&](const CutPlane& plane) { return volume_below(cell, plane) * centroid_below(cell, plane); };
    const double d = random(0.8 * low, 0.8 * high), size = size_of(mesh), push = 1e-5 * size;
    const CutPlane plane{n, d};
    const Point whole = centroid_below(cell, {n, 1.001 * high});
    CHECK(length(moment(plane) + moment(complement(plane)) - whole) < 1e-14 * size);
    const PlaneSection cut = section(cell, plane);
    const Point change = moment({n, d + push}) - moment({n, d - push});
    const Point expected = 2 * push * cut.area / cell.volume * cut.centroid;
    CHECK(length(change - expected) < 1e-4 * push);
  });
}

TEST_CASE("time of a plane cut", "[.benchmark]") {
  Random random;
  for (const CellType type : all_types) {
    std::vector<Mesh> meshes;
    for (int i = 0; i < 64; ++i) meshes.push_back(random.cell(type, 0.1));
    std::vector<CellCorners> cells;
    std::vector<FaceOutlines> outlines;
    std::vector<CutPlane> planes;
    std::vector<double> fractions;
    for (const Mesh& mesh : meshes) {
      cells.push_back(corners_of(mesh, 0));
      outlines.emplace_back(mesh);
      fractions.push_back(random(1e-6, 1 - 1e-6));
      const Point n = random.direction(mesh.dimension);
      planes.push_back({n, place_plane(cells.back(), n, fractions.back())});
    }
    double sink = 0;
    const auto time = [&](const auto& call) {
      double best = 1e300;
      for (int repetition = 0; repetition < 20; ++repetition) {
        const auto start = std::chrono::steady_clock::now();
        for (int sweep = 0; sweep < 20; ++sweep)
          for (int i = 0; i < 64; ++i) sink += call(i);
        const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - start;
        best = std::min(best, took.count() / (20 * 64));
      }
      return best;
    };
    const double corners = time([&](int i) { return corners_of(meshes[i], 0).volume; });
    const double volume = time([&](int i) { return volume_below(cells[i], planes[i]); });
    const double place = time([&](int i) { return place_plane(cells[i], planes[i].n, fractions[i]); });
    const double cut = time([&](int i) { return section(cells[i], planes[i]).area; });
    const double wet = time([&](int i) {
      return wetted_fraction(outlines[i][0], outlines[i].center(0, 0), planes[i], 0.2 * size_of(meshes[i]));
    });
    std::printf("%-14s corners %5.0f  volume_below %5.0f  place_plane %5.0f  section %5.0f  wetted_fraction %5.0f ns\n",
                shape_of(type).name, corners, volume, place, cut, wet);
    CHECK(std::isfinite(sink));
  }
}
