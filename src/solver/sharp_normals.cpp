// How the planes of sharp interfaces are turned: fitted to the planes around.
#include <algorithm>
#include <cmath>

#include "mesh/geometry.hpp"
#include "solver/sharp_interface.hpp"

namespace cobasis {
namespace {

Point normalised(const Point& a) { return (1 / length(a)) * a; }

}  // namespace

/// Outward normal of phase k by Gauss' theorem: rough, but there is none yet.
Point SharpInterface::gradient(const Faces& faces, const Fields& fields, int k, std::int32_t cell) const {
  const Point steps = steps_around(faces, fields, k, cell).vector;
  return length(steps) > 0 ? normalised(steps) : Point{1, 0, 0};
}

SharpInterface::Steps SharpInterface::steps_around(const Faces& faces, const Fields& fields, int k,
                                                   std::int32_t cell) const {
  const auto& alpha = fields.phases[k].alpha;
  Steps sum;
  for_each_face(cell, [&](std::int32_t f, int side) {
    const double out = side == 0 ? 1 : -1;
    const bool open = f < mesh_.first_boundary_face();
    const double beyond = alpha[open ? (side == 0 ? mesh_.right[f] : mesh_.left[f]) : cell];
    sum.vector =
        sum.vector - (out * faces.area[f] * (alpha[cell] + beyond)) * Point{faces.nx[f], faces.ny[f], faces.nz[f]};
    sum.size += faces.area[f] * std::fabs(alpha[cell] - beyond);
  });
  return sum;
}

/// Whether the volume fractions around a cell say where a phase lies in it. Where large steps on opposite sides cancel,
/// as in a layer that is as thin as the cell, no single plane does.
bool SharpInterface::has_direction(const Faces& faces, const Fields& fields, std::int32_t cell) const {
  constexpr double large = 0.1;  // of the cell's surface: corners of simplices leave small steps on all sides
  double surface = 0;
  for_each_face(cell, [&](std::int32_t f, int) { surface += faces.area[f]; });
  return std::ranges::none_of(planes_of_, [&](int k) {
    const Steps steps = steps_around(faces, fields, k, cell);
    return steps.size > large * surface && steps.cancel();
  });
}

/// Mean over the cell and its neighbours: rids rough normals of outliers.
Point SharpInterface::mean_normal(int k, std::int32_t cell) const {
  Point sum = cells_[k][cell].plane.n;
  for_each_face(cell, [&](std::int32_t face, int side) {
    if (face >= mesh_.first_boundary_face()) return;
    const std::int32_t other = side == 0 ? mesh_.right[face] : mesh_.left[face];
    if (valid(k, other) && std::abs(cells_[k][other].ring) == 1) sum = sum + cells_[k][other].plane.n;
  });
  return length(sum) > 0 ? normalised(sum) : cells_[k][cell].plane.n;
}

/// How many faces away the planes lie to which a normal is fitted: simplices that share a face with a cut one are often
/// not cut themselves, or but scratched, and too few to tell how the interface lies.
int SharpInterface::hops_of(CellType type) {
  switch (type) {
    case CellType::quadrilateral:
    case CellType::hexahedron:
      return 1;
    case CellType::tetrahedron:
      return 3;
    default:
      return 2;
  }
}

/// Of what lies beyond a plane of symmetry with unit normal m, about the mirror image of the centroid.
SharpInterface::Moments SharpInterface::Moments::mirrored(const Point& m) const {
  const auto image = [&](const Point& a) { return a - 2 * dot(a, m) * m; };
  const Point x = image({1, 0, 0}), y = image({0, 1, 0}), z = image({0, 0, 1});
  const auto of = [&](const Point& a, const Point& b) {
    return a.x * (xx * b.x + xy * b.y + xz * b.z) + a.y * (xy * b.x + yy * b.y + yz * b.z) +
           a.z * (xz * b.x + yz * b.y + zz * b.z);
  };
  return {w, image(r), image(n), of(x, x), of(x, y), of(x, z), of(y, y), of(y, z), of(z, z)};
}

void SharpInterface::Moments::add(const Moments& other, const Point& d) {
  const Point &o = other.r, s = o + other.w * d;
  w += other.w;
  r = r + s;
  n = n + other.n;
  xx += other.xx + o.x * d.x + s.x * d.x, yy += other.yy + o.y * d.y + s.y * d.y,
      zz += other.zz + o.z * d.z + s.z * d.z;
  xy += other.xy + o.x * d.y + s.y * d.x, xz += other.xz + o.x * d.z + s.z * d.x,
      yz += other.yz + o.y * d.z + s.z * d.y;
}

SharpInterface::Moments SharpInterface::own_moments(const Fields& fields, int k, std::int32_t cell) const {
  Moments own;
  const Cell& c = cells_[k][cell];
  if (!is_cut(fields, k, cell) || !valid(k, cell) || std::abs(c.ring) != 1) return own;
  own.w = c.cut.area * c.cut.area;  // where a plane only scratches a cell its place is uncertain
  own.n = own.w * c.plane.n;
  Moments moments;
  moments.add(own, c.cut.centroid);
  return moments;
}

/// Makes room.
SharpInterface::Moments& SharpInterface::moments_for(std::int32_t cell) {
  if (moments_at_[cell] < 0) {
    moments_at_[cell] = static_cast<std::int32_t>(moments_.size());
    moments_.emplace_back();
  }
  return moments_[moments_at_[cell]];
}

/// Moments of the cut cells within `hops_` faces, each as often as there are ways to it. A cell passes on what it
/// knows of, except of interfaces that look the other way: those of the far side of a film.
void SharpInterface::gather_moments(const Fields& fields, int k) {
  moment_cells_.clear();
  moments_.clear();
  moments_at_.assign(mesh_.n_cells(), -1);
  const auto visit_neighbours = [&](std::int32_t cell, const auto& visit) {
    for_each_face(cell, [&](std::int32_t face, int side) {
      if (face < mesh_.first_boundary_face())
        visit(side == 0 ? mesh_.right[face] : mesh_.left[face], (side == 0 ? 1.0 : -1.0) * mesh_.face_delta[face]);
    });
  };
  const auto enlist = [&](std::int32_t cell) {
    if (cell < mesh_.n_owned) moment_cells_.push_back(cell);
  };
  const auto enlist_around = [&](std::int32_t cell) {
    if (!is_cut(fields, k, cell)) return;
    enlist(cell);
    if (hops_ > 1) visit_neighbours(cell, [&](std::int32_t other, const Point&) { enlist(other); });
  };
  for (const auto* cells : {&cut_cells_, &mixed_cells_})
    for (const std::int32_t cell : *cells) enlist_around(cell);
  for (std::int32_t cell = mesh_.n_owned; cell < mesh_.n_cells(); ++cell) enlist_around(cell);
  std::ranges::sort(moment_cells_);
  moment_cells_.erase(std::unique(moment_cells_.begin(), moment_cells_.end()), moment_cells_.end());
  const auto begin = [&](std::int32_t cell) { moments_for(cell) = own_moments(fields, k, cell); };
  for (const std::int32_t cell : moment_cells_) {
    begin(cell);
    visit_neighbours(cell, [&](std::int32_t other, const Point&) { begin(other); });
  }
  for (int hop = 1; hop <= hops_; ++hop) {
    if (hop > 1) exchange_moments();
    next_moments_.clear();
    for (const std::int32_t cell : moment_cells_) {
      Moments sum = moments_of(cell);
      const bool cut = is_cut(fields, k, cell);
      if (!cut || hop <= hops_of(mesh_.cell_type[cell])) {
        Point towards = sum.n;
        if (!cut)
          visit_neighbours(cell, [&](std::int32_t other, const Point&) { towards = towards + moments_of(other).n; });
        const auto gather = [&](const Moments& there, const Point& delta) {
          if (dot(towards, there.n) > 0) sum.add(there, delta);
        };
        const Moments own = sum;
        visit_neighbours(cell, [&](std::int32_t other, const Point& delta) { gather(moments_of(other), delta); });
        for_each_face(cell, [&](std::int32_t face, int side) {
          if (!is_symmetry(face)) return;
          const Point m{mesh_.nx[face], mesh_.ny[face], mesh_.nz[face]};
          gather(own.mirrored(m), 2 * dot(outlines_.center(face, side), m) * m);
        });
      }
      next_moments_.push_back(sum);
    }
    for (std::size_t i = 0; i < moment_cells_.size(); ++i) moments_for(moment_cells_[i]) = next_moments_[i];
  }
}

/// The normal turned to the plane that fits the sections of the planes around best, each of which lies on the interface
/// even where its normal is rough. Exact for planes.
Point SharpInterface::fitted_normal(int k, std::int32_t cell) const {
  const Moments m = moments_of(cell);
  const Point n = cells_[k][cell].plane.n;
  if (!(m.w > 0)) return n;
  Point t1{-n.y, n.x, 0}, t2{0, 0, 0};
  if (mesh_.dimension == 3) {
    t1 = std::fabs(n.x) > 0.6 ? normalised(Point{n.z, 0, -n.x}) : normalised(Point{0, -n.z, n.y});
    t2 = cross(n, t1);
  }
  const Point r = (1 / m.w) * m.r;
  const auto product = [&](const Point& a, const Point& b) {
    return a.x * (m.xx * b.x + m.xy * b.y + m.xz * b.z) + a.y * (m.xy * b.x + m.yy * b.y + m.yz * b.z) +
           a.z * (m.xz * b.x + m.yz * b.y + m.zz * b.z) - m.w * dot(a, r) * dot(b, r);
  };
  double a = product(t1, t1), c = product(t2, t2);
  const double b = product(t1, t2), f = product(t1, n), g = product(t2, n), all = a + c + product(n, n);
  if (!(all > 1e-10 * (m.xx + m.yy + m.zz))) return n;  // nothing but the cell itself
  a += 1e-6 * all, c += 1e-6 * all;                     // what the neighbours leave open stays
  const double det = a * c - b * b;
  double p = -(c * f - b * g) / det, q = -(a * g - b * f) / det;
  if (const double tilt = std::hypot(p, q); tilt > 0.5) p *= 0.5 / tilt, q *= 0.5 / tilt;
  return normalised(n + p * t1 + q * t2);
}

/// Halo cells learn what their owners have gathered so far.
void SharpInterface::exchange_moments() {
  exchange_cells(exchange_, mesh_.neighbours, [&](std::int32_t cell, const auto& with) {
    bool known = moments_of(cell).w > 0;
    with(known);
    if (!known && (cell < mesh_.n_owned || moments_at_[cell] < 0)) return;
    Moments& m = moments_for(cell);
    if (!known)
      m = {};
    else
      for (double* number :
           {&m.w, &m.r.x, &m.r.y, &m.r.z, &m.n.x, &m.n.y, &m.n.z, &m.xx, &m.xy, &m.xz, &m.yy, &m.yz, &m.zz})
        with(*number);
  });
}

}  // namespace cobasis
