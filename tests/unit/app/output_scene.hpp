// A mesh of squares and states on it, made by hand for the tests of what is written.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"
#include "mesh/mpi.hpp"
#include "solver/setup.hpp"
#include "solver/snapshot.hpp"

namespace cobasis::test {

/// All ranks of the test program; lives until it ends, as MPI starts once only.
inline const Mpi& world() {
  static int argc = 0;
  static char** argv = nullptr;
  static const Mpi mpi(argc, argv);
  return mpi;
}

/// nx x ny squares of side h from the origin, cells numbered row by row. `periodic_x` joins left and right.
inline Mesh squares(int nx, int ny, double h, bool periodic_x = false) {
  Mesh mesh;
  mesh.dimension = 2;
  mesh.n_owned = nx * ny;
  mesh.n_global = mesh.n_owned;
  for (int j = 0; j <= ny; ++j) {
    for (int i = 0; i <= nx; ++i) mesh.nodes.push_back({h * i, h * j, 0});
  }
  mesh.cell_node_begin.push_back(0);
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      mesh.volume.push_back(h * h);
      mesh.centroid.push_back({h * (i + 0.5), h * (j + 0.5), 0});
      mesh.global_id.push_back(i + nx * j);
      mesh.cell_type.push_back(CellType::quadrilateral);
      mesh.cell_region.push_back(-1);
      const int corner = i + (nx + 1) * j;
      for (const int node : {corner, corner + 1, corner + nx + 2, corner + nx + 1}) mesh.cell_nodes.push_back(node);
      mesh.cell_node_begin.push_back(static_cast<std::int32_t>(mesh.cell_nodes.size()));
    }
  }

  std::vector<std::vector<std::int32_t>> faces_of(static_cast<std::size_t>(mesh.n_owned));
  const auto add_face = [&](int left, int right, Point normal, Point centroid, Point delta) {
    const auto face = static_cast<std::int32_t>(mesh.area.size());
    mesh.left.push_back(left);
    mesh.right.push_back(right);
    mesh.area.push_back(h);
    mesh.nx.push_back(normal.x);
    mesh.ny.push_back(normal.y);
    mesh.nz.push_back(0);
    mesh.tx.push_back(-normal.y);
    mesh.ty.push_back(normal.x);
    mesh.tz.push_back(0);
    mesh.face_centroid.push_back(centroid);
    mesh.face_delta.push_back(delta);
    faces_of[left].push_back(2 * face);
    if (right < mesh.n_owned) faces_of[right].push_back(2 * face + 1);
  };
  const auto centre = [&](int cell) { return mesh.centroid[cell]; };
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i + 1 < nx; ++i) {
      const int cell = i + nx * j;
      add_face(cell, cell + 1, {1, 0, 0}, centre(cell) + Point{h / 2, 0, 0}, {h, 0, 0});
    }
    if (periodic_x) add_face(nx * j, nx * j + nx - 1, {-1, 0, 0}, centre(nx * j) - Point{h / 2, 0, 0}, {-h, 0, 0});
  }
  for (int cell = 0; cell + nx < nx * ny; ++cell) {
    add_face(cell, cell + nx, {0, 1, 0}, centre(cell) + Point{0, h / 2, 0}, {0, h, 0});
  }
  mesh.n_interior_faces = static_cast<std::int32_t>(mesh.area.size());
  const auto add_boundary = [&](int cell, Point normal) {
    add_face(cell, mesh.n_owned + mesh.n_ghosts++, normal, centre(cell) + (h / 2) * normal, h * normal);
    ++mesh.n_boundary_faces;
  };
  for (int j = 0; j < ny && !periodic_x; ++j) {
    add_boundary(nx * j, {-1, 0, 0});
    add_boundary(nx * j + nx - 1, {1, 0, 0});
  }
  for (int i = 0; i < nx; ++i) {
    add_boundary(i, {0, -1, 0});
    add_boundary(nx * (ny - 1) + i, {0, 1, 0});
  }
  mesh.boundary_groups = {{"outside", mesh.n_interior_faces, mesh.n_faces()}};

  mesh.max_cell_faces = 4;
  mesh.cell_stride = (mesh.n_owned + 15) / 16 * 16;
  mesh.cell_faces.assign(static_cast<std::size_t>(4 * mesh.cell_stride), -1);
  for (std::size_t i = 0; i < faces_of.size(); ++i) {
    for (std::size_t j = 0; j < faces_of[i].size(); ++j) mesh.cell_faces[j * mesh.cell_stride + i] = faces_of[i][j];
  }
  return mesh;
}

