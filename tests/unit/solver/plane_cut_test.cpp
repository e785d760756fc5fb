#include "solver/plane_cut.hpp"

#include <catch2/catch.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <map>
#include <random>

#include "mesh/cell_shape.hpp"
#include "mesh/distribute.hpp"
#include "mesh/geometry.hpp"
#include "solver/cut_cell.hpp"

using namespace cobasis;

namespace {

const std::array<CellType, 6> all_types{CellType::triangle,   CellType::quadrilateral, CellType::tetrahedron,
                                        CellType::hexahedron, CellType::prism,         CellType::pyramid};

std::vector<Point> unit_corners(CellType type) {
  switch (type) {
    case CellType::triangle:
      return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    case CellType::quadrilateral:
      return {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    case CellType::tetrahedron:
      return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    case CellType::hexahedron:
      return {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    case CellType::prism:
      return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
    case CellType::pyramid:
      return {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}};
  }
  return {};
}

Mesh cut_into(RawMesh raw, int n_parts, int part, const std::vector<std::pair<std::string, std::string>>& periodic) {
  const GlobalMesh whole = build_global_mesh(std::move(raw), periodic);
  std::vector<int> owner(whole.n_cells());
  for (int cell = 0; cell < whole.n_cells(); ++cell) owner[cell] = cell % n_parts;
  return PartCutter(whole, owner, n_parts).cut(part);
}

/// A row of cells, each with the corners of one type; outer faces in "left", "right" (those of constant unmoved x = 0
/// and x = n) and "sides". `move`: from the unmoved corner to the mesh.
template <class Move>
RawMesh row(CellType type, int n, const Move& move) {
  RawMesh raw;
  raw.dimension = shape_of(type).dimension;
  raw.group_names = {"left", "right", "sides"};
  std::map<std::array<double, 3>, std::int32_t> number;
  std::vector<Point> place;
  std::map<std::vector<std::int32_t>, std::pair<int, std::array<std::int32_t, 4>>> faces;
  for (int cell = 0; cell < n; ++cell) {
    std::vector<std::int32_t> nodes;
    for (const Point& p : unit_corners(type)) {
      const Point at{p.x + cell, p.y, p.z};
      const auto [entry, is_new] = number.try_emplace({at.x, at.y, at.z}, static_cast<std::int32_t>(place.size()));
      if (is_new) place.push_back(at), raw.nodes.push_back(move(at));
      nodes.push_back(entry->second);
    }
    raw.cell_nodes.insert(raw.cell_nodes.end(), nodes.begin(), nodes.end());
    raw.cell_node_begin.push_back(static_cast<std::int32_t>(raw.cell_nodes.size()));
    raw.cell_type.push_back(type);
    raw.cell_tag.push_back(cell + 1);
    raw.cell_region.push_back(-1);
    for (int f = 0; f < shape_of(type).n_faces; ++f) {
      const FaceCorners& face = shape_of(type).faces[f];
      std::array<std::int32_t, 4> corners{-1, -1, -1, -1};
      for (int i = 0; i < face.size; ++i) corners[i] = nodes[face.corner[i]];
      std::vector<std::int32_t> key(corners.begin(), corners.begin() + face.size);
      std::sort(key.begin(), key.end());
      auto& entry = faces[key];
      ++entry.first;
      entry.second = corners;
    }
  }
  for (const auto& [key, entry] : faces) {
    if (entry.first != 1) continue;
    const auto all_at = [&place, &nodes_of_face = key](double x) {
      return std::ranges::all_of(nodes_of_face, [&](int node) { return place[node].x == x; });
    };
    raw.side_nodes.push_back(entry.second);
    raw.side_tag.push_back(static_cast<std::int64_t>(raw.side_tag.size()) + 1);
    raw.side_group.push_back(all_at(0) ? 0 : all_at(n) ? 1 : 2);
  }
  return raw;
}

template <class Move>
Mesh one_cell(CellType type, const Move& move) {
  return cut_into(row(type, 1, move), 1, 0, {});
}

struct Random {
  std::mt19937 engine{7};
  double operator()(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); }
  Point direction(int dimension) {
    for (;;) {
      const Point p{(*this)(-1, 1), (*this)(-1, 1), dimension == 2 ? 0 : (*this)(-1, 1)};
      if (const double r = length(p); r > 0.1 && r < 1) return 1 / r * p;
    }
  }
  /// An affine image far from the origin, turned and stretched up to 1:5: faces stay plane.
  Mesh cell(CellType type, double warp = 0) {
    const bool plane = shape_of(type).dimension == 2;
    const Point a{(*this)(1, 2), (*this)(-0.3, 0.3), plane ? 0 : (*this)(-0.3, 0.3)};
    const Point b{(*this)(-0.3, 0.3), (*this)(0.4, 1), plane ? 0 : (*this)(-0.1, 0.1)};
    const Point c{(*this)(-0.3, 0.3), (*this)(-0.1, 0.1), (*this)(0.4, 1)};
    const Point origin{3, -2, plane ? 0.0 : 1.0};
    return one_cell(type, [&](const Point& p) {
      const Point moved{p.x + warp * (*this)(-1, 1), p.y + warp * (*this)(-1, 1),
                        plane ? 0 : p.z + warp * (*this)(-1, 1)};
      const Point x = origin + moved.x * a + moved.y * b;
      return plane ? x : x + moved.z * c;
    });
  }
};

/// Heights of a cell's corners above its centroid.
std::pair<double, double> range(const CellCorners& cell, const Point& n) {
  double low = 1e300, high = -1e300;
  for (int i = 0; i < shape_of(cell.type).n_corners; ++i) {
    low = std::min(low, dot(n, cell.point[i]));
    high = std::max(high, dot(n, cell.point[i]));
  }
  return {low, high};
}

double size_of(const Mesh& mesh) { return std::pow(mesh.volume[0], 1.0 / mesh.dimension); }
Point normal(const Mesh& mesh, int face) { return {mesh.nx[face], mesh.ny[face], mesh.nz[face]}; }

template <class Check>
void for_random_cells(int n, double warp, const Check& check) {
  Random random;
  for (const CellType type : all_types) {
    INFO(shape_of(type).name);
    for (int i = 0; i < n; ++i) {
      const Mesh mesh = random.cell(type, i % 2 == 0 ? 0 : warp);
      check(random, mesh, corners_of(mesh, 0));
    }
  }
}

}  // namespace

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
