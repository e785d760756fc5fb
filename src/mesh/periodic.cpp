#include "mesh/periodic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "math/errors.hpp"
#include "math/suggestion.hpp"
#include "mesh/geometry.hpp"
#include "mesh/topology.hpp"

namespace cobasis {
namespace {

struct Side {
  std::size_t face;  ///< index into the list of faces
  std::array<std::int32_t, 4> nodes{};
  std::array<Point, 4> corners{};
  std::size_t n_corners = 0;
  Point centroid;
  double tolerance = 0;  ///< far below the shortest edge, far above the digits of an ASCII file
  double key = 0;        ///< coordinate along a direction in which the nodes of a regular mesh do not coincide
};

constexpr Point direction{0.5773, 0.6297, 0.5198};

std::vector<Side> sides_of(const RawMesh& raw, const std::vector<FaceLink>& faces, std::int32_t group) {
  std::vector<Side> sides;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (faces[f].group != group || faces[f].right >= 0) continue;
    Side side;
    side.face = f;
    side.n_corners = static_cast<std::size_t>(face_nodes(raw, faces[f].left, faces[f].left_local, side.nodes.data()));
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < side.n_corners; ++i) side.corners[i] = raw.nodes[side.nodes[i]];
    for (std::size_t i = 0; i < side.n_corners; ++i)
      shortest = std::min(shortest, length(side.corners[(i + 1) % side.n_corners] - side.corners[i]));
    side.tolerance = 1e-3 * shortest;
    side.centroid = face_geometry({side.corners.data(), side.n_corners}).centroid;
    side.key = dot(side.centroid, direction);
    sides.push_back(side);
  }
  return sides;
}

Point mean_centroid(const std::vector<Side>& sides) {
  Point sum;
  for (const Side& side : sides) sum = sum + (side.centroid - sides.front().centroid);
  return sides.front().centroid + 1.0 / static_cast<double>(sides.size()) * sum;
}

bool matches(const Side& a, const Side& b, const Point& shift) {
  if (a.n_corners != b.n_corners || length(b.centroid - a.centroid - shift) > a.tolerance) return false;
  return std::all_of(a.corners.begin(), a.corners.begin() + a.n_corners, [&](const Point& p) {
    return std::any_of(b.corners.begin(), b.corners.begin() + b.n_corners,
                       [&](const Point& q) { return length(q - p - shift) <= a.tolerance; });
  });
}

std::int32_t group_by_name(const RawMesh& raw, const std::string& name) {
  const auto at = std::find(raw.group_names.begin(), raw.group_names.end(), name);
  if (at == raw.group_names.end())
    throw InputError(fmt::format("periodic boundary '{}' is no physical group of the mesh; {}", name,
                                 allowed_names(name, raw.group_names)));
  return static_cast<std::int32_t>(at - raw.group_names.begin());
}

[[noreturn]] void refuse(const std::pair<std::string, std::string>& pair, const std::string& what, const Point& at) {
  throw InputError(fmt::format("periodic boundaries '{}' and '{}': {} ({:.6g}, {:.6g}, {:.6g})", pair.first,
                               pair.second, what, at.x, at.y, at.z));
}

/// For each first side the index of its second side, which is the first one shifted.
std::vector<std::size_t> match(const std::vector<Side>& first, std::vector<Side>& second, const Point& shift,
                               const std::pair<std::string, std::string>& names) {
  std::sort(second.begin(), second.end(), [](const Side& a, const Side& b) { return a.key < b.key; });
  std::vector<std::size_t> partner;
  std::vector<char> taken(second.size(), 0);
  for (const Side& side : first) {
    const double key = side.key + dot(shift, direction);
    std::size_t b = static_cast<std::size_t>(std::lower_bound(second.begin(), second.end(), key - side.tolerance,
                                                              [](const Side& s, double low) { return s.key < low; }) -
                                             second.begin());
    while (b < second.size() && second[b].key <= key + side.tolerance && (taken[b] || !matches(side, second[b], shift)))
      ++b;
    if (b == second.size() || second[b].key > key + side.tolerance)
      refuse(names,
             fmt::format("no face of '{}' is the face of '{}' shifted by ({:.6g}, {:.6g}, {:.6g}), whose centre is at",
                         names.second, names.first, shift.x, shift.y, shift.z),
             side.centroid);
    taken[b] = 1;
    partner.push_back(b);
  }
  return partner;
}

/// Moves each corner of b to a corner of a, shifted.
void move_onto(RawMesh& raw, const Side& a, const Side& b, const Point& shift) {
  for (std::size_t i = 0; i < b.n_corners; ++i)
    for (std::size_t j = 0; j < a.n_corners; ++j)
      if (length(b.corners[i] - a.corners[j] - shift) <= a.tolerance)
        raw.nodes[b.nodes[i]] = raw.nodes[a.nodes[j]] + shift;
}

/// A pair that joins cells already joined by another face keeps the direction out of the first-named group.
void orient(std::vector<FaceLink>& joined, const std::vector<FaceLink>& others) {
  using Cells = std::pair<std::int32_t, std::int32_t>;
  const auto cells = [](const FaceLink& f) { return Cells(std::min(f.left, f.right), std::max(f.left, f.right)); };
  std::set<Cells> once, twice;
  for (const FaceLink& face : joined)
    if (!once.insert(cells(face)).second) twice.insert(cells(face));
  for (const FaceLink& face : others)
    if (face.right >= 0 && once.contains(cells(face))) twice.insert(cells(face));
  for (FaceLink& face : joined) {
    if (face.left <= face.right || twice.contains(cells(face))) continue;
    std::swap(face.left, face.right);
    std::swap(face.left_local, face.right_local);
    face.image = -face.image;
  }
}

}  // namespace

PeriodicFaces join_periodic(RawMesh& raw, std::vector<FaceLink> faces,
                            const std::vector<std::pair<std::string, std::string>>& pairs) {
  PeriodicFaces result;
  std::vector<FaceLink> joined;
  std::vector<char> gone(faces.size(), 0);
  std::set<std::string> named;
  for (const auto& pair : pairs) {
    for (const std::string& name : {pair.first, pair.second})
      if (!named.insert(name).second)
        throw InputError(fmt::format("boundary '{}' is named twice in periodic pairs", name));
    const std::vector<Side> first = sides_of(raw, faces, group_by_name(raw, pair.first));
    std::vector<Side> second = sides_of(raw, faces, group_by_name(raw, pair.second));
    if (first.empty() || first.size() != second.size())
      throw InputError(fmt::format("periodic boundaries '{}' and '{}' have {} and {} faces", pair.first, pair.second,
                                   first.size(), second.size()));
    const Point shift = mean_centroid(second) - mean_centroid(first);
    const std::vector<std::size_t> partner = match(first, second, shift, pair);
    result.shifts.push_back(shift);
    // Out of the first group and into the second: the right cell lies one shift behind.
    const std::int32_t image = -static_cast<std::int32_t>(result.shifts.size());
    for (std::size_t i = 0; i < first.size(); ++i) {
      const FaceLink &a = faces[first[i].face], &b = faces[second[partner[i]].face];
      joined.push_back({a.left, b.left, a.left_local, b.left_local, -1, image});
      move_onto(raw, first[i], second[partner[i]], shift);
      gone[first[i].face] = gone[second[partner[i]].face] = 1;
    }
  }
  for (std::size_t f = 0; f < faces.size(); ++f)
    if (!gone[f]) result.faces.push_back(faces[f]);
  orient(joined, result.faces);
  result.faces.insert(result.faces.end(), joined.begin(), joined.end());
  return result;
}

}  // namespace cobasis
