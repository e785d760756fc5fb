#include "solver/plane_cut.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "math/pack.hpp"
#include "mesh/cell_shape.hpp"
#include "mesh/geometry.hpp"
#include "solver/simplex_below.hpp"

namespace cobasis {
namespace {

// --- the cell as simplices ---

constexpr int most_simplices = CellCorners::most_simplices;
constexpr int most_packs = most_simplices / pack_width;
static_assert(most_simplices % pack_width == 0);

/// Simplices as numbers of CellCorners::point; corner i of simplex s is corner[i][s]. Those that the type lacks have
/// all corners in point 0.
struct Split {
  int n_points = 0, n_simplices = 0;
  std::array<std::array<std::int32_t, most_simplices>, 4> corner{};

  constexpr void add(std::array<int, 4> points) {
    for (int i = 0; i < 4; ++i) corner[i][n_simplices] = points[i];
    ++n_simplices;
  }
  constexpr int n_packs() const { return (n_simplices + pack_width - 1) / pack_width; }
};

constexpr Split split_of(const CellShape& shape) {
  Split split;
  split.n_points = shape.n_corners;
  if (shape.dimension == 2) {
    for (int i = 2; i < shape.n_corners; ++i) split.add({0, i - 1, i, 0});
    return split;
  }
  if (shape.n_corners == 4) {
    split.add({0, 1, 2, 3});
    return split;
  }
  int n_quadrilaterals = 0;
  for (int f = 0; f < shape.n_faces; ++f) n_quadrilaterals += shape.faces[f].size == 4;
  const int center = shape.n_corners + n_quadrilaterals;
  for (int f = 0; f < shape.n_faces; ++f) {
    const FaceCorners& face = shape.faces[f];
    if (face.size == 3) {
      split.add({center, face.corner[0], face.corner[1], face.corner[2]});
      continue;
    }
    for (int i = 0; i < 4; ++i) split.add({center, face.corner[i], face.corner[(i + 1) % 4], split.n_points});
    ++split.n_points;
  }
  ++split.n_points;
  return split;
}

constexpr std::array<Split, 6> splits{split_of(cell_shapes[0]), split_of(cell_shapes[1]), split_of(cell_shapes[2]),
                                      split_of(cell_shapes[3]), split_of(cell_shapes[4]), split_of(cell_shapes[5])};

constexpr const Split& split_of(CellType type) { return splits[static_cast<std::size_t>(type)]; }

/// Heights n·x of the cell's points.
struct Heights {
  std::array<double, CellCorners::most_points> of{};
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;

  Heights(const CellCorners& cell, const Point& n) : Heights(cell, n, 0, 0) {}

  /// Heights that are d but for `tolerance` are d.
  Heights(const CellCorners& cell, const Point& n, double d, double tolerance) {
    const int n_points = split_of(cell.type).n_points;
    for (int i = 0; i < n_points; ++i) {
      of[i] = dot(n, cell.point[i]);
      if (std::abs(of[i] - d) < tolerance) of[i] = d;
      lowest = std::min(lowest, of[i]);
      highest = std::max(highest, of[i]);
    }
  }
};

// --- a cell below a height ---

template <int D>
class CellBelow {
 public:
  CellBelow(const CellCorners& cell, const Heights& heights) : n_packs_(split_of(cell.type).n_packs()) {
    const Split& split = split_of(cell.type);
    for (int k = 0; k < n_packs_; ++k) {
      std::array<Pack, D + 1> h;
      for (int i = 0; i <= D; ++i)
        h[i] = gather<Pack>(heights.of.data(), load_indices<Pack>(&split.corner[i][k * pack_width]));
      simplices_[k] = SortedSimplex<D, Pack>(h);
      volume_[k] = load<Pack>(&cell.simplex_volume[k * pack_width]);
    }
  }

  double volume(double d) const {
    Pack sum = 0.0;
    for (int k = 0; k < n_packs_; ++k) sum += volume_[k] * simplices_[k].below(d).fraction;
    return reduce(sum);
  }