/// A solid, a gas and a void, of which `Snapshot`s have values that tell cells and components apart.
inline Setup three_phases(const std::filesystem::path& directory) {
  Setup setup;
  setup.case_file = "impact.toml";
  setup.phases.resize(3);
  setup.phases[0].name = "copper";
  setup.phases[0].elastic = HyperelasticMaterial{};
  setup.phases[1].name = "gas";
  setup.phases[2].name = "outside";
  setup.phases[2].void_pressure = 10;
  setup.output.directory = directory.string();
  setup.output.fields = {"alpha", "density", "velocity", "pressure", "stress", "cobasis", "energy"};
  return setup;
}

inline PhaseSnapshot phase_state(const std::string& name, std::vector<double> alpha, double base, bool is_solid) {
  PhaseSnapshot phase;
  phase.name = name;
  phase.is_solid = is_solid;
  const auto values = [&](double first) {
    std::vector<double> result;
    for (std::size_t i = 0; i < alpha.size(); ++i) {
      result.push_back(alpha[i] > 0 ? base + first + 0.125 * static_cast<double>(i) : 0);
    }
    return result;
  };
  phase.density = values(1);
  for (int c = 0; c < 3; ++c) phase.velocity[c] = values(10 + c);
  phase.pressure = values(20);
  for (int c = 0; c < 6; ++c) phase.stress[c] = values(30 + c);
  for (int c = 0; c < 9 && is_solid; ++c) phase.cobasis[c] = values(40 + c);
  phase.energy = values(50);
  if (is_solid) phase.elastic_energy = values(51);
  phase.alpha = std::move(alpha);
  return phase;
}

/// copper: 1, 1, 0.5, 0, 0, … ; gas: 0, 0, 0.25, 1, 1, … ; the void takes the rest of the third cell.
inline Snapshot three_phase_state(int n, double time) {
  std::vector<double> copper(static_cast<std::size_t>(n)), gas(copper), nothing(copper);
  for (std::size_t i = 0; i < copper.size(); ++i) {
    copper[i] = i < 2 ? 1 : i == 2 ? 0.5 : 0;
    gas[i] = i < 2 ? 0 : i == 2 ? 0.25 : 1;
    nothing[i] = 1 - copper[i] - gas[i];
  }
  Snapshot snapshot;
  snapshot.step = 7;
  snapshot.time = time;
  snapshot.dt = 0.5;
  snapshot.phases = {phase_state("copper", copper, 100, true), phase_state("gas", gas, 200, false), {}};
  snapshot.phases[2].name = "outside";
  snapshot.phases[2].is_void = true;
  snapshot.phases[2].alpha = nothing;
  return snapshot;
}

/// A directory that is gone with the object.
struct Scratch {
  std::filesystem::path path;
  Scratch() {
    std::string name = (std::filesystem::temp_directory_path() / "cobasis_output_XXXXXX").string();
    path = ::mkdtemp(name.data());
  }
  ~Scratch() { std::filesystem::remove_all(path); }
};

inline std::string read(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// Of a CSV text: rows of words, the header first.
inline std::vector<std::vector<std::string>> table(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back();
    std::istringstream words(line);
    for (std::string word; std::getline(words, word, ',');) rows.back().push_back(word);
  }
  return rows;
}

inline std::string cell_of(const std::vector<std::vector<std::string>>& rows, std::size_t row,
                           const std::string& column) {
  for (std::size_t c = 0; c < rows.front().size(); ++c) {
    if (rows.front()[c] == column) return rows.at(row).at(c);
  }
  return "no such column";
}

}  // namespace cobasis::test
