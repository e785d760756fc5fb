// Gradients of cell values: which neighbours count with which weights, exact for linear fields on any mesh.
#pragma once

#include "mesh/mesh.hpp"
#include "mesh/mpi.hpp"
#include "solver/boundary.hpp"
#include "solver/faces.hpp"
#include "solver/field.hpp"

namespace cobasis {

/// Weighted least squares over the neighbours of a cell: gradient = sum over entries j of weight_j (value_j - value).
/// Entry j of a cell stands at [j * stride + cell]; the first entries are the cell's faces in its own order.
struct Stencil {
  std::int32_t size = 0;  ///< entries per cell
  std::int32_t stride = 0;
  AlignedVector<std::int32_t> cell;  ///< the neighbour; the cell itself behind a mirror and where there is none
  AlignedVector<double> weight[3];   ///< [1/m]
  AlignedVector<double> delta[3];    ///< to the neighbour's centroid [m]; of scenes with several phases
  /// Where cells are simplices: gradient of a cell + sum over entries of average_j (gradient_j - gradient). Least
  /// squares over the few faces of a tetrahedron alone makes an unstable scheme.
  AlignedVector<double> average;
  bool averages = false;  ///< whether any cell of any rank needs that
  bool averages_in(std::int32_t owned_cell) const;
  AlignedVector<double> to_face[3];       ///< from the cell's centroid to those of its faces [m]
  AlignedVector<double> mirror;           ///< 2 where the face is a mirror: its normal turns the values, else 0
  AlignedVector<double> body_mirror;      ///< 1 where it is a plane of symmetry, else 0
  AlignedVector<double> tolerance;        ///< per cell: (size of the cell / size of the domain)^(3/2)
  AlignedVector<std::int32_t> at_mirror;  ///< per cell: whether one of its faces is a mirror
};

/// Of the scene.
enum class PhaseCount { one, several };

/// `boundaries`: one for each of the mesh's groups. Collective.
Stencil make_stencil(const Mesh& mesh, const Faces& faces, const std::vector<Boundary>& boundaries, PhaseCount phases,
                     const Mpi& mpi);

}  // namespace cobasis