  std::pair<double, double> volume_and_area(double d) const {
    Pack sum = 0.0, slope = 0.0;
    for (int k = 0; k < n_packs_; ++k) {
      const Below<Pack> part = simplices_[k].below(d);
      sum += volume_[k] * part.fraction;
      slope += volume_[k] * part.density;
    }
    return {reduce(sum), reduce(slope)};
  }

 private:
  int n_packs_;
  std::array<SortedSimplex<D, Pack>, most_packs> simplices_;
  std::array<Pack, most_packs> volume_;
};

/// The height below which `target` of the cell's volume lies, 0 < target <= half of it.
template <int D>
double height_of(const CellCorners& cell, const Heights& heights, double target) {
  const CellBelow<D> below(cell, heights);
  // Between two heights of points that follow each other the volume is a polynomial of degree D.
  std::array<double, CellCorners::most_points> level = heights.of;
  int low = 0, high = split_of(cell.type).n_points - 1;
  std::sort(level.begin(), level.begin() + high + 1);
  double volume_low = 0, volume_high = cell.volume;
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    const double volume = below.volume(level[middle]);
    (volume <= target ? low : high) = middle;
    (volume <= target ? volume_low : volume_high) = volume;
  }
  double a = level[low], b = level[high];
  const double middle = 0.5 * (a + b), half = 0.5 * (b - a);
  const auto [volume_middle, area] = below.volume_and_area(middle);
  const double c1 = area * half, c2 = 0.5 * ((volume_high - volume_middle) + (volume_low - volume_middle));
  const double c3 = 0.5 * (volume_high - volume_low) - c1;
  // Newton's method between bounds: bisect where it would leave them.
  double t_low = -1, t_high = 1, t = volume_middle > target ? -0.5 : 0.5;
  for (int iteration = 0; iteration < 60; ++iteration) {
    const double excess = volume_middle - target + t * (c1 + t * (c2 + t * c3));
    (excess > 0 ? t_high : t_low) = t;
    double next = t - excess / (c1 + t * (2 * c2 + t * 3 * c3));
    if (!(next > t_low && next < t_high)) next = 0.5 * (t_low + t_high);
    if (std::abs(next - t) < 1e-10) break;
    t = next;
  }
  // The polynomial is exact to round-off of the cell's volume; slivers want that of their own.
  double d = middle + half * t;
  for (int iteration = 0; iteration < 60; ++iteration) {
    const auto [volume, slope] = below.volume_and_area(d);
    const double excess = volume - target;
    (excess > 0 ? b : a) = d;
    double next = d - excess / slope;
    if (!(next >= a && next <= b)) next = 0.5 * (a + b);
    const bool converged = std::abs(excess) <= 1e-8 * target || next == d;
    d = next;
    if (converged) break;
  }
  return d;
}

/// Sorts heights; returns which corner each belongs to.
template <int D>
std::array<int, D + 1> sort_heights(std::array<double, D + 1>& h) {
  std::array<int, D + 1> at;
  for (int i = 0; i <= D; ++i) {
    int j = i;
    const double height = h[i];
    for (; j > 0 && h[j - 1] > height; --j) h[j] = h[j - 1], at[j] = at[j - 1];
    h[j] = height, at[j] = i;
  }
  return at;
}

/// Adds volume times section and moment of the section of one simplex.
template <int D>
void add_section(const std::array<const Point*, D + 1>& corner, std::array<double, D + 1> h, double d, double volume,
                 double& area, Point& moment) {
  const std::array<int, D + 1> at = sort_heights<D>(h);
  if (d <= h[0] || d > h[D]) return;
  const auto p = [&](int i) -> const Point& { return *corner[at[i]]; };
  const auto r = [&](int i, int j) { return part_below(d, h[i], inverse_gap(h[i], h[j])); };
  const auto on_edge = [&](int i, int j) { return p(i) + r(i, j) * (p(j) - p(i)); };
  if constexpr (D == 2) {
    const double length = 2 * r(0, 1) * (1 - r(1, 2)) * inverse_gap(h[0], h[2]) * volume;
    const Point bend = d <= h[1] ? on_edge(0, 1) : on_edge(1, 2);
    area += length;
    moment = moment + 0.5 * length * (bend + on_edge(0, 2));
  } else {
    // The triangles (x01 or x12, x02, x03) and (x12 or x23, x13, x03).
    const double scale = 3 * inverse_gap(h[0], h[3]) * volume;
    const double first = scale * r(0, 1) * r(0, 2) * (1 - r(1, 2));
    const double second = scale * r(1, 2) * (1 - r(1, 3)) * (1 - r(2, 3));
    const Point x03 = on_edge(0, 3);
    area += first + second;
    if (first != 0) moment = moment + first / 3 * ((d <= h[1] ? on_edge(0, 1) : on_edge(1, 2)) + on_edge(0, 2) + x03);
    if (second != 0) moment = moment + second / 3 * ((d <= h[2] ? on_edge(1, 2) : on_edge(2, 3)) + on_edge(1, 3) + x03);
  }
}

/// Adds the volume of one simplex below d and its moment.
template <int D>
void add_below(const std::array<const Point*, D + 1>& corner, std::array<double, D + 1> h, double d, double volume,
               double& below, Point& moment) {
  const std::array<int, D + 1> at = sort_heights<D>(h);
  const auto p = [&](int i) -> const Point& { return *corner[at[i]]; };
  const auto r = [&](int i, int j) { return part_below(d, h[i], inverse_gap(h[i], h[j])); };
  const auto x = [&](int i, int j) { return p(i) + r(i, j) * (p(j) - p(i)); };
  const auto add = [&](double part, const Point& corners) {
    below += part * volume;
    moment = moment + (part * volume / (D + 1)) * corners;
  };
  if constexpr (D == 2) {
    add(r(0, 1) * r(0, 2), p(0) + x(0, 1) + x(0, 2));
    add(r(1, 2) * (1 - r(0, 2)), p(1) + x(1, 2) + x(0, 2));
  } else {
    const Point x02 = x(0, 2), x03 = x(0, 3), x12 = x(1, 2), x13 = x(1, 3);
    add(r(0, 1) * r(0, 2) * r(0, 3), p(0) + x(0, 1) + x02 + x03);
    add(r(1, 2) * r(0, 3) * (1 - r(0, 2)), p(1) + x12 + x02 + x03);
    add((1 - r(0, 3)) * r(1, 2) * r(1, 3), p(1) + x12 + x13 + x03);
    add((1 - r(0, 3)) * r(2, 3) * (1 - r(1, 3)), p(2) + x(2, 3) + x13 + x03);
  }
}

/// A measure of a cell's part, and the mean of the positions in it; `add`: what one simplex adds to it and its moment.
template <int D, class Add>
PlaneSection sum_over_simplices(const CellCorners& cell, const Heights& heights, double d, const Add& add) {
  const Split& split = split_of(cell.type);
  double sum = 0;
  Point moment;
  for (int s = 0; s < split.n_simplices; ++s) {
    std::array<const Point*, D + 1> corner;
    std::array<double, D + 1> h;
    for (int i = 0; i <= D; ++i) corner[i] = &cell.point[split.corner[i][s]], h[i] = heights.of[split.corner[i][s]];
    add(corner, h, d, cell.simplex_volume[s], sum, moment);
  }
  if (!(sum > 0)) return {};
  if (cell.is_ring) moment.z = 0;
  return {sum, 1 / sum * moment};
}

std::span<const std::int32_t> nodes_of(const Mesh& mesh, std::int32_t cell) {
  return std::span(mesh.cell_nodes)
      .subspan(mesh.cell_node_begin[cell], mesh.cell_node_begin[cell + 1] - mesh.cell_node_begin[cell]);
}

}  // namespace

