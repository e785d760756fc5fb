#include "solver/cut_cell.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "mesh/cell_shape.hpp"
#include "solver/simplex.hpp"

namespace cobasis {
namespace {

/// d(x) = normal·x - offset >= 0 inside; unit normal.
struct Plane {
  Point normal;
  double offset;
  double operator()(const Point& x) const { return dot(normal, x) - offset; }
};

Plane plane_through(const Point& point, const Point& normal) {
  const Point n = (1 / length_of(normal)) * normal;
  return {n, dot(n, point)};
}

/// Signed distance to a sphere (axis = 0) or to an endless cylinder, positive inside.
struct Round {
  Point center, axis;
  double radius;
  double operator()(const Point& x) const {
    const Point d = x - center;
    return radius - length_of(d - dot(d, axis) * axis);
  }
};

// --- the cell as simplices ---

Point mean(const std::vector<Point>& points) {
  Point sum;
  for (const Point& p : points) sum = sum + p;
  return (1.0 / static_cast<double>(points.size())) * sum;
}

template <int D>
std::vector<Simplex<D>> simplices(CellType type, const std::vector<Point>& corners);

template <>
std::vector<Simplex<2>> simplices<2>(CellType type, const std::vector<Point>& corners) {
  if (type == CellType::triangle) return {{corners[0], corners[1], corners[2]}};
  return {{corners[0], corners[1], corners[2]}, {corners[0], corners[2], corners[3]}};
}

/// Faces with four corners are taken as four triangles about the mean of the corners, as the mesh takes them.
template <>
std::vector<Simplex<3>> simplices<3>(CellType type, const std::vector<Point>& corners) {
  if (type == CellType::tetrahedron) return {{corners[0], corners[1], corners[2], corners[3]}};
  std::vector<Simplex<3>> result;
  const Point center = mean(corners);
  const CellShape& shape = shape_of(type);
  for (int f = 0; f < shape.n_faces; ++f) {
    const FaceCorners& face = shape.faces[f];
    const auto corner = [&](int i) { return corners[face.corner[i % face.size]]; };
    if (face.size == 3) {
      result.push_back({center, corner(0), corner(1), corner(2)});
      continue;
    }
    const Point middle = mean({corner(0), corner(1), corner(2), corner(3)});
    for (int i = 0; i < 4; ++i) result.push_back({center, corner(i), corner(i + 1), middle});
  }
  return result;
}

// --- measures of the part of a simplex inside a shape ---

/// What volume a simplex stands for: its own, or that of the ring it sweeps around the x axis over 2 pi.
template <int D>
struct Volume {
  bool of_rings = false;
  double at(const Point& x) const { return of_rings ? x.y : 1; }
  double operator()(const Simplex<D>& s) const {
    if constexpr (D == 2)
      if (of_rings) return measure(s) * (s[0].y + s[1].y + s[2].y) / 3;
    return measure(s);
  }
};

/// The integral of f over a straight cut, exact for quadratic f (Simpson; edge midpoints of triangles).
template <class Function>
double integral_over_cut(const std::vector<Point>& corners, const Function& f) {
  if (corners.size() == 2) {
    return length_of(corners[1] - corners[0]) / 6 *
           (f(corners[0]) + 4 * f(0.5 * (corners[0] + corners[1])) + f(corners[1]));
  }
  double sum = 0;
  for (std::size_t i = 2; i < corners.size(); ++i) {
    const Point &a = corners[0], &b = corners[i - 1], &c = corners[i];
    const double area = 0.5 * length_of(cross(b - a, c - a));
    sum += area / 3 * (f(0.5 * (a + b)) + f(0.5 * (b + c)) + f(0.5 * (c + a)));
  }
  return sum;
}

/// A body 1/300 as thick as a cell is still resolved; around a wire much thinner a cell would fall into millions of
/// parts, and what a radius of 1e-30 asks for is below the last digit of coordinates.
constexpr int most_bisections = 40;

/// Cut by the linear interpolant, then moved by the distance that remains between that cut and the surface: an error of
/// fourth order in size / radius, 2e-7 of the body's volume at the largest size that is not bisected.
template <int D>
double measure_inside(const Simplex<D>& s, const Round& round, const Volume<D>& volume,
                      int bisections = most_bisections) {
  const double size = longest_edge<D>(s), whole = volume(s);
  if (const double d = round(s[0]); std::abs(d) > size) return d > 0 ? whole : 0;
  if (size > 0.08 * round.radius && bisections > 0) {
    const auto [first, second] = bisect_longest_edge<D>(s);
    return measure_inside<D>(first, round, volume, bisections - 1) +
           measure_inside<D>(second, round, volume, bisections - 1);
  }
  const Cut<D> cut = cut_linear<D>(s, round);
  double inside = 0;
  for (const Simplex<D>& part : cut.inside) inside += volume(part);
  if (cut.surface.empty()) return inside;
  const double rest = integral_over_cut(cut.surface, [&](const Point& x) { return round(x) * volume.at(x); });
  return inside + std::copysign(rest, whole);
}

template <int D>
double measure_inside(const Simplex<D>& s, const Inside& shape, int bisections, const Volume<D>& volume) {
  const auto inside = [&](const Point& x) { return shape.condition(x) != 0; };
  if (bisections > 0) {
    const auto [first, second] = bisect_longest_edge<D>(s);
    return measure_inside<D>(first, shape, bisections - 1, volume) +
           measure_inside<D>(second, shape, bisections - 1, volume);
  }
  std::array<bool, D + 1> is_inside{};
  for (int i = 0; i <= D; ++i) is_inside[i] = inside(s[i]);
  const auto crossing = [&](int i, int o) {
    Point in = s[i], out = s[o];
    for (int halving = 0; halving < 16; ++halving) {
      const Point middle = 0.5 * (in + out);
      (inside(middle) ? in : out) = middle;
    }
    return 0.5 * (in + out);
  };
  double sum = 0;
  for (const Simplex<D>& part : cut_simplex<D>(s, is_inside, crossing).inside) sum += volume(part);
  return sum;
}

/// What is left of the simplices after cutting away all that is outside a plane.
template <int D>
std::vector<Simplex<D>> clip(const std::vector<Simplex<D>>& from, const Plane& plane) {
  std::vector<Simplex<D>> left;
  for (const Simplex<D>& s : from) {
    const Cut<D> cut = cut_linear<D>(s, plane);
    left.insert(left.end(), cut.inside.begin(), cut.inside.end());
  }
  return left;
}

// --- shapes ---

/// A convex body: inside all planes and, where there is one, the round surface.
struct Body {
  std::vector<Plane> planes;
  std::optional<Round> round;
};

Body body_of(const HalfSpace& s, int) { return {{plane_through(s.point, s.normal)}, {}}; }

Body body_of(const Box& s, int dimension) {
  Body body;
  constexpr std::array<Point, 3> axes{Point{1, 0, 0}, Point{0, 1, 0}, Point{0, 0, 1}};
  for (int i = 0; i < dimension; ++i) {
    body.planes.push_back(plane_through(s.low, axes[i]));
    body.planes.push_back(plane_through(s.high, -1.0 * axes[i]));
  }
  return body;
}

Body body_of(const Sphere& s, int dimension) {
  const Point center = dimension == 2 ? Point{s.center.x, s.center.y, 0} : s.center;
  return {{}, Round{center, {}, s.radius}};
}

Body body_of(const Cylinder& s, int) {
  const Plane base = plane_through(s.from, s.to - s.from);
  return {{base, plane_through(s.to, s.from - s.to)}, Round{s.from, base.normal, s.radius}};
}

struct Ball {
  Point center;
  double radius;
};

Ball bounding_ball(const std::vector<Point>& corners) {
  const Point center = mean(corners);
  double square_of_radius = 0;
  for (const Point& p : corners) square_of_radius = std::max(square_of_radius, dot(p - center, p - center));
  return {center, std::sqrt(square_of_radius)};
}

template <int D>
double fraction(const std::vector<Simplex<D>>& cell, const Volume<D>& volume,
                const std::function<double(const Simplex<D>&)>& measure_of_part) {
  double whole = 0, part = 0;
  for (const Simplex<D>& s : cell) {
    whole += volume(s);
    part += measure_of_part(s);
  }
  const double f = part / whole;
  if (f < 1e-12) return 0;
  return f > 1 - 1e-12 ? 1 : f;
}

template <int D>
double fraction_in_body(const Body& body, CellType type, const std::vector<Point>& corners, const Volume<D>& volume) {
  const Ball ball = bounding_ball(corners);
  bool whole = true;
  const auto test = [&](double distance) {
    whole = whole && distance > ball.radius;
    return distance < -ball.radius;
  };
  for (const Plane& plane : body.planes) {
    if (test(plane(ball.center))) return 0;
  }
  if (body.round && test((*body.round)(ball.center))) return 0;
  if (whole) return 1;

  return fraction<D>(simplices<D>(type, corners), volume, [&](const Simplex<D>& s) {
    std::vector<Simplex<D>> parts{s};
    for (const Plane& plane : body.planes) parts = clip<D>(parts, plane);
    double sum = 0;
    for (const Simplex<D>& part : parts)
      sum += body.round ? measure_inside<D>(part, *body.round, volume) : volume(part);
    return sum;
  });
}

template <int D>
double fraction_in_condition(const Inside& shape, CellType type, const std::vector<Point>& corners,
                             const Volume<D>& volume) {
  const bool inside = shape.condition(corners[0]) != 0;
  bool uniform = true;
  for (std::size_t i = 0; uniform && i < corners.size(); ++i) {
    for (std::size_t j = i; uniform && j < corners.size(); ++j) {
      uniform = (shape.condition(0.5 * (corners[i] + corners[j])) != 0) == inside;
    }
  }
  if (uniform) return inside ? 1 : 0;

  // A size of about an eighth of the cell's edge.
  const int bisections = D == 2 ? 6 : type == CellType::tetrahedron ? 9 : 6;
  return fraction<D>(simplices<D>(type, corners), volume,
                     [&](const Simplex<D>& s) { return measure_inside<D>(s, shape, bisections, volume); });
}

template <int D>
double inside_fraction_in(const Shape& shape, const Mesh& mesh, std::int32_t cell) {
  std::vector<Point> corners;
  for (auto n = mesh.cell_node_begin[cell]; n < mesh.cell_node_begin[cell + 1]; ++n) {
    corners.push_back(mesh.nodes[mesh.cell_nodes[n]]);
  }
  const CellType type = mesh.cell_type[cell];
  const Volume<D> volume{mesh.axisymmetric};
  return std::visit(
      [&](const auto& s) -> double {
        using S = std::decay_t<decltype(s)>;
        if constexpr (std::is_same_v<S, Everywhere>) {
          return 1;
        } else if constexpr (std::is_same_v<S, PhysicalGroup>) {
          const auto region = mesh.cell_region[cell];
          return region >= 0 && mesh.region_names[region] == s.name ? 1 : 0;
        } else if constexpr (std::is_same_v<S, Inside>) {
          return fraction_in_condition<D>(s, type, corners, volume);
        } else {
          return fraction_in_body<D>(body_of(s, D), type, corners, volume);
        }
      },
      shape);
}

}  // namespace

double inside_fraction(const Shape& shape, const Mesh& mesh, std::int32_t cell) {
  return mesh.dimension == 2 ? inside_fraction_in<2>(shape, mesh, cell) : inside_fraction_in<3>(shape, mesh, cell);
}

}  // namespace cobasis
