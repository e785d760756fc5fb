#include "app/sampler.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "math/errors.hpp"
#include "math/field_info.hpp"

namespace cobasis {
namespace {

constexpr double round_off = 1e-9;  ///< of a cell's size: room for coordinates far from the origin

double norm(const Point& a) { return std::sqrt(dot(a, a)); }

double size_of(const Mesh& mesh, std::int32_t cell) {
  return mesh.dimension == 2 ? std::sqrt(mesh.measure(cell)) : std::cbrt(mesh.volume[cell]);
}

/// The face's centroid as the cell at its right sees it: elsewhere if the face joins periodic images.
Point centroid_from_right(const Mesh& mesh, std::int32_t face) {
  const Point& delta = mesh.face_delta[face];
  const Point shift = mesh.centroid[mesh.right[face]] - mesh.centroid[mesh.left[face]] - delta;
  return norm(shift) > round_off * norm(delta) ? mesh.face_centroid[face] + shift : mesh.face_centroid[face];
}

/// How far the point lies outside the planes of the cell's faces, the worst of them [m]; negative inside.
double violation(const Mesh& mesh, std::int32_t cell, const Point& x) {
  double worst = -infinity;
  for (int j = 0; j < mesh.max_cell_faces; ++j) {
    const std::int32_t entry = mesh.cell_faces[j * mesh.cell_stride + cell];
    if (entry < 0) continue;
    const std::int32_t face = entry / 2;
    const Point normal{mesh.nx[face], mesh.ny[face], mesh.nz[face]};
    const double outside =
        entry % 2 == 0 ? dot(x - mesh.face_centroid[face], normal) : -dot(x - centroid_from_right(mesh, face), normal);
    worst = std::max(worst, outside);
  }
  return worst;
}

struct Bounds {
  Point low{infinity, infinity, infinity};
  Point high{-infinity, -infinity, -infinity};