CellCorners corners_of(const Mesh& mesh, std::int32_t cell) {
  CellCorners result;
  result.type = mesh.cell_type[cell];
  result.is_ring = mesh.axisymmetric;
  if (result.is_ring) result.type = result.type == CellType::triangle ? CellType::prism : CellType::hexahedron;
  const CellShape& shape = shape_of(result.type);
  const Split& split = split_of(result.type);
  const auto nodes = nodes_of(mesh, cell);
  auto& point = result.point;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    point[i] = mesh.nodes[nodes[i]] - mesh.centroid[cell];
    if (result.is_ring) point[nodes.size() + i] = point[i] + Point{0, 0, mesh.nodes[nodes[i]].y};
  }
  if (shape.n_corners < split.n_points) {
    int n = shape.n_corners;
    for (int f = 0; f < shape.n_faces; ++f) {
      const auto& c = shape.faces[f].corner;
      if (shape.faces[f].size == 4) point[n++] = 0.25 * (point[c[0]] + point[c[1]] + point[c[2]] + point[c[3]]);
    }
    Point sum;
    for (int i = 0; i < shape.n_corners; ++i) sum = sum + point[i];
    point[n] = 1.0 / shape.n_corners * sum;
  }
  for (int s = 0; s < split.n_simplices; ++s) {
    const auto edge = [&](int i) { return point[split.corner[i][s]] - point[split.corner[0][s]]; };
    const Point normal = cross(edge(1), edge(2));
    result.simplex_volume[s] = shape.dimension == 2 ? 0.5 * normal.z : dot(normal, edge(3)) / 6;
    result.volume += result.simplex_volume[s];
  }
  return result;
}

