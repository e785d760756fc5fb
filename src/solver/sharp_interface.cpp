#include "solver/sharp_interface.hpp"
#include "solver/interfaces.hpp"

#include <algorithm>
#include <cmath>
#include <ranges>

namespace cobasis {
namespace {

constexpr int first_means = 4, first_fits = 30,
              fits_per_step = 2;  ///< passes over the normals: they converge quadratically
constexpr int rings = 3;          ///< of cells around the cut ones that know the plane nearby

double length(const Point& a) { return std::sqrt(dot(a, a)); }
Point normalised(const Point& a) { return (1 / length(a)) * a; }

std::vector<std::size_t> capacities(const Mesh& mesh, std::size_t per_cell) {
  std::vector<std::size_t> values;
  for (const Neighbour& n : mesh.neighbours) values.push_back(per_cell * n.receive_count);
  return values;
}

std::size_t numbers_per_cell(const Fields& fields) {
  std::size_t states = 0;
  for (const Phase& phase : fields.phases) states += phase.conserved.size() + phase.primitive.size();
  return fields.phases.size() * (10 + states);
}

}  // namespace

SharpInterface::SharpInterface(const Mpi& mpi, const Mesh& mesh, const Faces& faces, Fields& fields, const Setup& setup,
                               const std::vector<PhaseKernels>& kernels, const std::vector<PairKernels>& pairs,
                               const std::vector<Boundary>& boundaries)
    : mesh_(mesh),
      outlines_(mesh),
      kernels_(kernels),
      pairs_(pairs),
      cells_(fields.n_phases()),
      corners_at_(mesh.n_owned, -1),
      face_radius_(mesh.n_faces()),
      is_transmissive_(mesh.n_boundary_faces),
      exchange_(mpi, mesh.neighbours, capacities(mesh, numbers_per_cell(fields)), 16),
      shares_planes_(setup.scheme.interface == InterfaceTreatment::sharp) {
  const int n = fields.n_phases();
  for (int k = 0; k < n; ++k)
    if (fields.phases[k].is_void || (n == 2 && k == 1 && rest_ < 0 && !fields.phases[0].is_void)) rest_ = k;
  for (int k = 0; k < n; ++k) {
    if (k != rest_) planes_of_.push_back(k), cells_[k].resize(mesh.n_cells());
    Phase& phase = fields.phases[k];
    for (auto& side : phase.wetted) side.assign(faces.area.size(), 0);
    health_.emplace_back(mesh.n_cells(), 0);
    followed_.emplace_back(mesh.n_cells(), -1);
    if (phase.is_void) continue;
    phase.inner = CellNumbers(mesh.n_owned + pack_width, kernels[k].n_inner);
    std::fill_n(phase.inner.component(0), phase.inner.stride * kernels[k].n_inner, 0.0);
  }
  fields.near.assign(faces.area.size(), 0);
  contacts_.resize(n * n);
  speed_users_.resize(n * n);
  for (int l = 0; l < n; ++l)
    for (int m = 0; m < n; ++m)
      if (l != m) contacts_[l * n + m] = ContactList(2 * mesh.n_cells());

  std::vector<std::vector<std::int32_t>> of_halo(mesh.n_halo);
  for (std::int32_t f = mesh.n_interior_faces; f < mesh.first_boundary_face(); ++f) {
    if (mesh.left[f] >= mesh.n_owned) of_halo[mesh.left[f] - mesh.n_owned].push_back(2 * f);
    if (mesh.right[f] >= mesh.n_owned) of_halo[mesh.right[f] - mesh.n_owned].push_back(2 * f + 1);
  }
  halo_face_begin_.push_back(0);
  for (const auto& list : of_halo) {
    halo_faces_.insert(halo_faces_.end(), list.begin(), list.end());
    halo_face_begin_.push_back(static_cast<std::int32_t>(halo_faces_.size()));
  }
  for (std::int32_t f = 0; f < mesh.n_faces(); ++f) {
    const FaceOutline outline = outlines_[f];
    for (int i = 0; i < outline.size; ++i) face_radius_[f] = std::max(face_radius_[f], length(outline.corner[i]));
  }
  for (std::size_t i = 0; i < boundaries.size(); ++i)
    for (std::int32_t f = mesh.boundary_groups[i].first; f < mesh.boundary_groups[i].last; ++f)
      is_transmissive_[f - mesh.first_boundary_face()] = !std::holds_alternative<Inflow>(boundaries[i]);
}

template <class Visit>
void SharpInterface::for_each_face(std::int32_t cell, const Visit& visit) const {
  if (cell < mesh_.n_owned) {
    for (int j = 0; j < mesh_.max_cell_faces; ++j) {
      const std::int32_t entry = mesh_.cell_faces[static_cast<std::size_t>(j) * mesh_.cell_stride + cell];
      if (entry >= 0) visit(entry >> 1, entry & 1);
    }
  } else {
    for (std::int32_t i = halo_face_begin_[cell - mesh_.n_owned]; i < halo_face_begin_[cell - mesh_.n_owned + 1]; ++i)
      visit(halo_faces_[i] >> 1, halo_faces_[i] & 1);
  }
}

/// How near a cell is, over cells with the phase, to one that is half full of it; 0: farther than `reach` cells. What
/// has nobody to share its state with is a film or a splinter thinner than a cell: a plane there would let waves cross
/// it faster than the step can follow.
void SharpInterface::find_health(Fields& fields) {
  constexpr int reach = 3;
  for (int k = 0; k < fields.n_phases(); ++k) {
    const auto& alpha = fields.phases[k].alpha;
    for (std::int32_t cell = 0; cell < mesh_.n_cells(); ++cell)
      health_[k][cell] = fields.phases[k].is_void || !(alpha[cell] > 0) || alpha[cell] >= 0.5 ? reach + 1 : 0;
  }
  for (int distance = 1; distance <= reach; ++distance) {
    for (int k = 0; k < fields.n_phases(); ++k) {
      const auto& alpha = fields.phases[k].alpha;
      for (const std::int32_t cell : cut_cells_) {
        if (health_[k][cell] > 0) continue;
        for_each_face(cell, [&](std::int32_t f, int side) {
          if (f >= mesh_.first_boundary_face()) return;
          const std::int32_t other = side == 0 ? mesh_.right[f] : mesh_.left[f];
          if (alpha[other] > 0 && health_[k][other] == reach + 2 - distance)
            health_[k][cell] = static_cast<std::int8_t>(reach + 1 - distance);
        });
      }
    }
    exchange(fields);
  }
}

/// Whether the cell tells its neighbours of the planes of its interfaces.
bool SharpInterface::has_planes(const Fields& fields, std::int32_t cell) const {
  if (!shares_planes_) return false;
  for (int k = 0; k < fields.n_phases(); ++k)
    if (health_[k][cell] == 0) return false;
  return true;
}

bool SharpInterface::is_cut(const Fields& fields, int k, std::int32_t cell) const {
  const double alpha = fields.phases[k].alpha[cell];
  return alpha > 0 && alpha < 1;
}

/// Outward normal of phase k by Gauss' theorem: rough, but there is none yet.
Point SharpInterface::gradient(const Faces& faces, const Fields& fields, int k, std::int32_t cell) const {
  const auto& alpha = fields.phases[k].alpha;
  Point sum{0, 0, 0};
  for_each_face(cell, [&](std::int32_t f, int side) {
    const double out = side == 0 ? 1 : -1;
    const bool open = f < mesh_.first_boundary_face();
    const double beyond = alpha[open ? (side == 0 ? mesh_.right[f] : mesh_.left[f]) : cell];
    sum = sum - (out * faces.area[f] * (alpha[cell] + beyond)) * Point{faces.nx[f], faces.ny[f], faces.nz[f]};
  });
  return length(sum) > 0 ? normalised(sum) : Point{1, 0, 0};
}

void SharpInterface::put_plane(const Fields& fields, int k, std::int32_t cell, const Point& n) {
  if (corners_at_[cell] < 0) {
    corners_at_[cell] = static_cast<std::int32_t>(corners_.size());
    corners_.push_back(corners_of(mesh_, cell));
  }
  const CellCorners& corners = corners_[corners_at_[cell]];
  Cell& c = cells_[k][cell];
  c.plane = {n, place_plane(corners, n, fields.phases[k].alpha[cell])};
  c.cut = section(corners, c.plane);
  c.ring = 1;
  c.step = step_;
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

/// The normal turned so that the plane goes through the middles of the neighbours' planes as well as it can. Exact for
/// planes.
Point SharpInterface::fitted_normal(int k, std::int32_t cell) const {
  const Cell& own = cells_[k][cell];
  const Point n = own.plane.n;
  Point t1{-n.y, n.x, 0}, t2{0, 0, 0};
  if (mesh_.dimension == 3) {
    t1 = std::fabs(n.x) > 0.6 ? normalised(Point{n.z, 0, -n.x}) : normalised(Point{0, -n.z, n.y});
    t2 = cross(n, t1);
  }
  double a = 0, b = 0, c = 0, f = 0, g = 0, all = 0;
  for_each_face(cell, [&](std::int32_t face, int side) {
    if (face >= mesh_.first_boundary_face()) return;
    const std::int32_t other = side == 0 ? mesh_.right[face] : mesh_.left[face];
    const Cell& there = cells_[k][other];
    if (!valid(k, other) || std::abs(there.ring) != 1 || dot(there.plane.n, n) < 0 || there.cut.area == 0) return;
    const Point delta = (side == 0 ? 1.0 : -1.0) * mesh_.face_delta[face];
    const Point r = delta + there.cut.centroid - own.cut.centroid;
    // where a plane only scratches a cell its place is uncertain
    const double x = dot(t1, r), y = dot(t2, r), z = dot(n, r), w = there.cut.area * there.cut.area;
    all += w * dot(r, r);
    a += w * x * x, b += w * x * y, c += w * y * y, f += w * x * z, g += w * y * z;
  });
  if (all == 0) return n;
  a += 1e-6 * all, c += 1e-6 * all;  // what the neighbours leave open stays
  const double det = a * c - b * b;
  double p = -(c * f - b * g) / det, q = -(a * g - b * f) / det;
  if (const double tilt = std::hypot(p, q); tilt > 0.5) p *= 0.5 / tilt, q *= 0.5 / tilt;
  return normalised(n + p * t1 + q * t2);
}

void SharpInterface::exchange_blends() {
  if (mesh_.neighbours.empty()) return;
  const auto for_each = [&](const auto& cells, const auto& visit) {
    for (const std::int32_t cell : cells)
      for (const int k : planes_of_)
        if (valid(k, cell) && cells_[k][cell].ring == -1) visit(cells_[k][cell].blend);
  };
  for (std::size_t i = 0; i < mesh_.neighbours.size(); ++i) {
    std::vector<double>& out = exchange_.outgoing(i);
    out.clear();
    for_each(mesh_.neighbours[i].send, [&](double blend) { out.push_back(blend); });
  }
  exchange_.start();
  exchange_.finish();
  for (std::size_t i = 0; i < mesh_.neighbours.size(); ++i) {
    const double* in = exchange_.incoming(i).data();
    const Neighbour& neighbour = mesh_.neighbours[i];
    for_each(std::views::iota(neighbour.receive_first, neighbour.receive_first + neighbour.receive_count),
             [&](double& blend) { blend = *in++; });
  }
}

bool SharpInterface::knows_plane(std::int32_t cell) const {
  return std::ranges::any_of(planes_of_, [&](int k) { return valid(k, cell) && cells_[k][cell].ring > 0; });
}

/// Whether the cell's arrays hold a state of the phase: its own, or the one with which it would arrive.
bool SharpInterface::has_state(const Fields& fields, int k, std::int32_t cell) const {
  return fields.phases[k].alpha[cell] > 0 || (knows_plane(cell) && fields.pure[cell] >= 0);
}

/// Whether the state of a phase that the cell's arrays hold is another cell's.
bool SharpInterface::borrows(const Fields& fields, int k, std::int32_t cell) const {
  return !fields.phases[k].is_void && (!(fields.phases[k].alpha[cell] > 0) || followed_[k][cell] == step_);
}

void SharpInterface::borrow(Fields& fields, int k, std::int32_t cell, std::int32_t from) const {
  Phase& phase = fields.phases[k];
  for (auto& component : phase.primitive) component[cell] = component[from];
  for (int c = fields.first_cobasis(); c < phase.n_conserved(); ++c)
    phase.conserved[c][cell] = phase.conserved[c][from];
}

/// Followers take the state of the neighbour that has most of the phase; where none has a state of its own, the one
/// with which the phase began.
void SharpInterface::follow(Fields& fields, std::span<const std::pair<std::int32_t, int>> followers) {
  following_.clear();
  for (const auto& [cell, k] : followers) {
    followed_[k][cell] = step_;
    following_.push_back(cell);
  }
  for (const auto& [cell, k] : followers) {
    if (cell >= mesh_.n_owned) continue;
    const auto& alpha = fields.phases[k].alpha;
    std::int32_t source = fields.n_all;
    for_each_face(cell, [&](std::int32_t f, int side) {
      if (f >= mesh_.first_boundary_face()) return;
      const std::int32_t other = side == 0 ? mesh_.right[f] : mesh_.left[f];
      if (!(alpha[other] > 0) || followed_[k][other] == step_) return;
      if (source == fields.n_all || alpha[other] > alpha[source] ||
          (alpha[other] == alpha[source] && mesh_.global_id[other] < mesh_.global_id[source]))
        source = other;
    });
    borrow(fields, k, cell, source);
  }
}

/// At second order sweeps look for states at the faces.
void SharpInterface::lend_to_faces(Fields& fields, int k, std::int32_t cell) const {
  Phase& phase = fields.phases[k];
  const int n_primitive = static_cast<int>(phase.primitive.size());
  for_each_face(cell, [&](std::int32_t f, int side) {
    const std::size_t to = side * phase.face_states.stride + f;
    for (int c = 0; c < n_primitive; ++c) phase.face_states.component(c)[to] = phase.primitive[c][cell];
    for (int c = fields.first_cobasis(); c < phase.n_conserved(); ++c)
      phase.face_states.component(n_primitive + c - fields.first_cobasis())[to] = phase.conserved[c][cell];
  });
}

/// The planes of cells that other ranks have as halo, and the states that absent phases have borrowed there.
void SharpInterface::exchange(Fields& fields) {
  const auto for_each_borrowed = [&](std::int32_t cell, const auto& visit) {
    const bool arriving = knows_plane(cell);
    for (int k = 0; k < fields.n_phases(); ++k) {
      Phase& phase = fields.phases[k];
      if (!borrows(fields, k, cell) || (!(phase.alpha[cell] > 0) && !arriving)) continue;
      for (auto& component : phase.primitive) visit(component[cell]);
      for (int c = fields.first_cobasis(); c < phase.n_conserved(); ++c) visit(phase.conserved[c][cell]);
    }
  };
  for (std::size_t i = 0; i < mesh_.neighbours.size(); ++i) {
    std::vector<double>& out = exchange_.outgoing(i);
    out.clear();
    for (const std::int32_t cell : mesh_.neighbours[i].send) {
      for (const auto& of_phase : health_) out.push_back(of_phase[cell]);
      for (const int k : planes_of_) {
        const Cell& c = cells_[k][cell];
        out.push_back(valid(k, cell) ? c.ring : 0);
        if (!valid(k, cell)) continue;
        for (const double value : {c.plane.n.x, c.plane.n.y, c.plane.n.z, c.plane.d, c.cut.centroid.x, c.cut.centroid.y,
                                   c.cut.centroid.z, c.cut.area, c.speed})
          out.push_back(value);
      }
    }
    for (const std::int32_t cell : mesh_.neighbours[i].send)
      for_each_borrowed(cell, [&](double value) { out.push_back(value); });
  }
  exchange_.start();
  exchange_.finish();
  for (std::size_t i = 0; i < mesh_.neighbours.size(); ++i) {
    const double* in = exchange_.incoming(i).data();
    const Neighbour& neighbour = mesh_.neighbours[i];
    for (std::int32_t cell = neighbour.receive_first; cell < neighbour.receive_first + neighbour.receive_count;
         ++cell) {
      for (auto& of_phase : health_) of_phase[cell] = static_cast<std::int8_t>(*in++);
      for (const int k : planes_of_) {
        const int ring = static_cast<int>(*in++);
        if (ring == 0) continue;
        cells_[k][cell] = {{{in[0], in[1], in[2]}, in[3]}, {in[7], {in[4], in[5], in[6]}}, in[8], 1, ring, step_};
        in += 9;
      }
    }
    for (std::int32_t cell = neighbour.receive_first; cell < neighbour.receive_first + neighbour.receive_count; ++cell)
      for_each_borrowed(cell, [&](double& value) { value = *in++; });
  }
}

void SharpInterface::place(const Faces& faces, Fields& fields,
                           std::span<const std::pair<std::int32_t, int>> followers) {
  ++step_;
  follow(fields, followers);
  cut_cells_.clear();
  mixed_cells_.clear();
  for (std::int32_t cell = 0; cell < mesh_.n_owned; ++cell)
    if (fields.pure[cell] < 0) cut_cells_.push_back(cell);
  if (shares_planes_) find_health(fields);
  std::erase_if(cut_cells_, [&](std::int32_t cell) {
    if (has_planes(fields, cell)) return false;
    mixed_cells_.push_back(cell);
    return true;
  });
  for (const int k : planes_of_)
    for (const auto* cells : {&cut_cells_, &mixed_cells_})
      for (const std::int32_t cell : *cells)
        if (is_cut(fields, k, cell)) {
          const Cell& before = cells_[k][cell];
          put_plane(fields, k, cell, before.step == step_ - 1 ? before.plane.n : gradient(faces, fields, k, cell));
          if (cells == &mixed_cells_) cells_[k][cell].ring = -1;
        }
  std::vector<Point> normals;
  const auto renew = [&](int k, const auto& normal_of) {
    normals.clear();
    for (const auto* cells : {&cut_cells_, &mixed_cells_})
      for (const std::int32_t cell : *cells)
        if (is_cut(fields, k, cell)) normals.push_back(normal_of(cell));
    std::size_t i = 0;
    for (const auto* cells : {&cut_cells_, &mixed_cells_})
      for (const std::int32_t cell : *cells)
        if (is_cut(fields, k, cell)) {
          put_plane(fields, k, cell, normals[i++]);
          if (cells == &mixed_cells_) cells_[k][cell].ring = -1;
        }
  };
  for (int pass = 0; pass < first_means && !settled_; ++pass) {
    exchange(fields);
    for (const int k : planes_of_) renew(k, [&](std::int32_t cell) { return mean_normal(k, cell); });
  }
  for (int pass = 0; pass < (settled_ ? fits_per_step : first_fits); ++pass) {
    exchange(fields);
    for (const int k : planes_of_) renew(k, [&](std::int32_t cell) { return fitted_normal(k, cell); });
  }
  settled_ = true;
  find_speeds(fields);
  exchange(fields);
  spread(fields, 2);
  seed(faces, fields);
  exchange(fields);
  for (int ring = 3; ring <= rings; ++ring) {
    spread(fields, ring);
    exchange(fields);
  }
  if (fields.phases[planes_of_[0]].face_states.stride == 0) return;
  const auto lend = [&](std::int32_t cell) {
    for (int k = 0; k < fields.n_phases(); ++k)
      if (borrows(fields, k, cell)) lend_to_faces(fields, k, cell);
  };
  for (const std::int32_t cell : frontier_) lend(cell);
  for (const std::int32_t cell : following_)
    if (cell < mesh_.n_owned) lend(cell);
  for (std::int32_t cell = mesh_.n_owned; cell < mesh_.n_cells(); ++cell)
    if (knows_plane(cell)) lend(cell);
}

/// The planes move with the contact of the phases that they divide.
void SharpInterface::find_speeds(Fields& fields) {
  const int n = fields.n_phases();
  for (int lm = 0; lm < n * n; ++lm) contacts_[lm].clear(), speed_users_[lm].clear();
  std::vector<std::int32_t> cells = cut_cells_;
  cells.insert(cells.end(), mixed_cells_.begin(), mixed_cells_.end());
  for (const int k : planes_of_)
    for (const std::int32_t cell : cells) {
      if (!is_cut(fields, k, cell)) continue;
      int other = -1;
      for (int m = 0; m < n; ++m)
        if (m != k && (other < 0 || fields.phases[m].alpha[cell] > fields.phases[other].alpha[cell])) other = m;
      contacts_[k * n + other].push(cell, cell, cell, 0, cells_[k][cell].plane.n);
      speed_users_[k * n + other].emplace_back(cell, k);
    }
  run_speeds(fields);
}

void SharpInterface::run_speeds(Fields& fields) {
  const int n = fields.n_phases();
  for (int l = 0; l < n; ++l)
    for (int m = 0; m < n; ++m) {
      ContactList& list = contacts_[l * n + m];
      const std::int32_t count = l == m ? 0 : list.cell.size();
      if (count == 0) continue;
      list.fill();
      if (fields.phases[m].is_void)
        kernels_[l].free_surface_speed(fields.phases[l], fields.phases[m].void_pressure, list, count);
      else
        pairs_[l * n + m].contact_speed(fields.phases[l], fields.phases[m], list, count);
      for (std::int32_t i = 0; i < count; ++i) {
        const auto [cell, k] = speed_users_[l * n + m][i];
        cells_[k][cell].speed = list.speed[i];
      }
    }
}

/// A cell that is not cut takes over a plane; at the beginning of the step it may at most touch the cell.
void SharpInterface::adopt(Fields& fields, int k, std::int32_t cell, std::int32_t from, const CutPlane& plane,
                           double speed, int ring) {
  Cell& c = cells_[k][cell];
  for (int phase = 0; phase < fields.n_phases(); ++phase)
    if (borrows(fields, phase, cell) && followed_[phase][cell] != step_) borrow(fields, phase, cell, from);
  c = {plane, {}, speed, 1, ring, step_};
  if (corners_at_[cell] < 0) {
    corners_at_[cell] = static_cast<std::int32_t>(corners_.size());
    corners_.push_back(corners_of(mesh_, cell));
  }
  const CellCorners& corners = corners_[corners_at_[cell]];
  const double bound = place_plane(corners, plane.n, fields.phases[k].alpha[cell]);
  c.plane.d = fields.phases[k].alpha[cell] > 0 ? std::max(c.plane.d, bound) : std::min(c.plane.d, bound);
}

/// Cells that are not cut but beside cells of the ring before take the plane that passes nearest to them.
void SharpInterface::spread(Fields& fields, int ring) {
  for (const int k : planes_of_) {
    next_.clear();
    const auto visit = [&](std::int32_t cell) {
      if (!valid(k, cell) || cells_[k][cell].ring != ring - 1) return;
      for_each_face(cell, [&](std::int32_t f, int side) {
        if (f >= mesh_.first_boundary_face()) return;
        const std::int32_t other = side == 0 ? mesh_.right[f] : mesh_.left[f];
        if (other < mesh_.n_owned && !valid(k, other) && !std::ranges::binary_search(mixed_cells_, other))
          next_.push_back(other);
      });
    };
    if (ring == 2)
      for (const std::int32_t cell : cut_cells_) visit(cell);
    else
      for (const std::int32_t cell : frontier_) visit(cell);
    for (std::int32_t cell = mesh_.n_owned; cell < mesh_.n_cells(); ++cell) visit(cell);
    std::ranges::sort(next_);
    next_.erase(std::unique(next_.begin(), next_.end()), next_.end());
    for (const std::int32_t cell : next_) {
      CutPlane best;
      double speed = 0, nearest = infinity;
      std::int32_t source = -1;
      for_each_face(cell, [&](std::int32_t f, int side) {
        if (f >= mesh_.first_boundary_face()) return;
        const std::int32_t other = side == 0 ? mesh_.right[f] : mesh_.left[f];
        if (!valid(k, other) || cells_[k][other].ring != ring - 1) return;
        const Cell& from = cells_[k][other];
        const Point delta = (side == 0 ? 1.0 : -1.0) * mesh_.face_delta[f];
        const double d = from.plane.d + dot(from.plane.n, delta);
        if (std::fabs(d) < nearest)
          nearest = std::fabs(d), best = {from.plane.n, d}, speed = from.speed, source = other;
      });
      adopt(fields, k, cell, source, best, speed, ring);
    }
    if (ring == 2) frontier_.clear();
    frontier_.insert(frontier_.end(), next_.begin(), next_.end());
  }
}

/// Where two pure cells of different phases meet and neither knows a plane, the faces between them are one: at an edge
/// their mean.
void SharpInterface::seed(const Faces& faces, Fields& fields) {
  const int n = fields.n_phases();
  for (int lm = 0; lm < n * n; ++lm) contacts_[lm].clear(), speed_users_[lm].clear();
  for (std::int32_t cell = 0; cell < mesh_.n_owned; ++cell) {
    const int own = fields.pure[cell];
    if (own < 0) continue;
    for (const int k : planes_of_) {
      if (valid(k, cell)) continue;
      Point sum{0, 0, 0};
      std::int32_t widest = -1;
      double distance = 0, area = 0, largest = 0;
      for_each_face(cell, [&](std::int32_t f, int side) {
        if (f >= mesh_.first_boundary_face()) return;
        const std::int32_t other = side == 0 ? mesh_.right[f] : mesh_.left[f];
        const int there = fields.pure[other];
        if (there < 0 || there == own || (own != k && there != k)) return;
        const double out = (side == 0 ? 1.0 : -1.0) * (own == k ? 1.0 : -1.0);  // outward from phase k
        const Point normal = out * Point{faces.nx[f], faces.ny[f], faces.nz[f]};
        sum = sum + faces.area[f] * normal;
        distance += faces.area[f] * dot(normal, outlines_.center(f, side));
        area += faces.area[f];
        if (faces.area[f] > largest) largest = faces.area[f], widest = other;
      });
      if (widest < 0 || !(length(sum) > 0)) continue;
      const Point normal = normalised(sum);
      adopt(fields, k, cell, widest, {normal, distance / area}, 0, 2);
      frontier_.push_back(cell);
      const int m = own == k ? fields.pure[widest] : own;
      contacts_[k * n + m].push(cell, own == k ? cell : widest, own == k ? widest : cell, 0, normal);
      speed_users_[k * n + m].emplace_back(cell, k);
    }
  }
  run_speeds(fields);
}

/// The fraction of a face that phase k has by the plane of the cell on one side; where that has none, all or nothing.
double SharpInterface::side_fraction(const Fields& fields, int k, std::int32_t face, int side, double dt) const {
  const std::int32_t cell = side == 0 ? mesh_.left[face] : mesh_.right[face];
  if (!valid(k, cell)) return fields.phases[k].alpha[cell];
  const Cell& c = cells_[k][cell];
  const Point center = outlines_.center(face, side);
  const double s = dot(c.plane.n, center) - c.plane.d, shift = c.speed * dt;
  const double reach = 1.0000001 * face_radius_[face];
  if (s - std::max(shift, 0.0) > reach) return 0;
  if (s - std::min(shift, 0.0) < -reach) return 1;
  return wetted_fraction(outlines_[face], center, c.plane, shift);
}

/// Waves cross a phase within a step where its share of a face exceeds its volume fraction by far. A cell that has
/// nobody to share such a state with keeps to `most_excess` times the fraction, of every phase; all its faces are
/// blended alike, so that the interface in the cell keeps its direction.
double SharpInterface::blend_of(const Fields& fields, int k, std::int32_t cell, double dt) const {
  constexpr double most_excess = 2;
  const double alpha = fields.phases[k].alpha[cell];
  double blend = 1;
  for_each_face(cell, [&](std::int32_t f, int side) {
    const double excess = side_fraction(fields, k, f, side, dt) - alpha;
    if (excess > 0) blend = std::min(blend, (most_excess - 1) * alpha / excess);
    if (excess < 0) blend = std::min(blend, (most_excess - 1) * (1 - alpha) / -excess);
  });
  return blend;
}

/// What each phase has of a face, as the cells on both sides see it. Where both know planes they agree on the mean;
/// else the phases meet at the face, as in the paper.
void SharpInterface::wet_face(const Faces& faces, Fields& fields, std::int32_t face, double dt) {
  const std::int32_t left = mesh_.left[face];
  const bool boundary = face >= mesh_.first_boundary_face();
  const bool inflow = boundary && !is_transmissive_[face - mesh_.first_boundary_face()];
  const std::int32_t right = boundary && !inflow ? left : mesh_.right[face];
  const int n = fields.n_phases();
  const auto as_the_cells_are = [&] {
    for (int side = 0; side < 2; ++side) {
      const std::int32_t cell = side == 0 ? left : right;
      const int seen_from = boundary && !inflow ? 0 : side;
      double sum = 0, planes = 0;
      for (int k = 0; k < n; ++k) {
        Phase& phase = fields.phases[k];
        double share = std::max(0.0, phase.alpha[cell]);  // what is below zero counts as absent
        if (k != rest_ && cell < mesh_.n_cells() && valid(k, cell) && cells_[k][cell].ring == -1)
          share += cells_[k][cell].blend * (side_fraction(fields, k, face, seen_from, dt) - share);
        phase.wetted[side][face] = share;
        (k == rest_ ? planes : sum) += share;
      }
      if (rest_ >= 0 && planes > 0) {
        planes = std::max(0.0, 1 - sum);
        fields.phases[rest_].wetted[side][face] = planes;
      }
      for (Phase& phase : fields.phases) phase.wetted[side][face] /= sum + planes;
    }
  };
  if (inflow || !knows_plane(left) || (!boundary && !knows_plane(right))) return as_the_cells_are();
  const auto wetted = [&](int k) -> double& { return fields.phases[k].wetted[0][face]; };
  double sum = 0;
  for (const int k : planes_of_) {
    double share = side_fraction(fields, k, face, 0, dt);
    if (!boundary) share = 0.5 * (share + side_fraction(fields, k, face, 1, dt));
    wetted(k) = share < 1e-12 ? 0 : share > 1 - 1e-12 ? 1 : share;
    sum += wetted(k);
  }
  if (rest_ >= 0) {
    const double share = 1 - sum;
    wetted(rest_) = share < 1e-12 ? 0 : share;
    sum += wetted(rest_);
  }
  // A phase cannot come out of a cell where it is absent.
  for (int k = 0; k < n; ++k) {
    const Phase& phase = fields.phases[k];
    const bool in_left = phase.alpha[left] > 0, in_right = phase.alpha[right] > 0;
    if (phase.is_void || wetted(k) == 0 || (in_left && in_right)) continue;
    if (in_left == in_right && has_state(fields, k, left) && has_state(fields, k, right)) continue;
    const std::int32_t present = in_left ? left : right;
    double un = phase.primitive[1][present] * faces.nx[face] + phase.primitive[2][present] * faces.ny[face];
    if (fields.dimension == 3) un += phase.primitive[3][present] * faces.nz[face];
    if (in_left != in_right && (in_left ? un : -un) > 0) continue;
    sum -= wetted(k);
    wetted(k) = 0;
  }
  if (sum <= 0) return as_the_cells_are();  // nothing is left
  for (Phase& phase : fields.phases) {
    if (sum != 1) phase.wetted[0][face] /= sum;
    phase.wetted[1][face] = phase.wetted[0][face];
  }
}

void SharpInterface::wet(const Faces& faces, Fields& fields, double dt) {
  for (const std::int32_t f : near_faces_) fields.near[f] = 0;
  near_faces_.clear();
  const auto consider = [&](std::int32_t f) {
    if (fields.near[f]) return;
    const std::int32_t left = mesh_.left[f], right = f < mesh_.first_boundary_face() ? mesh_.right[f] : left;
    const bool inflow = f >= mesh_.first_boundary_face() && !is_transmissive_[f - mesh_.first_boundary_face()];
    wet_face(faces, fields, f, dt);
    const int pure = fields.pure[left];
    if (!inflow && pure >= 0 && pure == fields.pure[right] && fields.phases[pure].wetted[0][f] == 1) return;
    if (inflow && pure >= 0 && pure == fields.pure[mesh_.right[f]]) return;
    fields.near[f] = 1;
    near_faces_.push_back(f);
  };
  for (const int k : planes_of_) {
    for (const std::int32_t cell : mixed_cells_)
      if (is_cut(fields, k, cell)) cells_[k][cell].blend = blend_of(fields, k, cell, dt);
  }
  exchange_blends();
  const auto faces_of = [&](std::int32_t cell) { for_each_face(cell, [&](std::int32_t f, int) { consider(f); }); };
  for (const auto* cells : {&cut_cells_, &mixed_cells_, &frontier_})
    for (const std::int32_t cell : *cells) faces_of(cell);
  for (std::int32_t cell = mesh_.n_owned; cell < mesh_.n_cells(); ++cell)
    if (knows_plane(cell) || fields.pure[cell] < 0) faces_of(cell);
  for (std::int32_t f = mesh_.first_boundary_face(); f < mesh_.n_faces(); ++f)
    if (!is_transmissive_[f - mesh_.first_boundary_face()] && fields.pure[mesh_.left[f]] != fields.pure[mesh_.right[f]])
      consider(f);
}

/// The area vectors with which phases meet in a cell: what is missing for the faces of each to close.
void SharpInterface::contacts_of(const Faces& faces, const Fields& fields, std::int32_t cell) {
  const int n = fields.n_phases();
  constexpr int most = 8;
  double surface = 0;
  std::array<std::array<Point, most>, most> between{};
  for_each_face(cell, [&](std::int32_t f, int side) {
    surface += faces.area[f];
    if (!fields.near[f]) return;
    const Point out = ((side == 0 ? 1.0 : -1.0) * faces.area[f]) * Point{faces.nx[f], faces.ny[f], faces.nz[f]};
    std::array<double, most> jump{};
    int dominant = 0;
    for (int k = 0; k < n; ++k) {
      const Phase& phase = fields.phases[k];
      jump[k] = phase.alpha[cell] - phase.wetted[side][f];
      if (phase.alpha[cell] + phase.wetted[side][f] >
          fields.phases[dominant].alpha[cell] + fields.phases[dominant].wetted[side][f])
        dominant = k;
    }
    jump[dominant] = 0;
    double others = 0, gains = 0;
    for (int k = 0; k < n; ++k) others += jump[k];
    jump[dominant] = -others;
    for (int k = 0; k < n; ++k) gains += std::max(0.0, jump[k]);
    for (int l = 0; l < n; ++l)
      for (int m = 0; m < n; ++m)
        if (l != m) between[l][m] = between[l][m] + contact_surface(jump[l], jump[m], gains) * out;
  });
  for (int l = 0; l < n; ++l)
    for (int m = l + 1; m < n; ++m) {
      const Point vector = between[l][m] - between[m][l];
      const double area = length(vector);
      if (area < 1e-13 * surface) continue;
      if (!fields.phases[l].is_void && !has_state(fields, l, cell)) continue;
      if (!fields.phases[m].is_void && !has_state(fields, m, cell)) continue;
      const Point normal = (1 / area) * vector;
      if (fields.phases[l].is_void)
        contacts_[m * n + l].push(cell, cell, cell, area, -1.0 * normal);
      else
        contacts_[l * n + m].push(cell, cell, cell, area, normal);
    }
}

bool SharpInterface::expects(const Fields& fields, int k, std::int32_t cell, double dt) const {
  constexpr double tolerance = 0.2;  // relative
  const double alpha = fields.phases[k].alpha[cell];
  if (!(alpha > 0) || corners_at_[cell] < 0) return false;
  const CellCorners& corners = corners_[corners_at_[cell]];
  int of = k;
  if (k == rest_) {
    of = -1;
    for (const int m : planes_of_)
      if (of < 0 || fields.phases[m].alpha[cell] > fields.phases[of].alpha[cell]) of = m;
  }
  bool expected = false, alone = true;
  for_each_face(cell, [&](std::int32_t f, int side) {
    if (f >= mesh_.first_boundary_face() || expected) return;
    const std::int32_t other = side == 0 ? mesh_.right[f] : mesh_.left[f];
    const Cell& from = cells_[of][other];
    if (!valid(of, other) || std::abs(from.ring) != 1) return;
    const Point delta = (side == 0 ? 1.0 : -1.0) * mesh_.face_delta[f];
    const CutPlane plane{from.plane.n, from.plane.d + dot(from.plane.n, delta) + from.speed * dt};
    const double there = volume_below(corners, k == rest_ ? complement(plane) : plane);
    expected = std::fabs(there - alpha) < tolerance * alpha;
    alone = false;
  });
  return expected || alone;
}

void SharpInterface::act(const Faces& faces, Fields& fields, std::span<const std::int32_t> touched) {
  const int n = fields.n_phases();
  for (int lm = 0; lm < n * n; ++lm) contacts_[lm].clear();
  for (int k = 0; k < n; ++k)
    if (!fields.phases[k].is_void)
      for (int c = 0; c < kernels_[k].n_inner; ++c)
        for (const std::int32_t cell : touched) fields.phases[k].inner.component(c)[cell] = 0;
  for (const std::int32_t cell : touched) contacts_of(faces, fields, cell);
  for (int l = 0; l < n; ++l)
    for (int m = 0; m < n; ++m) {
      ContactList& list = contacts_[l * n + m];
      const std::int32_t count = l == m ? 0 : list.cell.size();
      if (count == 0) continue;
      list.fill();
      if (fields.phases[m].is_void)
        kernels_[l].free_surface_in_cells(fields.phases[l], fields.phases[m].void_pressure, list, count);
      else
        pairs_[l * n + m].contact_in_cells(fields.phases[l], fields.phases[m], list, count);
    }
}

}  // namespace cobasis
