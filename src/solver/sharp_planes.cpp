// Where the planes of sharp interfaces lie: in cut cells, and in the rings around them.
#include <algorithm>
#include <cmath>

#include "mesh/geometry.hpp"
#include "solver/remote_volumes.hpp"
#include "solver/sharp_interface.hpp"

namespace cobasis {
namespace {

constexpr int first_means = 4, first_fits = 30,
              fits_per_step = 2;  ///< passes over the normals: they converge quadratically
constexpr int rings = 3;          ///< of cells around the cut ones that know the plane nearby

}  // namespace

/// How near a cell is, over cells with the phase, to one that is half full of it; 0: farther than `reach` cells. What
/// has nobody to share its state with is a film or a splinter thinner than a cell: a plane there would let waves cross
/// it faster than the step can follow. What is less than it, and small, it cannot share with: see RemoteVolumes.
void SharpInterface::find_health(Fields& fields) {
  const int reach = hops_ == 1 ? 3 : hops_ == 2 ? 4 : 6;
  for (int k = 0; k < fields.n_phases(); ++k) {
    const auto& alpha = fields.phases[k].alpha;
    for (std::int32_t cell = 0; cell < mesh_.n_cells(); ++cell)
      health_[k][cell] = !(alpha[cell] > 0) || alpha[cell] >= 0.5 ? static_cast<std::int8_t>(reach + 1) : 0;
  }
  for (int distance = 1; distance <= reach; ++distance) {
    for (int k = 0; k < fields.n_phases(); ++k) {
      const auto& alpha = fields.phases[k].alpha;
      for (const std::int32_t cell : cut_cells_) {
        if (health_[k][cell] > 0) continue;
        const double least = std::min(alpha[cell], RemoteVolumes::least_root(mesh_.cell_type[cell]));
        for_each_face(cell, [&](std::int32_t f, int side) {
          if (f >= mesh_.first_boundary_face()) return;
          const std::int32_t other = side == 0 ? mesh_.right[f] : mesh_.left[f];
          if (alpha[other] > 0 && alpha[other] >= least && health_[k][other] == reach + 2 - distance)
            health_[k][cell] = static_cast<std::int8_t>(reach + 1 - distance);
        });
      }
    }
    exchange(fields);
  }
}

/// Whether the cell tells its neighbours of the planes of its interfaces.
bool SharpInterface::has_planes(const Fields& fields, std::int32_t cell) const {
  if (!shares_planes_ || (!fields.cautious.empty() && fields.cautious[cell] > 0)) return false;
  for (int k = 0; k < fields.n_phases(); ++k)
    if (health_[k][cell] == 0) return false;
  return true;
}

bool SharpInterface::is_cut(const Fields& fields, int k, std::int32_t cell) const {
  const double alpha = fields.phases[k].alpha[cell];
  return alpha > 0 && alpha < 1;
}

/// From now on they are known.
const CellCorners& SharpInterface::find_corners(std::int32_t cell) {
  if (corners_at_[cell] < 0) {
    corners_at_[cell] = static_cast<std::int32_t>(corners_.size());
    corners_.push_back(corners_of(mesh_, cell));
  }
  return corners_[corners_at_[cell]];
}

void SharpInterface::put_plane(const Fields& fields, int k, std::int32_t cell, const Point& n) {
  const CellCorners& corners = find_corners(cell);
  Cell& c = cells_[k][cell];
  c.plane = {n, place_plane(corners, n, fields.phases[k].alpha[cell])};
  c.cut = section(corners, c.plane);
  c.ring = 1;
  c.step = step_;
}

/// Whether the cell's arrays hold a state of the phase: its own, or the one with which it would arrive, or would come
/// back where less than nothing of it is left.
bool SharpInterface::has_state(const Fields& fields, int k, std::int32_t cell) const {
  return fields.phases[k].alpha[cell] > 0 || borrows(k, cell);
}

/// Whether another cell may take over its state: what was borrowed since the last exchange, the neighbours of other
/// ranks do not know yet.
bool SharpInterface::lends(const Fields& fields, int k, std::int32_t cell) const {
  return fields.phases[k].alpha[cell] > 0 || (borrows(k, cell) && borrowed_[k][cell] < stage_);
}

void SharpInterface::borrow(Fields& fields, int k, std::int32_t cell, std::int32_t from) {
  Phase& phase = fields.phases[k];
  for (auto& component : phase.primitive) component[cell] = component[from];
  for (int c = fields.first_cobasis(); c < phase.n_conserved(); ++c)
    phase.conserved[c][cell] = phase.conserved[c][from];
  borrowed_[k][cell] = stage_;
}

/// The neighbour that has most of a phase and a state of its own; -1: none.
std::int32_t SharpInterface::richest_neighbour(const Fields& fields, int k, std::int32_t cell) const {
  const auto& alpha = fields.phases[k].alpha;
  std::int32_t richest = -1;
  for_each_face(cell, [&](std::int32_t f, int side) {
    if (f >= mesh_.first_boundary_face()) return;
    const std::int32_t other = side == 0 ? mesh_.right[f] : mesh_.left[f];
    if (!(alpha[other] > 0) || borrows(k, other)) return;
    if (richest < 0 || alpha[other] > alpha[richest] ||
        (alpha[other] == alpha[richest] && mesh_.global_id[other] < mesh_.global_id[richest]))
      richest = other;
  });
  return richest;
}

/// Followers take the state of the neighbour that has most of the phase; where none has a state of its own, the one
/// with which the phase began.
void SharpInterface::follow(Fields& fields, std::span<const std::pair<std::int32_t, int>> followers) {
  following_.clear();
  for (const auto& [cell, k] : followers) {
    borrowed_[k][cell] = stage_;
    following_.push_back(cell);
  }
  for (const auto& [cell, k] : followers) {
    if (cell >= mesh_.n_owned) continue;
    const std::int32_t richest = richest_neighbour(fields, k, cell);
    borrow(fields, k, cell, richest < 0 ? fields.n_all : richest);
  }
}

/// Phases that are absent from a cell but not from a neighbour may come from there.
void SharpInterface::borrow_missing(Fields& fields, std::int32_t cell) {
  for (int k = 0; k < fields.n_phases(); ++k) {
    if (fields.phases[k].is_void || has_state(fields, k, cell)) continue;
    const std::int32_t richest = richest_neighbour(fields, k, cell);
    if (richest >= 0) borrow(fields, k, cell, richest);
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

/// The planes of cells that other ranks have as halo, and the states that phases have borrowed there.
void SharpInterface::exchange(Fields& fields) {
  exchange_cells(exchange_, mesh_.neighbours, [&](std::int32_t cell, const auto& with) {
    for (int k = 0; k < fields.n_phases(); ++k) {
      with(health_[k][cell]);
      bool borrowed = borrows(k, cell);
      with(borrowed);
      if (cell >= mesh_.n_owned) borrowed_[k][cell] = borrowed ? stage_ : -1;
    }
    for (const int k : planes_of_) {
      Cell& c = cells_[k][cell];
      int ring = valid(k, cell) ? c.ring : 0;
      with(ring);
      if (ring == 0) continue;
      c.ring = ring, c.step = step_;
      for (double* number : {&c.plane.n.x, &c.plane.n.y, &c.plane.n.z, &c.plane.d, &c.cut.centroid.x, &c.cut.centroid.y,
                             &c.cut.centroid.z, &c.cut.area, &c.speed, &c.ripple_speed})
        with(*number);
    }
    for (int k = 0; k < fields.n_phases(); ++k) {
      if (!borrows(k, cell)) continue;
      Phase& phase = fields.phases[k];
      for (auto& component : phase.primitive) with(component[cell]);
      for (int c = fields.first_cobasis(); c < phase.n_conserved(); ++c) with(phase.conserved[c][cell]);
    }
  });
  ++stage_;
}

void SharpInterface::place(const Faces& faces, Fields& fields,
                           std::span<const std::pair<std::int32_t, int>> followers) {
  ++step_;
  first_stage_ = ++stage_;
  follow(fields, followers);
  cut_cells_.clear();
  mixed_cells_.clear();
  for (std::int32_t cell = 0; cell < mesh_.n_owned; ++cell)
    if (fields.pure[cell] < 0) cut_cells_.push_back(cell);
  if (shares_planes_) find_health(fields);
  std::erase_if(cut_cells_, [&](std::int32_t cell) {
    if (has_planes(fields, cell) && has_direction(faces, fields, cell)) return false;
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
    for (const int k : planes_of_) {
      gather_moments(fields, k);
      renew(k, [&](std::int32_t cell) { return fitted_normal(k, cell); });
    }
  }
  settled_ = true;
  if (knows_centres(fields)) find_centres(fields);
  find_speeds(fields);
  for (const auto* cells : {&cut_cells_, &mixed_cells_})
    for (const std::int32_t cell : *cells) borrow_missing(fields, cell);
  exchange(fields);
  spread(fields, 2);
  seed(faces, fields);
  exchange(fields);
  for (int ring = 3; ring <= rings; ++ring) {
    spread(fields, ring);
    exchange(fields);
  }
  if (!fields.phases[planes_of_[0]].is_second_order()) return;
  const auto lend = [&](std::int32_t cell) {
    for (int k = 0; k < fields.n_phases(); ++k)
      if (borrows(k, cell)) lend_to_faces(fields, k, cell);
  };
  for (const auto* cells : {&cut_cells_, &mixed_cells_, &frontier_})
    for (const std::int32_t cell : *cells) lend(cell);
  for (const std::int32_t cell : following_)
    if (cell < mesh_.n_owned) lend(cell);
  for (std::int32_t cell = mesh_.n_owned; cell < mesh_.n_cells(); ++cell) lend(cell);
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
  if (levels_) find_ripple_speeds(fields);
}

void SharpInterface::run_speeds(Fields& fields) {
  run_contacts(fields, &PhaseKernels::free_surface_speed, &PairKernels::contact_speed);
  for (std::size_t lm = 0; lm < contacts_.size(); ++lm)
    for (std::size_t i = 0; i < speed_users_[lm].size(); ++i) {
      const auto [cell, k] = speed_users_[lm][i];
      cells_[k][cell].speed = contacts_[lm].speed[static_cast<std::int32_t>(i)];
    }
}

/// A cell that is not cut takes over a plane; at the beginning of the step it may at most touch the cell.
void SharpInterface::adopt(Fields& fields, int k, std::int32_t cell, std::int32_t from, const CutPlane& plane,
                           double speed, int ring) {
  Cell& c = cells_[k][cell];
  for (int phase = 0; phase < fields.n_phases(); ++phase)
    if (!fields.phases[phase].is_void && !has_state(fields, phase, cell) && lends(fields, phase, from))
      borrow(fields, phase, cell, from);
  borrow_missing(fields, cell);
  c = {plane, {}, speed, 0, 1, ring, step_};
  const CellCorners& corners = find_corners(cell);
  const double bound = place_plane(corners, plane.n, fields.phases[k].alpha[cell]);
  c.plane.d = fields.phases[k].alpha[cell] > 0 ? std::max(c.plane.d, bound) : std::min(c.plane.d, bound);
}

/// Cells that are not cut but beside cells of the ring before take the plane that passes nearest to them.
void SharpInterface::spread(Fields& fields, int ring) {
  if (ring == 2) frontier_.clear();
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
    frontier_.insert(frontier_.end(), next_.begin(), next_.end());
  }
}

/// Where two pure cells of different phases meet and neither knows a plane, the faces between them are one: at an edge
/// their mean. A cell with others on opposite sides, a layer as thin as itself, has none: there they meet at its faces.
void SharpInterface::seed(const Faces& faces, Fields& fields) {
  const int n = fields.n_phases();
  thin_layers_.clear();
  for (int lm = 0; lm < n * n; ++lm) contacts_[lm].clear(), speed_users_[lm].clear();
  for (std::int32_t cell = 0; cell < mesh_.n_owned; ++cell) {
    const int own = fields.pure[cell];
    if (own < 0) continue;
    for (const int k : planes_of_) {
      if (valid(k, cell)) continue;
      Steps steps;
      std::int32_t widest = -1;
      double distance = 0, largest = 0;
      for_each_face(cell, [&](std::int32_t f, int side) {
        if (f >= mesh_.first_boundary_face()) return;
        const std::int32_t other = side == 0 ? mesh_.right[f] : mesh_.left[f];
        const int there = fields.pure[other];
        if (there < 0 || there == own || (own != k && there != k)) return;
        const double out = (side == 0 ? 1.0 : -1.0) * (own == k ? 1.0 : -1.0);  // outward from phase k
        const Point normal = out * Point{faces.nx[f], faces.ny[f], faces.nz[f]};
        steps.vector = steps.vector + faces.area[f] * normal;
        distance += faces.area[f] * dot(normal, outlines_.center(f, side));
        steps.size += faces.area[f];
        if (faces.area[f] > largest) largest = faces.area[f], widest = other;
      });
      if (widest < 0) continue;
      if (steps.cancel()) {
        thin_layers_.push_back(cell);
        continue;
      }
      const Point normal = (1 / length(steps.vector)) * steps.vector;
      adopt(fields, k, cell, widest, {normal, distance / steps.size}, 0, 2);
      frontier_.push_back(cell);
      const int m = own == k ? fields.pure[widest] : own;
      contacts_[k * n + m].push(cell, own == k ? cell : widest, own == k ? widest : cell, 0, normal);
      speed_users_[k * n + m].emplace_back(cell, k);
    }
  }
  run_speeds(fields);
}

}  // namespace cobasis
