// Boundary conditions: every physical group of the mesh's boundary gets exactly one.
#pragma once

#include <vector>

#include "mesh/mesh.hpp"
#include "mesh/mpi.hpp"
#include "solver/faces.hpp"
#include "solver/setup.hpp"

namespace cobasis {

/// The boundary of each of the mesh's groups, in its order. Throws InputError (file:line) if the case names a group
/// that the mesh lacks, or the mesh has one that the case neither names nor covers with "*".
std::vector<Boundary> resolve_boundaries(const Setup& setup, const Mesh& mesh);

/// The axis is where an axisymmetric mesh touches y = 0, and only there. Throws InputError, on all ranks together, if a
/// group's faces say otherwise. Collective.
void check_axis(const Setup& setup, const Mesh& mesh, const std::vector<Boundary>& boundaries, const Mpi& mpi);

/// Whether what is seen of a scene is mirrored there: interfaces and bodies go on beyond.
inline bool is_plane_of_symmetry(const Boundary& boundary) {
  return std::holds_alternative<Symmetry>(boundary) || std::holds_alternative<AxisOfSymmetry>(boundary);
}

/// Whether the state beyond is the mirror image of the cell's own.
inline bool is_mirror_image(const Boundary& boundary) {
  const auto* wall = std::get_if<Wall>(&boundary);
  return (wall && !wall->velocity) || is_plane_of_symmetry(boundary);
}

/// Whether the faces read Faces::prescribed.
inline bool is_prescribed(const Boundary& boundary) {
  const auto* wall = std::get_if<Wall>(&boundary);
  return (wall && wall->velocity) || std::holds_alternative<NoSlip>(boundary) ||
         std::holds_alternative<Outlet>(boundary);
}

/// Faces::prescribed, if there is a boundary that reads it.
void prescribe(const Mesh& mesh, const std::vector<Boundary>& boundaries, Faces& faces);

}  // namespace cobasis
