// How much of a cell lies inside a shape.
#pragma once

#include <cstdint>

#include "mesh/mesh.hpp"
#include "solver/setup.hpp"

namespace cobasis {

/// Fraction of the cell's volume that lies inside the shape, in [0, 1]; exactly 0 or 1 for a cell that is not cut, and
/// within 1e-12 of them. A function of the cell's corners alone, so the same for every partition.
///
/// half_space, box: exact to round-off, also for hexahedra, prisms and pyramids with warped faces: the cell is the
/// union of the simplices by which the mesh measures its volume. sphere, cylinder: relative error of the body's volume
/// below 1e-6, on any mesh whose cells are not 300 times as large as it is thick. An `inside` condition only says yes
/// or no: error about 1e-3 of a cell that is cut (1e-2 in the worst), and what holds at none of a cell's corners and of
/// the midpoints between two of them goes unseen. In a plane the z of points is ignored; in an axisymmetric mesh
/// fractions are of the volumes of rings. `cell` is an owned or a halo cell. A physical group that the mesh has not:
/// fraction 0 (paint refuses it before).
double inside_fraction(const Shape& shape, const Mesh& mesh, std::int32_t cell);

}  // namespace cobasis
