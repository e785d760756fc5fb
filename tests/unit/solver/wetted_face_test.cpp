// The part of a face behind a plane, beside what the plane cuts off the cell.
#include <catch2/catch.hpp>

#include <cmath>
#include <cstring>
#include <map>

#include "mesh/geometry.hpp"
#include "random_cells.hpp"
#include "solver/plane_cut.hpp"

using namespace cobasis;

TEST_CASE("the part of a cell below a plane is closed by its faces and the section") {
  for_random_cells(40, 0, [](Random& random, const Mesh& mesh, const CellCorners& cell) {
    const FaceOutlines outlines(mesh);
    const Point n = random.direction(mesh.dimension);
    const CutPlane plane{n, place_plane(cell, n, random(0, 1))};
    Point sum = section(cell, plane).area * n;
    double surface = 0;
    for (int face = 0; face < mesh.n_faces(); ++face) {
      const double wet = wetted_fraction(outlines[face], outlines.center(face, 0), plane, 0);
      CHECK((wet >= 0 && wet <= 1));
      sum = sum + wet * mesh.area[face] * normal(mesh, face);
      surface += mesh.area[face];
    }
    CHECK(length(sum) < 1e-13 * surface);
  });
}

TEST_CASE("with values at their centroids, faces and section give the exact gradient of a linear field") {
  for_random_cells(40, 0, [](Random& random, const Mesh& mesh, const CellCorners& cell) {
    const FaceOutlines outlines(mesh);
    const Point n = random.direction(mesh.dimension), gradient = random.direction(mesh.dimension);
    const double fraction = random(0, 1);
    const CutPlane plane{n, place_plane(cell, n, fraction)};
    const PlaneSection cut = section(cell, plane);
    Point sum = cut.area * dot(gradient, cut.centroid) * n;
    for (int face = 0; face < mesh.n_faces(); ++face) {
      const FaceOutline outline = outlines[face];
      const Point center = outlines.center(face, 0), wet = center + wetted_centroid(outline, center, plane);
      const double area = wetted_fraction(outline, center, plane, 0) * mesh.area[face];
      sum = sum + area * dot(gradient, wet) * normal(mesh, face);
    }
    CHECK(length(sum - fraction * cell.volume * gradient) < 1e-13 * cell.volume);
  });
}

TEST_CASE("a plane that moves through a cell carries exactly what its faces let pass") {
  for_random_cells(40, 0, [](Random& random, const Mesh& mesh, const CellCorners& cell) {
    const FaceOutlines outlines(mesh);
    const Point n = random.direction(mesh.dimension);
    const double d = place_plane(cell, n, random(0, 1));
    for (const double courant : {0.3, -0.3, 1.7, -1.7, 1e-7}) {
      const Point u = courant * size_of(mesh) * random.direction(mesh.dimension);
      const double shift = dot(u, n);
      double change = 0, surface = 0;
      for (int face = 0; face < mesh.n_faces(); ++face) {
        const double wet = wetted_fraction(outlines[face], outlines.center(face, 0), {n, d}, shift);
        change -= mesh.area[face] * dot(normal(mesh, face), u) * wet;
        surface += mesh.area[face];
      }
      const double moved = (volume_below(cell, {n, d + shift}) - volume_below(cell, {n, d})) * cell.volume;
      CAPTURE(courant);
      CHECK(std::abs(change - moved) < 1e-13 * cell.volume + 1e-14 * surface * length(u));
    }
  });
}

