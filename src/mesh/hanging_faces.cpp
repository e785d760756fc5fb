#include "mesh/hanging_faces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>

#include "math/errors.hpp"
#include "mesh/geometry.hpp"
#include "mesh/topology.hpp"

namespace cobasis {
namespace {

struct Corners {
  std::array<Point, 4> points;
  std::size_t size;
  std::span<const Point> span() const { return {points.data(), size}; }
};

Corners corners_of(const RawMesh& raw, const FaceLink& face) {
  std::array<std::int32_t, 4> nodes{};
  Corners corners{{}, static_cast<std::size_t>(face_nodes(raw, face.left, face.left_local, nodes.data()))};
  for (std::size_t i = 0; i < corners.size; ++i) corners.points[i] = raw.nodes[nodes[i]];
  return corners;
}

/// Whether p, which lies in the plane of the face, lies in the face.
bool contains(std::span<const Point> corners, const Point& area, const Point& p) {
  if (corners.size() == 2) return dot(p - corners[0], p - corners[1]) < 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point& a = corners[i];
    const Point& b = corners[(i + 1) % corners.size()];
    if (dot(cross(b - a, p - a), area) < 0) return false;
  }
  return true;
}

/// The first boundary face of the other side that covers the centroid of `face`, or null.
const FaceLink* opposite_face(const RawMesh& raw, std::span<const FaceLink> boundary, const FaceLink& face) {
  const FaceGeometry here = face_geometry(corners_of(raw, face).span());
  for (const FaceLink& other : boundary) {
    const Corners corners = corners_of(raw, other);
    const FaceGeometry there = face_geometry(corners.span());
    const double area = length(there.area), size = length(corners.points[1] - corners.points[0]);
    const bool opposed = dot(here.area, there.area) < -0.9 * length(here.area) * area;
    const bool coplanar = std::abs(dot(here.centroid - there.centroid, there.area)) < 1e-6 * size * area;
    if (opposed && coplanar && contains(corners.span(), there.area, here.centroid)) return &other;
  }
  return nullptr;
}

}  // namespace

void check_all_grouped(const RawMesh& raw, const std::vector<FaceLink>& faces) {
  std::vector<FaceLink> boundary, bare;
  for (const FaceLink& face : faces) {
    if (face.right >= 0) continue;
    boundary.push_back(face);
    if (face.group < 0) bare.push_back(face);
  }
  if (bare.empty()) return;
  // Every pair of faces may have to be compared; a few are enough to recognise what is wrong.
  for (std::size_t i = 0; i < std::min<std::size_t>(bare.size(), 200); ++i) {
    const FaceLink* const other = opposite_face(raw, boundary, bare[i]);
    if (other == nullptr) continue;
    const Point at = face_geometry(corners_of(raw, bare[i]).span()).centroid;
    throw InputError(
        fmt::format("hanging face: elements {} and {} touch at ({:.6g}, {:.6g}, {:.6g}) but do not share their nodes "
                    "(in Gmsh, Coherence makes neighbouring entities share their boundary)",
                    raw.cell_tag[bare[i].left], raw.cell_tag[other->left], at.x, at.y, at.z));
  }
  const Point at = face_geometry(corners_of(raw, bare[0]).span()).centroid;
  throw InputError(
      fmt::format("{} of {} boundary faces are in no physical group, for example that of element {} at "
                  "({:.6g}, {:.6g}, {:.6g}); every boundary needs a Physical {}",
                  bare.size(), boundary.size(), raw.cell_tag[bare[0].left], at.x, at.y, at.z,
                  raw.dimension == 2 ? "Curve" : "Surface"));
}

}  // namespace cobasis