  bool contains(const Point& x) const {
    return low.x <= x.x && x.x <= high.x && low.y <= x.y && x.y <= high.y && low.z <= x.z && x.z <= high.z;
  }
};

Bounds bounds_of(const Mesh& mesh, std::int32_t cell, double margin) {
  Bounds box;
  for (std::int32_t j = mesh.cell_node_begin[cell]; j < mesh.cell_node_begin[cell + 1]; ++j) {
    const Point& x = mesh.nodes[mesh.cell_nodes[j]];
    box.low = {std::min(box.low.x, x.x), std::min(box.low.y, x.y), std::min(box.low.z, x.z)};
    box.high = {std::max(box.high.x, x.x), std::max(box.high.y, x.y), std::max(box.high.z, x.z)};
  }
  const Point room{margin, margin, margin};
  return {box.low - room, box.high + room};
}

/// Narrows [first, last] to the part of the line, 0 … 1, on which a coordinate lies between low and high.
void clip(double from, double direction, double low, double high, double& first, double& last) {
  if (direction == 0) {
    if (from < low || from > high) last = -1;
    return;
  }
  const double a = (low - from) / direction;
  const double b = (high - from) / direction;
  first = std::max(first, std::min(a, b));
  last = std::min(last, std::max(a, b));
}

/// Half-open range of the points of a line that may lie in the box.
std::pair<std::int64_t, std::int64_t> points_in(const std::vector<Point>& points, const Bounds& box) {
  const Point& from = points.front();
  const Point direction = points.back() - from;
  double first = 0;
  double last = 1;
  clip(from.x, direction.x, box.low.x, box.high.x, first, last);
  clip(from.y, direction.y, box.low.y, box.high.y, first, last);
  clip(from.z, direction.z, box.low.z, box.high.z, first, last);
  if (first > last) return {0, 0};
  const auto n = static_cast<std::int64_t>(points.size());
  const auto intervals = static_cast<double>(n - 1);
  return {std::max<std::int64_t>(static_cast<std::int64_t>(first * intervals) - 1, 0),
          std::min<std::int64_t>(static_cast<std::int64_t>(last * intervals) + 2, n)};
}

/// Cells that may hold points, as parallel arrays.
struct Candidates {
  std::vector<std::int64_t> ids;  ///< per candidate: point, the cell's global id
  std::vector<double> depths;     ///< per candidate: violation [m], size of the cell [m]
  std::vector<std::int32_t> cells;
};

Candidates find_candidates(const Mesh& mesh, const std::vector<Point>& points) {
  Candidates found;
  for (std::int32_t i = 0; i < mesh.n_owned; ++i) {
    const double size = size_of(mesh, i);
    const Bounds box = bounds_of(mesh, i, round_off * size);
    const auto [first, last] = points_in(points, box);
    double tolerance = -1;
    for (std::int64_t p = first; p < last; ++p) {
      if (!box.contains(points[p])) continue;
      if (tolerance < 0) {
        // Between the mean planes of warped faces is room that belongs to nobody: about as much as they cut off from
        // the cell's own corners. None where faces are plane.
        tolerance = round_off * size;
        for (std::int32_t j = mesh.cell_node_begin[i]; j < mesh.cell_node_begin[i + 1]; ++j) {
          tolerance = std::max(tolerance, round_off * size + 2 * violation(mesh, i, mesh.nodes[mesh.cell_nodes[j]]));
        }
      }
      const double outside = violation(mesh, i, points[p]);
      if (outside > tolerance) continue;
      found.ids.insert(found.ids.end(), {p, mesh.global_id[i]});
      found.depths.insert(found.depths.end(), {outside, size});
      found.cells.push_back(i);
    }
  }
  return found;
}

/// Global id of the cell per point, -1 where there is none; from the candidates of all ranks.
std::vector<std::int64_t> choose(std::size_t n_points, const std::vector<std::int64_t>& ids,
                                 const std::vector<double>& depths) {
  std::vector<double> least(n_points, infinity);
  for (std::size_t c = 0; c < ids.size(); c += 2) least[ids[c]] = std::min(least[ids[c]], depths[c]);
  std::vector<std::int64_t> chosen(n_points, -1);
  for (std::size_t c = 0; c < ids.size(); c += 2) {
    std::int64_t& cell = chosen[ids[c]];
    const bool tie = depths[c] <= least[ids[c]] + round_off * depths[c + 1];
    if (tie && (cell < 0 || ids[c + 1] < cell)) cell = ids[c + 1];
  }
  return chosen;
}

std::vector<std::int64_t> broadcast(const Mpi& mpi, const std::vector<std::int64_t>& values) {
  std::vector<char> bytes(values.size() * sizeof(std::int64_t));
  if (!bytes.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  mpi.broadcast(bytes);
  std::vector<std::int64_t> result(bytes.size() / sizeof(std::int64_t));
  if (!bytes.empty()) std::memcpy(result.data(), bytes.data(), bytes.size());
  return result;
}

}  // namespace

std::vector<Point> points_on_line(const Point& from, const Point& to, int n) {
  std::vector<Point> points;
  for (int i = 0; i < n; ++i) {
    points.push_back(i > 0 && i == n - 1 ? to : from + (static_cast<double>(i) / std::max(n - 1, 1)) * (to - from));
  }
  return points;
}

Sampler::Sampler(const Mesh& mesh, const Mpi& mpi, std::vector<Point> points, const std::string& what)
    : points_(std::move(points)) {
  const Candidates mine = find_candidates(mesh, points_);
  const auto all_ids = mpi.gather(std::span<const std::int64_t>(mine.ids));
  const auto all_depths = mpi.gather(std::span<const double>(mine.depths));
  std::vector<std::int64_t> chosen;
  if (mpi.root()) chosen = choose(points_.size(), all_ids, all_depths);
  chosen = broadcast(mpi, chosen);

  const auto nowhere = std::find(chosen.begin(), chosen.end(), -1);
  if (nowhere != chosen.end()) {
    const Point& x = points_[nowhere - chosen.begin()];
    throw InputError(fmt::format("{}: the point ({}, {}, {}) lies outside the mesh", what, x.x, x.y, x.z));
  }
  std::vector<std::int64_t> my_points;
  for (std::size_t c = 0; c < mine.cells.size(); ++c) {
    if (chosen[mine.ids[2 * c]] != mine.ids[2 * c + 1]) continue;
    cells_.push_back(mine.cells[c]);
    my_points.push_back(mine.ids[2 * c]);
  }
  point_of_row_ = mpi.gather(std::span<const std::int64_t>(my_points));
}

std::vector<double> Sampler::in_order(const Mpi& mpi, std::span<const double> values) const {
  const std::vector<double> rows = mpi.gather(values);
  std::vector<double> result(rows.size());
  const std::size_t length = points_.empty() ? 0 : rows.size() / points_.size();
  for (std::size_t r = 0; r < point_of_row_.size(); ++r) {
    std::copy_n(rows.begin() + static_cast<std::ptrdiff_t>(r * length), length,
                result.begin() + static_cast<std::ptrdiff_t>(point_of_row_[r]) * static_cast<std::ptrdiff_t>(length));
  }
  return result;
}

Snapshot extract(const Snapshot& snapshot, std::span<const std::int32_t> cells) {
  const auto pick = [&](const std::vector<double>& all) {
    std::vector<double> some;
    if (all.empty()) return some;
    for (const std::int32_t cell : cells) some.push_back(all[cell]);
    return some;
  };
  Snapshot result{snapshot.step, snapshot.time, snapshot.dt, {}};
  for (const PhaseSnapshot& phase : snapshot.phases) {
    PhaseSnapshot part;
    part.name = phase.name;
    part.is_void = phase.is_void;
    part.is_solid = phase.is_solid;
    part.rho0 = phase.rho0;
    part.alpha = pick(phase.alpha);
    part.density = pick(phase.density);
    for (int c = 0; c < 3; ++c) part.velocity[c] = pick(phase.velocity[c]);
    part.pressure = pick(phase.pressure);
    for (int c = 0; c < 6; ++c) part.stress[c] = pick(phase.stress[c]);
    for (int c = 0; c < 9; ++c) part.cobasis[c] = pick(phase.cobasis[c]);
    part.energy = pick(phase.energy);
    part.elastic_energy = pick(phase.elastic_energy);
    result.phases.push_back(std::move(part));
  }
  return result;
}

}  // namespace cobasis
