// Meshes for tests: written to a folder of their own, read on the ranks of the test.
#pragma once

#include <fmt/format.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <string>

#include "math/errors.hpp"
#include "mesh/read_mesh.hpp"

namespace cobasis {

/// A folder that goes with its owner.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "cobasis_mesh_XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string path(const std::string& name) const { return path_ + "/" + name; }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name), std::ios::binary) << text;
    return path(name);
  }

 private:
  std::string path_;
};

inline const Mpi& test_mpi() {
  static int argc = 0;
  static char** argv = nullptr;
  static const Mpi mpi(argc, argv);
  return mpi;
}

inline Mesh read(const std::string& file, std::vector<std::pair<std::string, std::string>> periodic = {}) {
  MeshRequest request;
  request.file = file;
  request.periodic = std::move(periodic);
  return read_mesh(request, test_mpi());
}

inline Mesh read_text(const std::string& name, const std::string& text,
                      std::vector<std::pair<std::string, std::string>> periodic = {}) {
  const Folder folder;
  return read(folder.write(name, text), std::move(periodic));
}

/// The text of the InputError that reading raises, empty if there is none.
inline std::string error_of(const MeshRequest& request) {
  try {
    read_mesh(request, test_mpi());
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

inline std::string error_of(const std::string& file) {
  MeshRequest request;
  request.file = file;
  return error_of(request);
}

inline std::string error_of_text(const std::string& name, const std::string& text) {
  const Folder folder;
  return error_of(folder.write(name, text));
}

/// nx x ny squares or, unless recombined, triangles on [0,1] x [0,ny/nx]; groups left right bottom top.
inline std::string strip_geo(int nx, int ny, bool recombine = true) {
  return fmt::format("DefineConstant[ nx = {}, ny = {{{}, Name \"Parameters/ny\"}} ];", nx, ny) + R"(
h = ny / nx;
Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1, h, 0}; Point(4) = {0, h, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Transfinite Curve {1, 3} = nx + 1; Transfinite Curve {2, 4} = ny + 1; Transfinite Surface {1};
)" + (recombine ? "Recombine Surface {1};\n" : "") +
         R"(Physical Curve("bottom") = {1}; Physical Curve("right") = {2};
Physical Curve("top") = {3}; Physical Curve("left") = {4};
)";
}

/// A box meshed with tetrahedra of size h; one group "wall".
inline std::string tetrahedra_geo(double h) {
  return "SetFactory(\"OpenCASCADE\"); Box(1) = {0, 0, 0, 1, 1, 1}; Mesh.MeshSizeMax = " + std::to_string(h) + R"(;
Physical Surface("wall") = {1, 2, 3, 4, 5, 6}; Physical Volume("body") = {1};
)";
}

/// The largest |sum of area vectors| of an owned cell, relative to its faces' area; also checks the cell-face table.
inline double worst_gap(const Mesh& mesh) {
  double worst = 0;
  for (std::int32_t i = 0; i < mesh.n_owned; ++i) {
    Point sum;
    double total = 0;
    for (int j = 0; j < mesh.max_cell_faces; ++j) {
      const std::int32_t entry = mesh.cell_faces[j * mesh.cell_stride + i];
      if (entry < 0) continue;
      const std::int32_t f = entry / 2;
      CHECK((entry % 2 == 0 ? mesh.left : mesh.right)[f] == i);
      const double sign = entry % 2 == 0 ? 1 : -1;
      sum = sum + sign * mesh.area[f] * Point{mesh.nx[f], mesh.ny[f], mesh.nz[f]};
      total += mesh.area[f];
    }
    worst = std::max(worst, std::sqrt(dot(sum, sum)) / total);
  }
  return worst;
}

inline double total_volume(const Mesh& mesh) {
  double sum = 0;
  for (std::int32_t i = 0; i < mesh.n_owned; ++i) sum += mesh.volume[i];
  return sum;
}

}  // namespace cobasis
