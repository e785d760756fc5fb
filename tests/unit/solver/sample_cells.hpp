// Meshes of the unit square or cube with cells of one type, corners and volumes only: what painting needs.
#pragma once

#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "mesh/mesh.hpp"

namespace cobasis {

/// n cells per edge before splitting; interior corners are shifted by up to `warp` / n, so that quadrilaterals warp.
inline Mesh sample_cells(CellType type, int n, double warp = 0) {
  const bool plane = type == CellType::triangle || type == CellType::quadrilateral;
  Mesh mesh;
  mesh.dimension = plane ? 2 : 3;
  const int nz = plane ? 0 : n;
  const auto shift = [&](int i, int j, int k, double phase) {
    const bool edge = i % n == 0 || j % n == 0 || (!plane && k % n == 0);
    return edge ? 0 : warp / n * std::sin(12.9898 * i + 78.233 * j + 37.719 * k + phase);
  };
  for (int k = 0; k <= nz; ++k) {
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i) {
        mesh.nodes.push_back({double(i) / n + shift(i, j, k, 0), double(j) / n + shift(i, j, k, 1),
                              plane ? 0 : double(k) / n + shift(i, j, k, 2)});
      }
    }
  }
  mesh.cell_node_begin = {0};
  const auto add = [&](std::initializer_list<int> corners) {
    mesh.cell_nodes.insert(mesh.cell_nodes.end(), corners);
    mesh.cell_node_begin.push_back(static_cast<std::int32_t>(mesh.cell_nodes.size()));
    mesh.cell_type.push_back(type);
    Point sum;
    for (const int c : corners) sum = sum + mesh.nodes[c];
    mesh.centroid.push_back((1.0 / static_cast<double>(corners.size())) * sum);
  };
  for (int k = 0; k < std::max(nz, 1); ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const auto at = [&](int a, int b, int c) { return ((k + c) * (n + 1) + j + b) * (n + 1) + i + a; };
        const std::array<int, 8> v{at(0, 0, 0),          at(1, 0, 0),          at(1, 1, 0),
                                   at(0, 1, 0),          at(0, 0, nz ? 1 : 0), at(1, 0, nz ? 1 : 0),
                                   at(1, 1, nz ? 1 : 0), at(0, 1, nz ? 1 : 0)};
        switch (type) {
          case CellType::quadrilateral:
            add({v[0], v[1], v[2], v[3]});
            break;
          case CellType::triangle:
            add({v[0], v[1], v[2]}), add({v[0], v[2], v[3]});
            break;
          case CellType::hexahedron:
            add({v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7]});
            break;
          case CellType::prism:
            add({v[0], v[1], v[2], v[4], v[5], v[6]}), add({v[0], v[2], v[3], v[4], v[6], v[7]});
            break;
          case CellType::tetrahedron:
            add({v[0], v[1], v[2], v[6]}), add({v[0], v[2], v[3], v[6]}), add({v[0], v[3], v[7], v[6]});
            add({v[0], v[7], v[4], v[6]}), add({v[0], v[4], v[5], v[6]}), add({v[0], v[5], v[1], v[6]});
            break;
          case CellType::pyramid: {
            Point center;
            for (const int c : v) center = center + 0.125 * mesh.nodes[c];
            mesh.nodes.push_back(center);
            const int apex = static_cast<int>(mesh.nodes.size()) - 1;
            add({v[0], v[1], v[2], v[3], apex}), add({v[4], v[7], v[6], v[5], apex}),
                add({v[0], v[4], v[5], v[1], apex});
            add({v[1], v[5], v[6], v[2], apex}), add({v[2], v[6], v[7], v[3], apex}),
                add({v[3], v[7], v[4], v[0], apex});
            break;
          }
        }
      }
    }
  }
  mesh.n_owned = static_cast<std::int32_t>(mesh.cell_type.size());
  mesh.n_global = mesh.n_owned;
  mesh.cell_region.assign(mesh.n_owned, -1);
  mesh.global_id.resize(mesh.n_owned);
  std::iota(mesh.global_id.begin(), mesh.global_id.end(), 0);

  // Volumes by the divergence theorem over the surface, quadrilaterals as four triangles about their corners' mean.
  const auto cone = [](const Point& a, const Point& b, const Point& c) { return dot(a, cross(b, c)) / 6; };
  for (int cell = 0; cell < mesh.n_owned; ++cell) {
    const auto p = [&](int i) { return mesh.nodes[mesh.cell_nodes[mesh.cell_node_begin[cell] + i]]; };
    double volume = 0;
    const auto face = [&](std::vector<int> c) {
      if (c.size() == 3) {
        volume += cone(p(c[0]), p(c[1]), p(c[2]));
        return;
      }
      const Point middle = 0.25 * (p(c[0]) + p(c[1]) + p(c[2]) + p(c[3]));
      for (int i = 0; i < 4; ++i) volume += cone(p(c[i]), p(c[(i + 1) % 4]), middle);
    };
    switch (type) {
      case CellType::triangle:
      case CellType::quadrilateral: {
        const int size = type == CellType::triangle ? 3 : 4;
        for (int i = 0; i < size; ++i) volume += 0.5 * cross(p(i), p((i + 1) % size)).z;
        break;
      }
      case CellType::tetrahedron:
        face({0, 2, 1}), face({0, 1, 3}), face({1, 2, 3}), face({2, 0, 3});
        break;
      case CellType::hexahedron:
        face({0, 3, 2, 1}), face({4, 5, 6, 7}), face({0, 1, 5, 4});
        face({1, 2, 6, 5}), face({2, 3, 7, 6}), face({3, 0, 4, 7});
        break;
      case CellType::prism:
        face({0, 2, 1}), face({3, 4, 5}), face({0, 1, 4, 3}), face({1, 2, 5, 4}), face({2, 0, 3, 5});
        break;
      case CellType::pyramid:
        face({0, 3, 2, 1}), face({0, 1, 4}), face({1, 2, 4}), face({2, 3, 4}), face({3, 0, 4});
        break;
    }
    mesh.volume.push_back(volume);
  }
  return mesh;
}

}  // namespace cobasis
