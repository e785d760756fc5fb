// The six cell types: corners and outward faces in Gmsh's order.
#pragma once

#include <array>

#include "mesh/mesh.hpp"

namespace cobasis {

/// Corners of a face in the order of its cell, counter-clockwise seen from outside; in a plane two, the cell on the
/// left.
struct FaceCorners {
  int size = 0;
  std::array<int, 4> corner{};
};

struct CellShape {
  int dimension = 0;
  int n_corners = 0;
  int n_faces = 0;
  std::array<FaceCorners, 6> faces{};
  const char* name = "";
};

inline constexpr std::array<CellShape, 6> cell_shapes{{
    {2, 3, 3, {{{2, {0, 1}}, {2, {1, 2}}, {2, {2, 0}}}}, "triangle"},
    {2, 4, 4, {{{2, {0, 1}}, {2, {1, 2}}, {2, {2, 3}}, {2, {3, 0}}}}, "quadrilateral"},
    {3, 4, 4, {{{3, {0, 2, 1}}, {3, {0, 1, 3}}, {3, {1, 2, 3}}, {3, {0, 3, 2}}}}, "tetrahedron"},
    {3,
     8,
     6,
     {{{4, {0, 3, 2, 1}},
       {4, {4, 5, 6, 7}},
       {4, {0, 1, 5, 4}},
       {4, {1, 2, 6, 5}},
       {4, {2, 3, 7, 6}},
       {4, {3, 0, 4, 7}}}},
     "hexahedron"},
    {3, 6, 5, {{{3, {0, 2, 1}}, {3, {3, 4, 5}}, {4, {0, 1, 4, 3}}, {4, {1, 2, 5, 4}}, {4, {2, 0, 3, 5}}}}, "prism"},
    {3, 5, 5, {{{4, {0, 3, 2, 1}}, {3, {0, 1, 4}}, {3, {1, 2, 4}}, {3, {2, 3, 4}}, {3, {3, 0, 4}}}}, "pyramid"},
}};

constexpr const CellShape& shape_of(CellType type) { return cell_shapes[static_cast<std::size_t>(type)]; }

}  // namespace cobasis
