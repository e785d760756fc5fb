#include "solver/faces.hpp"

namespace cobasis {
namespace {

template <class To, class From>
AlignedVector<To> padded(const std::vector<From>& values, std::size_t n, To fill) {
  AlignedVector<To> result(values.begin(), values.end());
  result.resize((n + 2 * pack_width) / pack_width * pack_width, fill);
  return result;
}

}  // namespace

Faces make_faces(const Mesh& mesh) {
  Faces faces;
  faces.n = mesh.n_faces();
  const std::size_t n = mesh.left.size();
  faces.left = padded<std::int32_t>(mesh.left, n, 0);
  faces.right = padded<std::int32_t>(mesh.right, n, 0);
  faces.area = padded<double>(mesh.area, n, 0);
  faces.nx = padded<double>(mesh.nx, n, 1);
  faces.ny = padded<double>(mesh.ny, n, 0);
  faces.nz = padded<double>(mesh.nz, n, 0);
  faces.tx = padded<double>(mesh.tx, n, 0);
  faces.ty = padded<double>(mesh.ty, n, 1);
  faces.tz = padded<double>(mesh.tz, n, 0);
  faces.fastest.assign(faces.area.size(), 0);

  faces.max_cell_faces = mesh.max_cell_faces;
  faces.cell_stride = mesh.cell_stride;
  faces.cell_faces.assign(mesh.cell_faces.begin(), mesh.cell_faces.end());
  for (std::int32_t& entry : faces.cell_faces)
    if (entry < 0) entry = 2 * faces.n;
  return faces;
}

}  // namespace cobasis
