// Small meshes and scenes made in memory, with a solver on top.
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <set>

#include "mesh/cell_shape.hpp"
#include "mesh/distribute.hpp"
#include "physics/material_library.hpp"
#include "solver/solver.hpp"

namespace cobasis {

inline const Mpi& one_rank() {
  static int argc = 0;
  static char** argv = nullptr;
  static const Mpi mpi(argc, argv);
  return mpi;
}

/// Boundary elements for all faces of one cell: "left", "right", "bottom", "top", "back", "front" by the first
/// coordinate that is the same for all corners (`place`: the nodes before they were moved).
inline void add_sides(RawMesh& raw, const std::vector<Point>& place, const Point& extent) {
  raw.group_names = {"left", "right", "bottom", "top", "back", "front"};
  std::map<std::set<int>, std::pair<int, std::array<std::int32_t, 4>>> faces;
  for (int cell = 0; cell < raw.n_cells(); ++cell) {
    const CellShape& shape = shape_of(raw.cell_type[cell]);
    for (int f = 0; f < shape.n_faces; ++f) {
      std::array<std::int32_t, 4> corners{-1, -1, -1, -1};
      std::set<int> key;
      for (int i = 0; i < shape.faces[f].size; ++i)
        key.insert(corners[i] = raw.cell_nodes[raw.cell_node_begin[cell] + shape.faces[f].corner[i]]);
      auto& entry = faces[key];
      ++entry.first;
      entry.second = corners;
    }
  }
  const std::array<std::function<bool(const Point&)>, 6> on = {
      [](const Point& p) { return p.x == 0; }, [&](const Point& p) { return p.x == extent.x; },
      [](const Point& p) { return p.y == 0; }, [&](const Point& p) { return p.y == extent.y; },
      [](const Point& p) { return p.z == 0; }, [&](const Point& p) { return p.z == extent.z; }};
  for (const auto& [key, entry] : faces) {
    if (entry.first != 1) continue;
    for (int group = 0; group < 6; ++group) {
      if (!std::all_of(key.begin(), key.end(), [&](int node) { return on[group](place[node]); })) continue;
      raw.side_nodes.push_back(entry.second);
      raw.side_tag.push_back(static_cast<std::int64_t>(raw.side_tag.size()) + 1);
      raw.side_group.push_back(group);
      break;
    }
  }
}

inline Mesh connected(RawMesh raw, bool axisymmetric = false) {
  const GlobalMesh whole = build_global_mesh(std::move(raw), {}, axisymmetric);
  return PartCutter(whole, std::vector<int>(whole.n_cells(), 0), 1).cut(0);
}

/// The unit square or cube in n cells per edge (before splitting), interior nodes moved by up to `warp` / n.
inline Mesh small_mesh(CellType type, int n, double warp = 0.2, bool axisymmetric = false) {
  const bool plane = type == CellType::triangle || type == CellType::quadrilateral;
  RawMesh raw;
  raw.dimension = plane ? 2 : 3;
  std::vector<Point> place;
  const int nz = plane ? 0 : n;
  for (int k = 0; k <= nz; ++k) {
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i) {
        place.push_back({double(i) / n, double(j) / n, plane ? 0.5 : double(k) / n});
        const bool edge = i % n == 0 || j % n == 0 || (!plane && k % n == 0);
        const auto shift = [&](double phase) {
          return edge ? 0 : warp / n * std::sin(12.9898 * i + 78.233 * j + 37.719 * k + phase);
        };
        raw.nodes.push_back(
            {place.back().x + shift(0), place.back().y + shift(1), plane ? 0 : place.back().z + shift(2)});
      }
    }
  }
  const auto add = [&](std::initializer_list<int> corners) {
    raw.cell_nodes.insert(raw.cell_nodes.end(), corners);
    raw.cell_node_begin.push_back(static_cast<std::int32_t>(raw.cell_nodes.size()));
    raw.cell_type.push_back(type);
    raw.cell_tag.push_back(raw.n_cells());
    raw.cell_region.push_back(-1);
  };
  for (int k = 0; k < std::max(nz, 1); ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const auto at = [&](int a, int b, int c) { return ((k + c) * (n + 1) + j + b) * (n + 1) + i + a; };
        const int up = plane ? 0 : 1;
        const std::array<int, 8> v{at(0, 0, 0),  at(1, 0, 0),  at(1, 1, 0),  at(0, 1, 0),
                                   at(0, 0, up), at(1, 0, up), at(1, 1, up), at(0, 1, up)};
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
          default:  // tetrahedra about the diagonal
            add({v[0], v[1], v[2], v[6]}), add({v[0], v[2], v[3], v[6]}), add({v[0], v[3], v[7], v[6]});
            add({v[0], v[7], v[4], v[6]}), add({v[0], v[4], v[5], v[6]}), add({v[0], v[5], v[1], v[6]});
        }
      }
    }
  }
  add_sides(raw, place, {1, 1, 1});
  return connected(std::move(raw), axisymmetric);
}

