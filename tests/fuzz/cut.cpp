// Shapes and planes that cut cells.
#include <array>
#include <cmath>

#include "fuzz.hpp"
#include "mesh/cell_shape.hpp"
#include "mesh/geometry.hpp"
#include "solver/cut_cell.hpp"
#include "solver/plane_cut.hpp"

using namespace cobasis;

namespace {

/// A mesh of one cell, moved about; not every one is a cell that build_global_mesh would let pass.
Mesh one_cell(Numbers& numbers) {
  const int type = numbers.below(6);
  const CellShape& shape = cell_shapes[type];
  constexpr std::array<Point, 8> square{
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
  constexpr std::array<Point, 6> prism{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}};
  constexpr std::array<Point, 4> simplex{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Mesh mesh;
  mesh.dimension = shape.dimension;
  mesh.n_owned = 1;
  mesh.n_global = 1;
  mesh.cell_type = {static_cast<CellType>(type)};
  mesh.cell_region = {-1};
  mesh.cell_node_begin = {0, shape.n_corners};
  const double scale = std::ldexp(1.0, numbers.below(41) - 20);
  const Point shift{numbers.coordinate(), numbers.coordinate(), mesh.dimension == 3 ? numbers.coordinate() : 0.0};
  for (int c = 0; c < shape.n_corners; ++c) {
    Point p = mesh.cell_type[0] == CellType::prism                                  ? prism[c]
              : shape.n_corners < 5 && mesh.cell_type[0] != CellType::quadrilateral ? simplex[c]
                                                                                    : square[c];
    p = p + (1.0 / 256) * Point{double(numbers.take<std::int8_t>()), double(numbers.take<std::int8_t>()),
                                mesh.dimension == 3 ? double(numbers.take<std::int8_t>()) : 0.0};
    mesh.nodes.push_back(scale * p + shift);
    mesh.cell_nodes.push_back(c);
  }
  const CellGeometry geometry = cell_geometry(mesh.cell_type[0], mesh.nodes);
  mesh.volume = {geometry.volume};
  mesh.centroid = {geometry.centroid};
  return mesh;
}

/// Round bodies are thick, or so small that they are next to nothing: what lies between takes a cell apart into
/// thousands of pieces, which is right, and slow.
Shape shape_of_bytes(Numbers& numbers, double cell_size) {
  const auto point = [&] { return Point{numbers.coordinate(), numbers.coordinate(), numbers.coordinate()}; };
  const auto radius = [&] { return cell_size * std::ldexp(1.0, 2 + numbers.below(20)); };
  switch (numbers.below(8)) {
    case 0:
      return Sphere{point(), radius()};
    case 1:
      return Cylinder{point(), point(), radius()};
    case 2:
      return Sphere{point(), 1e-12 * cell_size / (1 + numbers.below(200))};
    case 3:
    case 4:
      return Box{point(), point()};
    default:
      return HalfSpace{point(), point()};
  }
}

bool is_fine(double x) { return std::isfinite(x) && std::abs(x) < 1e100; }

/// What the case reader lets pass, at lengths that squares of do not overflow.
bool is_allowed(const Shape& shape) {
  const auto fine = [](const Point& p) { return is_fine(p.x) && is_fine(p.y) && is_fine(p.z); };
  if (const auto* half = std::get_if<HalfSpace>(&shape))
    return fine(half->point) && fine(half->normal) && length(half->normal) > 1e-100;
  if (const auto* box = std::get_if<Box>(&shape))
    return fine(box->low) && fine(box->high) && box->low.x < box->high.x && box->low.y < box->high.y &&
           box->low.z < box->high.z;
  if (const auto* sphere = std::get_if<Sphere>(&shape))
    return fine(sphere->center) && is_fine(sphere->radius) && sphere->radius > 0;
  const auto& cylinder = std::get<Cylinder>(shape);
  return fine(cylinder.from) && fine(cylinder.to) && is_fine(cylinder.radius) && cylinder.radius > 0 &&
         length(cylinder.to - cylinder.from) > 1e-100;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Numbers numbers(data, size);
  const Mesh mesh = one_cell(numbers);
  if (!(mesh.volume[0] > 1e-10 * std::pow(length(mesh.nodes[1] - mesh.nodes[0]), mesh.dimension))) return 0;
  if (!is_fine(mesh.centroid[0].x) || !is_fine(mesh.centroid[0].y) || !is_fine(mesh.centroid[0].z)) return 0;
  const CellCorners corners = corners_of(mesh, 0);
  Point n{numbers.coordinate(), numbers.coordinate(), mesh.dimension == 3 ? numbers.coordinate() : 0.0};
  if (is_fine(n.x) && is_fine(n.y) && is_fine(n.z) && length(n) > 1e-100) {
    n = 1 / length(n) * n;
    const double fraction = numbers.take<std::uint16_t>() / 65535.0, d = place_plane(corners, n, fraction);
    const double below = volume_below(corners, {n, d});
    claim(below >= 0 && below <= 1);
    claim(section(corners, {n, d}).area >= 0);
  }
  const Shape shape = shape_of_bytes(numbers, length(mesh.nodes[1] - mesh.nodes[0]));
  if (!is_allowed(shape) || (std::holds_alternative<Cylinder>(shape) && mesh.dimension == 2)) return 0;
  const double inside = inside_fraction(shape, mesh, 0);
  claim(inside >= 0 && inside <= 1);
  return 0;
}
