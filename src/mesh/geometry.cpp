#include "mesh/geometry.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "mesh/cell_shape.hpp"

namespace cobasis {
namespace {

Point mean(std::span<const Point> points) {
  Point sum;
  for (const Point& p : points) sum = sum + p;
  return 1.0 / static_cast<double>(points.size()) * sum;
}

/// Calls visit(a, b, m) for the triangles of a face.
template <class Visit>
void for_each_triangle(std::span<const Point> corners, Visit visit) {
  if (corners.size() == 3) {
    visit(corners[0], corners[1], corners[2]);
    return;
  }
  const Point m = mean(corners);
  for (std::size_t i = 0; i < 4; ++i) visit(corners[i], corners[(i + 1) % 4], m);
}

CellGeometry polygon_geometry(std::span<const Point> corners) {
  // about the first corner: no cancellation far from the origin
  CellGeometry sum;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const Point a = corners[i] - corners[0], b = corners[i + 1] - corners[0];
    const double part = 0.5 * (a.x * b.y - a.y * b.x);
    sum.volume += part;
    sum.centroid = sum.centroid + part / 3.0 * (a + b);
  }
  sum.centroid = corners[0] + 1.0 / sum.volume * sum.centroid;
  return sum;
}

}  // namespace

double length(const Point& a) { return std::sqrt(dot(a, a)); }

FaceGeometry face_geometry(std::span<const Point> corners) {
  if (corners.size() == 2) {
    const Point d = corners[1] - corners[0];
    return {{d.y, -d.x, 0.0}, 0.5 * (corners[0] + corners[1])};
  }
  if (corners.size() == 3) return {0.5 * cross(corners[1] - corners[0], corners[2] - corners[0]), mean(corners)};
  const Point area = 0.5 * cross(corners[2] - corners[0], corners[3] - corners[1]);
  double total = 0;
  Point centroid;
  for_each_triangle(corners, [&](const Point& a, const Point& b, const Point& m) {
    const double part = dot(cross(a - m, b - m), area);
    total += part;
    centroid = centroid + part / 3.0 * ((a - corners[0]) + (b - corners[0]) + (m - corners[0]));
  });
  return {area, corners[0] + 1.0 / total * centroid};
}

CellGeometry cell_geometry(CellType type, std::span<const Point> corners) {
  const CellShape& shape = shape_of(type);
  if (shape.dimension == 2) return polygon_geometry(corners);
  CellGeometry sum;
  for (int f = 0; f < shape.n_faces; ++f) {
    std::array<Point, 4> face;
    for (int i = 0; i < shape.faces[f].size; ++i) face[i] = corners[shape.faces[f].corner[i]] - corners[0];
    for_each_triangle({face.data(), static_cast<std::size_t>(shape.faces[f].size)},
                      [&](const Point& a, const Point& b, const Point& m) {
                        const double part = dot(a, cross(b, m)) / 6.0;
                        sum.volume += part;
                        sum.centroid = sum.centroid + 0.25 * part * (a + b + m);
                      });
  }
  sum.centroid = corners[0] + 1.0 / sum.volume * sum.centroid;
  return sum;
}

RingGeometry ring_of_face(std::span<const Point> corners) {
  const Point middle = 0.5 * (corners[0] + corners[1]), along = corners[1] - corners[0];
  if (middle.y == 0) return {0, middle};
  return {2 * std::numbers::pi * middle.y, middle + along.y / (12 * middle.y) * along};
}

RingGeometry ring_of_cell(const CellGeometry& section, std::span<const Point> corners) {
  double xy = 0, yy = 0;  // second moments about the centroid
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point a = corners[i] - section.centroid, b = corners[(i + 1) % corners.size()] - section.centroid;
    const double part = 0.5 * (a.x * b.y - a.y * b.x) / 12;
    xy += part * (a.x * a.y + b.x * b.y + (a.x + b.x) * (a.y + b.y));
    yy += part * (a.y * a.y + b.y * b.y + (a.y + b.y) * (a.y + b.y));
  }
  const double radius = section.centroid.y, scale = 1 / (section.volume * radius);
  return {2 * std::numbers::pi * radius, section.centroid + scale * Point{xy, yy, 0}};
}

FaceFrame face_frame(const Point& area) {
  const Point n = 1.0 / length(area) * area;
  // One formula for all faces of extruded and of axis-aligned meshes: round-off in nz must not swing the tangent.
  if (std::abs(n.z) < 0.9) {
    const double s = n.z == 0 ? 1.0 : 1.0 / std::sqrt(n.x * n.x + n.y * n.y);
    return {n, {-s * n.y, s * n.x, 0.0}};
  }
  const double s = 1.0 / std::sqrt(n.y * n.y + n.z * n.z);
  return {n, {0.0, -s * n.z, s * n.y}};
}

}  // namespace cobasis