/// Rectangles of height 1 between the given x.
inline Mesh strip(const std::vector<double>& x) {
  RawMesh raw;
  raw.dimension = 2;
  for (const double y : {0.0, 1.0})
    for (const double xi : x) raw.nodes.push_back({xi, y, 0});
  const int n = static_cast<int>(x.size());
  for (int i = 0; i + 1 < n; ++i) {
    for (const int node : {i, i + 1, n + i + 1, n + i}) raw.cell_nodes.push_back(node);
    raw.cell_node_begin.push_back(4 * (i + 1));
    raw.cell_type.push_back(CellType::quadrilateral);
    raw.cell_tag.push_back(i + 1);
    raw.cell_region.push_back(-1);
  }
  std::vector<Point> place = raw.nodes;
  for (Point& p : place) p.z = 0.5;
  add_sides(raw, place, {x.back(), 1, 1});
  return connected(std::move(raw));
}

inline std::int32_t cell_at(const Mesh& mesh, double x) {
  std::int32_t nearest = 0;
  for (std::int32_t cell = 0; cell < mesh.n_owned; ++cell)
    if (std::fabs(mesh.centroid[cell].x - x) < std::fabs(mesh.centroid[nearest].x - x)) nearest = cell;
  return nearest;
}

inline PhaseSetup phase_of(const std::string& material) {
  PhaseSetup phase;
  phase.name = material;
  if (material == "void") {
    phase.void_pressure = 1e5;
    return phase;
  }
  const Material& found = *find_material(material);
  phase.eos = found.eos;
  phase.elastic = found.elastic;
  phase.density = found.rho0;
  return phase;
}

/// One phase everywhere else: `share` in region 0, the rest evenly to the others.
inline std::vector<double> mostly(int k, int n, double share) {
  std::vector<double> alpha(n, n == 1 ? 0 : (1 - share) / (n - 1));
  alpha[k] = n == 1 ? 1 : share;
  return alpha;
}