TEST_CASE("the mean wetted fraction of two halves of a step is that of the step, warped faces included") {
  for_random_cells(20, 0.2, [](Random& random, const Mesh& mesh, const CellCorners& cell) {
    const FaceOutlines outlines(mesh);
    const Point n = random.direction(mesh.dimension);
    const CutPlane plane{n, place_plane(cell, n, random(0, 1))};
    for (int face = 0; face < mesh.n_faces(); ++face) {
      const FaceOutline outline = outlines[face];
      const Point center = outlines.center(face, 0);
      const auto wet = [&](double d, double shift) { return wetted_fraction(outline, center, {n, d}, shift); };
      const double shift = random(-1, 1) * size_of(mesh), d = plane.d;
      CHECK(wet(d, shift) == Approx(0.5 * (wet(d, shift / 2) + wet(d + shift / 2, shift / 2))).margin(1e-14));
      CHECK(wet(d, shift) == Approx(wet(d + shift, -shift)).margin(1e-14));
      CHECK(wet(d, shift) + wetted_fraction(outline, center, complement({n, d}), -shift) == Approx(1).margin(1e-14));
      CHECK(wet(d, 1e-9 * shift) == Approx(wet(d, 0)).margin(1e-7));
    }
  });
}

TEST_CASE("a face in the plane is wetted by a plane that moves on, dry behind one that withdraws") {
  for (const CellType type : all_types) {
    INFO(shape_of(type).name);
    Random random;
    const Mesh mesh = random.cell(type);
    const FaceOutlines outlines(mesh);
    for (int face = 0; face < mesh.n_faces(); ++face) {
      const Point center = outlines.center(face, 0);
      const CutPlane plane{normal(mesh, face), dot(normal(mesh, face), center)};
      CHECK(wetted_fraction(outlines[face], center, plane, 0.1) == 1);
      CHECK(wetted_fraction(outlines[face], center, plane, -0.1) == 0);
      CHECK(wetted_fraction(outlines[face], center, plane, 0) == 0.5);
    }
  }
}

TEST_CASE("the outlines of faces are their corners, the same bits on every rank") {
  for (const CellType type : {CellType::quadrilateral, CellType::hexahedron}) {
    const auto moved = [](const Point& p) {
      return Point{p.x + 0.1 * std::sin(7 * p.x + p.y), p.y + 0.1 * std::sin(3 * p.x + 2 * p.y + p.z), p.z};
    };
    std::map<std::pair<std::int64_t, std::int64_t>, FaceOutline> seen;
    int shared = 0;
    for (const int part : {0, 1}) {
      const Mesh mesh = cut_into(row(type, 4, moved), 2, part, {});
      const FaceOutlines outlines(mesh);
      for (int face = 0; face < mesh.n_faces(); ++face) {
        const FaceOutline outline = outlines[face];
        std::array<Point, 4> at;
        for (int i = 0; i < outline.size; ++i) at[i] = outline.corner[i] + mesh.face_centroid[face];
        const FaceGeometry geometry = face_geometry({at.data(), static_cast<std::size_t>(outline.size)});
        CHECK(length(geometry.area - mesh.area[face] * normal(mesh, face)) < 1e-14);
        CHECK(length(geometry.centroid - mesh.face_centroid[face]) < 1e-14);
        if (face >= mesh.first_boundary_face()) continue;
        const auto [entry, is_new] =
            seen.try_emplace({mesh.global_id[mesh.left[face]], mesh.global_id[mesh.right[face]]}, outline);
        if (is_new) continue;
        ++shared;
        CHECK(std::memcmp(&entry->second, &outline, sizeof outline) == 0);
      }
    }
    CHECK(shared == 3);
  }
}

TEST_CASE("a cell sees a periodic face where its own side lies") {
  for (const int n : {1, 2}) {
    const auto same = [](const Point& p) { return p; };
    const Mesh mesh = cut_into(row(CellType::hexahedron, n, same), 1, 0, {{"left", "right"}});
    const FaceOutlines outlines(mesh);
    int through = 0;
    for (int face = 0; face < mesh.first_boundary_face(); ++face) {
      const Point from_left = outlines.center(face, 0), from_right = outlines.center(face, 1);
      CHECK(length(from_left - 0.5 * normal(mesh, face)) < 1e-14);
      CHECK(length(from_right + 0.5 * normal(mesh, face)) < 1e-14);
      ++through;
    }
    CHECK(through == n);
  }
}