double volume_below(const CellCorners& cell, const CutPlane& plane) {
  const Heights heights(cell, plane.n);
  if (plane.d <= heights.lowest) return 0;
  if (plane.d >= heights.highest) return 1;
  const double below = shape_of(cell.type).dimension == 2 ? CellBelow<2>(cell, heights).volume(plane.d)
                                                          : CellBelow<3>(cell, heights).volume(plane.d);
  return std::clamp(below / cell.volume, 0.0, 1.0);
}

double place_plane(const CellCorners& cell, const Point& n, double fraction) {
  // The smaller side keeps its relative accuracy.
  const bool flipped = fraction > 0.5;
  const double part = flipped ? 1 - fraction : fraction, sign = flipped ? -1 : 1;
  const Heights heights(cell, sign * n);
  if (part <= 0) return sign * heights.lowest;
  return sign * (shape_of(cell.type).dimension == 2 ? height_of<2>(cell, heights, part * cell.volume)
                                                    : height_of<3>(cell, heights, part * cell.volume));
}

PlaneSection section(const CellCorners& cell, const CutPlane& plane) {
  // Round-off must not tear a face that lies in the plane.
  double size = 0;
  for (int i = 0; i < shape_of(cell.type).n_corners; ++i) size = std::max(size, dot(cell.point[i], cell.point[i]));
  const Heights heights(cell, plane.n, plane.d, 1e-15 * std::sqrt(size));
  if (plane.d <= heights.lowest || plane.d > heights.highest) return {};
  return shape_of(cell.type).dimension == 2 ? sum_over_simplices<2>(cell, heights, plane.d, add_section<2>)
                                            : sum_over_simplices<3>(cell, heights, plane.d, add_section<3>);
}

Point centroid_below(const CellCorners& cell, const CutPlane& plane) {
  const Heights heights(cell, plane.n);
  if (plane.d <= heights.lowest || plane.d >= heights.highest) return {};
  return shape_of(cell.type).dimension == 2 ? sum_over_simplices<2>(cell, heights, plane.d, add_below<2>).centroid
                                            : sum_over_simplices<3>(cell, heights, plane.d, add_below<3>).centroid;
}

}  // namespace cobasis