/// Moving, deformed matter: the first phase everywhere, a ball of the next, a corner block of the last, a band in which
/// all phases are mixed. With `mixed_in` of each phase in every region.
inline Setup busy_setup(const std::vector<std::string>& materials, bool plane, Contact contact = Contact::sliding,
                        double mixed_in = 0) {
  Setup setup;
  setup.case_file = "busy";
  setup.scene = plane ? Geometry::plane : Geometry::space;
  setup.end_time = 1;
  setup.scheme = {.order = 1, .interface = InterfaceTreatment::diffuse};
  setup.default_contact = contact;
  for (const std::string& material : materials) setup.phases.push_back(phase_of(material));
  const int n = static_cast<int>(materials.size());
  const auto state = [&](double p, const std::string& u, const std::string& v, const std::string& w, double shear) {
    PhaseState s;
    s.pressure = p;
    s.velocity = {Expression(u), Expression(v), Expression(plane ? "0" : w)};
    const double out = plane ? 0 : shear;
    s.cobasis = {{{1.01, shear, 0.5 * out}, {-0.5 * shear, 0.98, -out}, {out, 0.3 * out, 1.02}}};
    return s;
  };
  const auto region = [&](Shape shape, std::vector<double> alpha, const PhaseState& s) {
    std::vector<PhaseState> states(n, s);
    for (int k = 0; k < n; ++k)
      if (!setup.phases[k].is_solid()) states[k].cobasis.reset();
    setup.regions.push_back({std::move(shape), {std::move(alpha), std::move(states)}, "busy:1"});
  };
  const double share = 1 - mixed_in * (n - 1);
  region(Everywhere{}, mostly(0, n, share), state(2e5, "20 * sin(5 * y)", "15 * cos(4 * x)", "10 * sin(3 * x)", 0.04));
  region(Sphere{{0.4, 0.55, plane ? 0 : 0.45}, 0.27}, mostly(n > 1 ? 1 : 0, n, share),
         state(8e5, "40 - 20 * y", "-25 * x", "30 * y", -0.05));
  region(Box{{0.62, -1, -1}, {2, 0.4, 2}}, mostly(n - 1, n, share), state(3e5, "-30", "20 * y", "5", 0.02));
  region(HalfSpace{{0, 0.9, 0}, {0, 1, 0}}, std::vector<double>(n, 1.0 / n), state(4e5, "-10", "5", "3", 0.03));
  Inflow inflow;
  inflow.filling = setup.regions[1].filling;
  for (PhaseState& s : inflow.filling.states) s.velocity = {Expression(15.0), Expression(-5.0), Expression(0.0)};
  setup.boundaries = {{"left", inflow, "busy:2"}, {"right", Transmissive{}, "busy:3"}, {"*", Wall{}, "busy:4"}};
  return setup;
}

struct SmallScene {
  std::unique_ptr<Mesh> mesh;
  std::unique_ptr<Solver> solver;
};

inline SmallScene small_scene(const Setup& setup, Mesh mesh, SolverOptions options = {}) {
  SmallScene scene;
  scene.mesh = std::make_unique<Mesh>(std::move(mesh));
  scene.solver = std::make_unique<Solver>(setup, *setup.scene, *scene.mesh, one_rank(), std::move(options));
  return scene;
}

/// Largest difference of any component, relative to that component's largest magnitude (momentum: of the vector);
/// infinite where one is no number.
inline double largest_difference(const Fields& a, const Fields& b) {
  double worst = 0;
  const auto compare = [&](const auto& x, const auto& y, double scale) {
    for (std::int32_t cell = 0; cell < a.n_owned; ++cell) {
      const double difference = std::fabs(x[cell] - y[cell]);
      if (!(difference <= worst * scale))
        worst = std::isnan(difference) ? std::numeric_limits<double>::infinity() : difference / scale;
    }
  };
  const auto magnitude = [&](const auto& x) {
    double largest = 1e-300;
    for (std::int32_t cell = 0; cell < a.n_owned; ++cell) largest = std::max(largest, std::fabs(x[cell]));
    return largest;
  };
  for (int k = 0; k < a.n_phases(); ++k) {
    const Phase &p = a.phases[k], &q = b.phases[k];
    if (!p.alpha.empty()) compare(p.alpha, q.alpha, 1);
    if (p.is_void) continue;
    double momentum = 0;
    for (int i = 1; i <= a.dimension; ++i) momentum = std::max(momentum, magnitude(p.conserved[i]));
    for (int c = 0; c < p.n_conserved(); ++c) {
      const bool vector = c >= 1 && c <= a.dimension;
      compare(p.conserved[c], q.conserved[c],
              vector                  ? momentum
              : c < a.first_cobasis() ? magnitude(p.conserved[c])
                                      : 1);
    }
  }
  return worst;
}

}  // namespace cobasis
