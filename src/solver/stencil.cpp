#include "solver/stencil.hpp"

#include <algorithm>
#include <cmath>

namespace cobasis {
namespace {

using Matrix3 = std::array<std::array<double, 3>, 3>;

/// Inverse of a symmetric positive matrix; in a plane zz is 1 and xz, yz are 0.
Matrix3 inverse(const Matrix3& m) {
  const auto minor = [&](int i, int j) {
    const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
    return m[a][c] * m[b][d] - m[a][d] * m[b][c];
  };
  const double det = m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2);
  Matrix3 result;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) result[i][j] = minor(j, i) / det;
  return result;
}

double diagonal(const Mesh& mesh, const Mpi& mpi) {
  Point low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
  for (const Point& x : mesh.nodes) {
    low = {std::min(low.x, x.x), std::min(low.y, x.y), std::min(low.z, x.z)};
    high = {std::max(high.x, x.x), std::max(high.y, x.y), std::max(high.z, x.z)};
  }
  const Point size{mpi.max(high.x) - mpi.min(low.x), mpi.max(high.y) - mpi.min(low.y),
                   mpi.max(high.z) - mpi.min(low.z)};
  return std::sqrt(dot(size, size));
}

/// How much the gradient of the cell itself counts in the average, where its neighbours count 1 each; negative: alone.
/// The values are the most accurate that keep Hancock's scheme stable at CFL 0.8 on regular meshes.
double own_weight(CellType type) {
  switch (type) {
    case CellType::triangle:
      return 0.5;
    case CellType::tetrahedron:
      return 0;
    case CellType::prism:
    case CellType::pyramid:
      return 1;
    default:
      return -1;
  }
}

}  // namespace

Stencil make_stencil(const Mesh& mesh, const Faces& faces, const std::vector<Boundary>& boundaries, PhaseCount phases,
                     const Mpi& mpi) {
  const bool several = phases == PhaseCount::several;
  Stencil stencil;
  stencil.size = faces.max_cell_faces;
  stencil.stride = faces.cell_stride;
  const std::size_t entries = static_cast<std::size_t>(stencil.size) * stencil.stride;
  stencil.cell.assign(entries, 0);
  stencil.mirror.assign(entries, 0);
  stencil.body_mirror.assign(entries, 0);
  stencil.average.assign(entries, 0);
  for (int d = 0; d < 3; ++d) {
    stencil.weight[d].assign(entries, 0);
    if (several) stencil.delta[d].assign(entries, 0);
    stencil.to_face[d].assign(entries, 0);
  }
  stencil.tolerance.assign(stencil.stride, 0);
  stencil.at_mirror.assign(stencil.stride, 0);

  std::vector<bool> is_mirror(mesh.n_boundary_faces), is_symmetry(mesh.n_boundary_faces),
      is_inflow(mesh.n_boundary_faces);
  for (std::size_t i = 0; i < boundaries.size(); ++i)
    for (std::int32_t f = mesh.boundary_groups[i].first; f < mesh.boundary_groups[i].last; ++f) {
      const std::int32_t b = f - mesh.first_boundary_face();
      is_mirror[b] = is_mirror_image(boundaries[i]);
      is_symmetry[b] = is_plane_of_symmetry(boundaries[i]);
      is_inflow[b] = std::holds_alternative<Inflow>(boundaries[i]);
    }
  const double domain = diagonal(mesh, mpi);
  for (std::int32_t cell = 0; cell < mesh.n_owned; ++cell) {
    Matrix3 normal_matrix{{{0, 0, 0}, {0, 0, 0}, {0, 0, mesh.dimension == 2 ? 1.0 : 0.0}}};
    const auto delta_of = [&](std::int32_t entry) {
      const double sign = entry & 1 ? -1 : 1;
      return sign * mesh.face_delta[entry >> 1];
    };
    for (int j = 0; j < stencil.size; ++j) {
      const std::size_t at = static_cast<std::size_t>(j) * stencil.stride + cell;
      stencil.cell[at] = cell;
      const std::int32_t entry = mesh.cell_faces[at], face = entry >> 1;
      if (entry < 0) continue;
      const Point delta = delta_of(entry), to_left = mesh.face_centroid[face] - mesh.centroid[mesh.left[face]];
      const Point r = entry & 1 ? to_left + delta : to_left;
      stencil.to_face[0][at] = r.x, stencil.to_face[1][at] = r.y, stencil.to_face[2][at] = r.z;
      if (face < mesh.first_boundary_face())
        stencil.cell[at] = entry & 1 ? mesh.left[face] : mesh.right[face];
      else if (is_inflow[face - mesh.first_boundary_face()])
        stencil.cell[at] = mesh.ghost_of(face);
      else if (is_mirror[face - mesh.first_boundary_face()])
        stencil.mirror[at] = 2, stencil.at_mirror[cell] = 1,
        stencil.body_mirror[at] = is_symmetry[face - mesh.first_boundary_face()];
      const double x[3] = {delta.x, delta.y, delta.z};
      for (int d = 0; d < 3 && several; ++d) stencil.delta[d][at] = x[d];
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) normal_matrix[a][b] += x[a] * x[b];
    }
    const double own = own_weight(mesh.cell_type[cell]);
    int others = 0;
    const auto has_neighbour = [&](int j) {  // another cell, or its own mirror image
      const std::size_t at = static_cast<std::size_t>(j) * stencil.stride + cell;
      const std::int32_t entry = mesh.cell_faces[at];
      return entry >= 0 && ((entry >> 1) < mesh.first_boundary_face() || stencil.mirror[at] != 0);
    };
    for (int j = 0; j < stencil.size; ++j) others += has_neighbour(j);
    for (int j = 0; j < stencil.size && own >= 0; ++j)
      if (has_neighbour(j))
        stencil.average[static_cast<std::size_t>(j) * stencil.stride + cell] = 1 / (own + others),
                                                                       stencil.averages = true;
    const Matrix3 solve = inverse(normal_matrix);
    for (int j = 0; j < stencil.size; ++j) {
      const std::size_t at = static_cast<std::size_t>(j) * stencil.stride + cell;
      if (mesh.cell_faces[at] < 0) continue;
      const Point delta = delta_of(mesh.cell_faces[at]);
      for (int a = 0; a < 3; ++a)
        stencil.weight[a][at] = solve[a][0] * delta.x + solve[a][1] * delta.y + solve[a][2] * delta.z;
    }
    // Of the share, not of the cell: a root of a power of two is none, and bits would depend on the unit of length.
    const double share = mesh.measure(cell) / (mesh.dimension == 3 ? domain * domain * domain : domain * domain);
    stencil.tolerance[cell] = std::pow(share, 1.5 / mesh.dimension);
  }
  stencil.averages = mpi.any(stencil.averages);
  return stencil;
}

bool Stencil::averages_in(std::int32_t owned_cell) const {
  double shares = 0;
  for (int j = 0; j < size; ++j) shares += average[static_cast<std::size_t>(j) * stride + owned_cell];
  return shares > 0;
}

}  // namespace cobasis
