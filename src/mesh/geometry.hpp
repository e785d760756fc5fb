// Volumes, areas and centroids. A quadrilateral face is four triangles about the mean of its corners, from both of its
// cells alike: cells with warped faces are closed and fill space without gap or overlap.
#pragma once

#include <span>

#include "mesh/mesh.hpp"

namespace cobasis {

struct FaceGeometry {
  Point area;  ///< area vector, out of the cell whose corner order is given [m^2], in a plane [m]
  Point centroid;
};

struct CellGeometry {
  double volume = 0;  ///< signed [m^3], in a plane [m^2]
  Point centroid;
};

/// A ring: what a plane cell or face sweeps around the x axis. Centroids weigh by the distance from it.
struct RingGeometry {
  double circumference = 0;  ///< of the circle on which the section's own centroid moves [m]
  Point centroid;
};

/// Unit normal n and first tangent t1 with n·t1 = 0; t1 = (-ny, nx, 0) scaled to 1, or where n is close to the z axis a
/// vector without x component.
struct FaceFrame {
  Point n, t1;
};

double length(const Point& a);
FaceGeometry face_geometry(std::span<const Point> corners);  ///< 2 (in z = 0), 3 or 4 corners
CellGeometry cell_geometry(CellType type, std::span<const Point> corners);
RingGeometry ring_of_face(std::span<const Point> corners);  ///< 2 corners
RingGeometry ring_of_cell(const CellGeometry& section, std::span<const Point> corners);
FaceFrame face_frame(const Point& area);

}  // namespace cobasis
