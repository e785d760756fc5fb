// The part of a face behind a plane.
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "mesh/cell_shape.hpp"
#include "mesh/geometry.hpp"
#include "solver/plane_cut.hpp"
#include "solver/simplex_below.hpp"

namespace cobasis {
namespace {

/// The times t in [low, high], in that order, at which the plane sweeps over a simplex of a face.
struct Sweep {
  double low, high;

  /// Means of 1, A and A^2 over the part of the sweep between h and k, times its length; A = (t - from) * inverse.
  struct Means {
    double zeroth, first, second;
  };
  Means between(double h, double k, double from, double inverse, double second_inverse) const {
    const double a = std::clamp(low, h, k), b = std::clamp(high, h, k);
    const double p = (a - from) * inverse, q = (b - from) * inverse;
    const double u = (a - from) * second_inverse, v = (b - from) * second_inverse;
    return {b - a, 0.5 * (b - a) * (p + q), (b - a) / 6 * (2 * p * u + p * v + q * u + 2 * q * v)};
  }
  double after(double h) const { return std::max(0.0, high - std::max(low, h)); }
};

double mean_below(std::array<double, 2> h, const Sweep& sweep) {
  sort_pair(h[0], h[1]);
  const double inverse = inverse_gap(h[0], h[1]);
  if (sweep.low == sweep.high) return part_below(sweep.low, h[0], inverse);
  return (sweep.between(h[0], h[1], h[0], inverse, 0).first + sweep.after(h[1])) / (sweep.high - sweep.low);
}

double mean_below(std::array<double, 3> h, const Sweep& sweep) {
  if (sweep.low == sweep.high) return SortedSimplex<2, double>(h).below(sweep.low).fraction;
  sort_pair(h[0], h[1]), sort_pair(h[1], h[2]), sort_pair(h[0], h[1]);
  const double i01 = inverse_gap(h[0], h[1]), i02 = inverse_gap(h[0], h[2]), i12 = inverse_gap(h[1], h[2]);
  const Sweep::Means above = sweep.between(h[1], h[2], h[2], i12, i02);
  return (sweep.between(h[0], h[1], h[0], i01, i02).second + (above.zeroth - above.second) + sweep.after(h[2])) /
         (sweep.high - sweep.low);
}

/// Quadrilaterals: the mean over their four triangles, weighted as the mesh weighs them for the face's centroid.
double mean_below(const FaceOutline& face, const std::array<double, 4>& h, const Sweep& sweep) {
  if (face.size == 2) return mean_below(std::array{h[0], h[1]}, sweep);
  if (face.size == 3) return mean_below(std::array{h[0], h[1], h[2]}, sweep);
  const auto& p = face.corner;
  const Point normal = cross(p[2] - p[0], p[3] - p[1]);
  const Point m = 0.25 * (p[0] + p[1] + p[2] + p[3]);
  const double h_m = 0.25 * (h[0] + h[1] + h[2] + h[3]);
  double whole = 0, below = 0;
  for (int i = 0; i < 4; ++i) {
    const int j = (i + 1) % 4;
    const double weight = dot(cross(p[i] - m, p[j] - m), normal);
    whole += weight;
    below += weight * mean_below(std::array{h[i], h[j], h_m}, sweep);
  }
  return below / whole;
}

FaceOutline outline(const Mesh& mesh, std::int32_t cell, int local, const Point& center) {
  const FaceCorners& face = shape_of(mesh.cell_type[cell]).faces[local];
  const std::int32_t* const nodes = &mesh.cell_nodes[mesh.cell_node_begin[cell]];
  FaceOutline result;
  result.size = face.size;
  for (int i = 0; i < face.size; ++i) result.corner[i] = mesh.nodes[nodes[face.corner[i]]] - center;
  if (mesh.axisymmetric) {
    const Point &a = mesh.nodes[nodes[face.corner[0]]], &b = mesh.nodes[nodes[face.corner[1]]];
    if (a.y == 0 && b.y == 0) return result;
    result.size = 4;
    result.corner[2] = result.corner[1] + Point{0, 0, b.y};
    result.corner[3] = result.corner[0] + Point{0, 0, a.y};
  }
  return result;
}

}  // namespace

FaceOutlines::FaceOutlines(const Mesh& mesh) : mesh_(&mesh), local_(mesh.n_faces()) {
  for (std::int32_t face = 0; face < mesh.n_faces(); ++face) {
    const std::int32_t cell = mesh.left[face];
    double smallest = std::numeric_limits<double>::infinity();
    for (int local = 0; local < shape_of(mesh.cell_type[cell]).n_faces; ++local) {
      const FaceOutline o = outline(mesh, cell, local, mesh.face_centroid[face]);
      Point off = face_geometry({o.corner.data(), static_cast<std::size_t>(o.size)}).centroid;
      if (mesh.axisymmetric) off.z = 0;
      if (const double square = dot(off, off); square < smallest) {
        smallest = square;
        local_[face] = static_cast<std::int8_t>(local);
      }
    }
  }
}

FaceOutline FaceOutlines::operator[](std::int32_t face) const {
  return outline(*mesh_, mesh_->left[face], local_[face], mesh_->face_centroid[face]);
}

Point FaceOutlines::center(std::int32_t face, int side) const {
  const Point from_left = mesh_->face_centroid[face] - mesh_->centroid[mesh_->left[face]];
  return side == 0 ? from_left : from_left - mesh_->face_delta[face];
}

Point wetted_centroid(const FaceOutline& face, const Point& center, const CutPlane& plane) {
  const double s = dot(plane.n, center) - plane.d;
  std::array<double, 4> h{};
  for (int i = 0; i < face.size; ++i) h[i] = s + dot(plane.n, face.corner[i]);
  // what is left of the polygon, corner by corner
  std::array<Point, 8> kept;
  int n = 0;
  for (int i = 0; i < face.size; ++i) {
    const int j = (i + 1) % face.size;
    if (h[i] <= 0) kept[n++] = face.corner[i];
    if ((h[i] <= 0) != (h[j] <= 0) && (face.size > 2 || i == 0))
      kept[n++] = face.corner[i] + h[i] / (h[i] - h[j]) * (face.corner[j] - face.corner[i]);
  }
  if (n < 2) return {};
  if (face.size == 2) return 0.5 * (kept[0] + kept[1]);
  Point area, moment;
  for (int i = 1; i + 1 < n; ++i) area = area + cross(kept[i] - kept[0], kept[i + 1] - kept[0]);
  double whole = 0;
  for (int i = 1; i + 1 < n; ++i) {
    const double part = dot(cross(kept[i] - kept[0], kept[i + 1] - kept[0]), area);
    whole += part;
    moment = moment + part / 3 * (kept[0] + kept[i] + kept[i + 1]);
  }
  return whole > 0 ? 1 / whole * moment : Point{};
}

double wetted_fraction(const FaceOutline& face, const Point& center, const CutPlane& plane, double shift) {
  const double s = dot(plane.n, center) - plane.d;
  std::array<double, 4> h{};
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest, size = 0;
  for (int i = 0; i < face.size; ++i) {
    h[i] = s + dot(plane.n, face.corner[i]);
    lowest = std::min(lowest, h[i]);
    highest = std::max(highest, h[i]);
    size = std::max(size, dot(face.corner[i], face.corner[i]));
  }
  const double nearly_zero = 1e-24 * (size + dot(center, center));
  if (lowest * lowest <= nearly_zero && highest * highest <= nearly_zero) return shift > 0 ? 1 : shift < 0 ? 0 : 0.5;
  const Sweep sweep{std::min(shift, 0.0), std::max(shift, 0.0)};
  if (highest <= sweep.low) return 1;
  if (lowest >= sweep.high) return 0;
  return std::clamp(mean_below(face, h, sweep), 0.0, 1.0);
}

}  // namespace cobasis
