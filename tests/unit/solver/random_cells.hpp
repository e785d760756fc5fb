// Single cells of every type, turned, stretched and warped at random, and rows of them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "mesh/cell_shape.hpp"
#include "mesh/distribute.hpp"
#include "mesh/geometry.hpp"
#include "solver/plane_cut.hpp"

namespace cobasis {

inline constexpr std::array<CellType, 6> all_types{CellType::triangle,   CellType::quadrilateral, CellType::tetrahedron,
                                                   CellType::hexahedron, CellType::prism,         CellType::pyramid};

inline std::vector<Point> unit_corners(CellType type) {
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

inline Mesh cut_into(RawMesh raw, int n_parts, int part,
                     const std::vector<std::pair<std::string, std::string>>& periodic) {
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
inline std::pair<double, double> range(const CellCorners& cell, const Point& n) {
  double low = 1e300, high = -1e300;
  for (int i = 0; i < shape_of(cell.type).n_corners; ++i) {
    low = std::min(low, dot(n, cell.point[i]));
    high = std::max(high, dot(n, cell.point[i]));
  }
  return {low, high};
}

inline double size_of(const Mesh& mesh) { return std::pow(mesh.volume[0], 1.0 / mesh.dimension); }
inline Point normal(const Mesh& mesh, int face) { return {mesh.nx[face], mesh.ny[face], mesh.nz[face]}; }

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

}  // namespace cobasis
