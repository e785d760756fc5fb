// Geometry of a sharp interface: a plane in a cell, and the part of the cell's faces behind it.
//
// A cell is the union of the simplices by which the mesh measures its volume, a face that of the triangles by which the
// mesh measures its area, so that cell and faces agree, warped faces included. Everything here is a pure function of
// corners relative to the cell's centroid, in the cell's own order: the same bits on every rank that knows the cell.
// Nothing allocates.
//
// Of a ring only the section is cut, but volumes and areas go with the distance r from the axis. They are those of a
// body in space: the part of a prism over the section that lies below z = r. The plane stands upright on the section.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/mesh.hpp"

namespace cobasis {

/// s(x) = n·(x - centroid of the cell) - d; the phase lies where s <= 0. n is a unit vector, in a plane scene with
/// z = 0.
struct CutPlane {
  Point n;
  double d = 0;
};

/// The same plane, the phase on its other side.
inline CutPlane complement(const CutPlane& plane) { return {-1.0 * plane.n, -plane.d}; }

/// A cell ready for cutting.
struct CellCorners {
  static constexpr int most_points = 15, most_simplices = 24;
  CellType type = CellType::triangle;  ///< of a ring the prism or hexahedron over its section
  bool is_ring = false;
  double volume = 0;                                    ///< of all simplices [m^3], in a plane [m^2]
  std::array<Point, most_points> point;                 ///< corners, means of quadrilateral faces, mean of the corners
  std::array<double, most_simplices> simplex_volume{};  ///< with sign; zeros follow those that the type has
};

/// `cell` is an owned or a halo cell.
CellCorners corners_of(const Mesh& mesh, std::int32_t cell);

/// Fraction of the cell's volume with s <= 0, in [0, 1]; exactly 0 or 1 where the plane does not cut the cell. A small
/// fraction keeps its relative accuracy.
double volume_below(const CellCorners& cell, const CutPlane& plane);

/// The d with volume_below(cell, {n, d}) = fraction, for fractions in (0, 1); as exact as a double d allows: relative
/// to min(fraction, 1 - fraction), down to slivers. For fractions <= 0 and >= 1 the cell's lowest and highest corner.
double place_plane(const CellCorners& cell, const Point& n, double fraction);

/// Centroid of the part of the cell with s <= 0, relative to the cell's; the cell's own if there is none.
Point centroid_below(const CellCorners& cell, const CutPlane& plane);

/// The part of a plane inside a cell.
struct PlaneSection {
  double area = 0;  ///< [m^2], in a plane [m], of a ring over 2 pi; 0 if the plane misses the cell
  Point centroid;   ///< relative to the cell's centroid
};

/// A plane in a face of the cell: the face if the cell lies below it, nothing if it lies above.
PlaneSection section(const CellCorners& cell, const CutPlane& plane);

/// Corners of a face relative to its centroid, in the order of the left cell; of a ring's the trapezoid below z = r.
struct FaceOutline {
  int size = 0;  ///< 2 in a plane and on an axis, else 3 or 4
  std::array<Point, 4> corner;
};

/// The outlines of a rank's faces, the same bits on both ranks of a halo face.
class FaceOutlines {
 public:
  /// `mesh` must outlive this.
  explicit FaceOutlines(const Mesh& mesh);

  FaceOutline operator[](std::int32_t face) const;

  /// Centroid of the face relative to that of its left (side = 0) or right cell (side = 1), through the periodic image.
  Point center(std::int32_t face, int side) const;

 private:
  const Mesh* mesh_;
  std::vector<std::int8_t> local_;  // number of the face among those of its left cell
};

/// Mean of the fraction of a face that lies at s <= 0 while the plane moves along n by `shift` (= V dt, of any sign,
/// also 0): (1 / shift) ∫_0^shift fraction(d + t) dt, exact. `center`: the face's centroid relative to the centroid of
/// the plane's cell. A face in the plane (to 1e-12 of its distance and size) counts as 1, 0 or 1/2 for a shift
/// above, below or equal to 0.
double wetted_fraction(const FaceOutline& face, const Point& center, const CutPlane& plane, double shift);

/// Centroid of the part of a face that lies at s <= 0, relative to the face's; the face's own if there is none.
Point wetted_centroid(const FaceOutline& face, const Point& center, const CutPlane& plane);

}  // namespace cobasis
