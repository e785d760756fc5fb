#include "solver/sharp_interface.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/geometry.hpp"
#include "solver/boundary.hpp"
#include "solver/interfaces.hpp"

namespace cobasis {
namespace {

std::size_t numbers_per_cell(const Fields& fields) {
  std::size_t states = 0;
  for (const Phase& phase : fields.phases) states += phase.conserved.size() + phase.primitive.size();
  return fields.phases.size() * 13 + states;
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
      is_symmetry_(mesh.n_boundary_faces),
      exchange_(mpi, mesh.neighbours, halo_capacities(mesh.neighbours, numbers_per_cell(fields)), 16),
      shares_planes_(setup.scheme.interface == InterfaceTreatment::sharp) {
  const int n = fields.n_phases();
  levels_ = shares_planes_ && std::ranges::any_of(fields.phases, [](const Phase& phase) {
              return !phase.is_void && phase.kind == Kind::solid;
            });
  for (int k = 0; k < n; ++k)
    if (fields.phases[k].is_void || (n == 2 && k == 1 && rest_ < 0 && !fields.phases[0].is_void)) rest_ = k;
  before_void_ = rest_ >= 0 && fields.phases[rest_].is_void;
  most_surface_ = std::max(1.0, 0.9 / setup.cfl);  // at 1 / cfl pressure would alternate for ever
  for (int k = 0; k < n; ++k) {
    if (k != rest_) planes_of_.push_back(k), cells_[k].resize(mesh.n_cells());
    Phase& phase = fields.phases[k];
    for (auto& side : phase.wetted) side.assign(faces.area.size(), 0);
    if (levels_) phase.levelling.assign(faces.area.size(), 0);
    health_.emplace_back(mesh.n_cells(), 0);
    entered_.emplace_back(mesh.n_cells(), 1);
    borrowed_.emplace_back(mesh.n_cells(), -1);
    if (phase.is_void) continue;
    if (shares_planes_ && setup.scheme.order == 2) {
      phase.centre = CellNumbers(fields.n_all + pack_width, fields.dimension);
      for (int d = 0; d < fields.dimension; ++d) phase.wetted_at[d].assign(faces.area.size(), 0);
      phase.used_slopes = CellNumbers(fields.n_all + pack_width, kernels[k].n_used_slopes);
    }
    phase.inner = CellNumbers(mesh.n_owned + pack_width, kernels[k].n_inner);
  }
  fields.near.assign(faces.area.size(), 0);
  contacts_.resize(n * n);
  between_.resize(n * n);
  jump_.resize(n);
  speed_users_.resize(n * n);
  for (int l = 0; l < n; ++l)
    for (int m = 0; m < n; ++m)
      if (l != m) {
        contacts_[l * n + m] = ContactList(2 * mesh.n_cells());
        contacts_[l * n + m].friction = setup.contact(l, m).coefficient;
      }

  for (std::int32_t cell = 0; cell < mesh.n_owned; ++cell) hops_ = std::max(hops_, hops_of(mesh.cell_type[cell]));
  hops_ = static_cast<int>(mpi.max(hops_));

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
    for (std::int32_t f = mesh.boundary_groups[i].first; f < mesh.boundary_groups[i].last; ++f) {
      is_transmissive_[f - mesh.first_boundary_face()] = !std::holds_alternative<Inflow>(boundaries[i]);
      is_symmetry_[f - mesh.first_boundary_face()] = is_plane_of_symmetry(boundaries[i]);
    }
}

void SharpInterface::exchange_for_faces() {
  exchange_cells(exchange_, mesh_.neighbours, [&](std::int32_t cell, const auto& with) {
    for (const int k : planes_of_)
      if (valid(k, cell) && cells_[k][cell].ring == -1) with(cells_[k][cell].blend);
    if (!before_void_ || !knows_plane(cell)) return;
    for (const int k : planes_of_) with(entered_[k][cell]);
  });
}

/// Whether a phase that is absent from the cell comes into it within the step: where a neighbour that has more than
/// dust of it moves this way, and has some of it at the face. What touched the cell's other faces without that would
/// get volume from a void, but no mass. Other phases do not give way for nothing; beside them any phase may come.
void SharpInterface::find_entered(const Faces& faces, const Fields& fields, std::int32_t cell, double dt) {
  for (const int k : planes_of_) {
    const Phase& phase = fields.phases[k];
    std::int8_t& entered = entered_[k][cell];
    entered = phase.alpha[cell] > 0;
    for_each_face(cell, [&](std::int32_t f, int side) {
      if (entered || f >= mesh_.first_boundary_face()) return;
      const std::int32_t other = side == 0 ? mesh_.right[f] : mesh_.left[f];
      if (!(phase.alpha[other] > 0) || borrows(k, other)) return;
      double in = phase.primitive[1][other] * faces.nx[f] + phase.primitive[2][other] * faces.ny[f];
      if (fields.dimension == 3) in += phase.primitive[3][other] * faces.nz[f];
      entered = (side == 0 ? in < 0 : in > 0) && side_fraction(fields, k, f, 1 - side, dt) > 0;
    });
  }
}

bool SharpInterface::knows_plane(std::int32_t cell) const {
  return std::ranges::any_of(planes_of_, [&](int k) { return valid(k, cell) && cells_[k][cell].ring > 0; });
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

/// A cell that has nobody to share its state with bears only so much surface: its pressure follows from what all its
/// faces and contacts do in a step, and overshoots where they are more than 1 / cfl of those that the paper's scheme
/// gives it, a part alpha of each face. So of every material; of a void no face may take more than twice its part, as
/// more might flow in than there is room. All faces are blended alike: the interface in the cell keeps its direction.
double SharpInterface::blend_of(const Fields& fields, int k, std::int32_t cell, double dt) const {
  constexpr double most_of_void = 2;
  if (!fields.cautious.empty() && fields.cautious[cell] > 0) return 0;
  const double alpha = fields.phases[k].alpha[cell];
  double surface = 0, wet = 0, blend = 1;
  for_each_face(cell, [&](std::int32_t f, int side) {
    const double share = side_fraction(fields, k, f, side, dt);
    surface += mesh_.area[f];
    wet += share * mesh_.area[f];
    if (share < alpha) blend = std::min(blend, (most_of_void - 1) * (1 - alpha) / (alpha - share));
  });
  const double section = cells_[k][cell].cut.area;
  const auto bear = [&](double part, double planes) {
    const double excess = planes + section - part * surface;
    if (excess > 0) blend = std::min(blend, (most_surface_ - 1) * part * surface / excess);
  };
  bear(alpha, wet);
  const double empty = before_void_ ? fields.phases[rest_].alpha[cell] : 0;
  if (alpha + empty < 1) bear(1 - alpha, surface - wet);
  return blend;
}

/// Of two planes that differ by the noise of the volume fractions the face takes the one that is carried to it: with
/// the mean of both, noise would grow.
double SharpInterface::left_weight(const Faces& faces, const Fields& fields, std::int32_t face) const {
  double flow = 0;
  for (const std::int32_t cell : {mesh_.left[face], mesh_.right[face]})
    for (const Phase& phase : fields.phases) {
      if (phase.is_void || !(phase.alpha[cell] > 0)) continue;
      flow += phase.conserved[1][cell] * faces.nx[face] + phase.conserved[2][cell] * faces.ny[face];
      if (fields.dimension == 3) flow += phase.conserved[3][cell] * faces.nz[face];
    }
  return flow > 0 ? 1 : flow < 0 ? 0 : 0.5;
}

/// What each phase has of a face, as the cells on both sides see it. Where both know planes they agree on one;
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
  const double from_left = boundary ? 1 : left_weight(faces, fields, face);
  constexpr double agreement = 0.01;  // relative
  bool agree = true;
  double sum = 0;
  for (const int k : planes_of_) {
    double share = side_fraction(fields, k, face, 0, dt);
    if (!boundary) {
      const double other = side_fraction(fields, k, face, 1, dt), both = share + other;
      agree = agree && std::fabs(share - other) <= agreement * std::min(both, 2 - both);
      if (levels_) level(faces, fields, k, face, share - other, dt);
      share = from_left * share + (1 - from_left) * other;
    }
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
    // From one empty cell to the next it comes within a step only where planes leave no doubt of it.
    if (in_left == in_right && agree && (entered_[k][left] || entered_[k][right]) && has_state(fields, k, left) &&
        has_state(fields, k, right))
      continue;
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
  // of what is left: a phase that has now all of the face, has it around its centre
  if (knows_centres(fields)) find_wetted_centroids(fields, face, from_left >= 0.5 ? 0 : 1, dt);
}

void SharpInterface::wet(const Faces& faces, Fields& fields, double dt) {
  for (const std::int32_t f : near_faces_) {
    fields.near[f] = 0;
    if (levels_)
      for (Phase& phase : fields.phases) phase.levelling[f] = 0;
    if (knows_centres(fields)) forget_wetted_centroids(fields, f);
  }
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
  if (before_void_)
    for (const auto* cells : {&cut_cells_, &mixed_cells_, &frontier_})
      for (const std::int32_t cell : *cells) find_entered(faces, fields, cell, dt);
  exchange_for_faces();
  const auto faces_of = [&](std::int32_t cell) { for_each_face(cell, [&](std::int32_t f, int) { consider(f); }); };
  for (const auto* cells : {&cut_cells_, &mixed_cells_, &frontier_, &thin_layers_})
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
  double surface = 0;
  std::ranges::fill(between_, Point{0, 0, 0});
  for_each_face(cell, [&](std::int32_t f, int side) {
    surface += faces.area[f];
    if (!fields.near[f]) return;
    const Point out = ((side == 0 ? 1.0 : -1.0) * faces.area[f]) * Point{faces.nx[f], faces.ny[f], faces.nz[f]};
    int dominant = 0;
    for (int k = 0; k < n; ++k) {
      const Phase& phase = fields.phases[k];
      jump_[k] = phase.alpha[cell] - phase.wetted[side][f];
      if (phase.alpha[cell] + phase.wetted[side][f] >
          fields.phases[dominant].alpha[cell] + fields.phases[dominant].wetted[side][f])
        dominant = k;
    }
    jump_[dominant] = 0;
    double others = 0, gains = 0;
    for (int k = 0; k < n; ++k) others += jump_[k];
    jump_[dominant] = -others;
    for (int k = 0; k < n; ++k) gains += std::max(0.0, jump_[k]);
    for (int l = 0; l < n; ++l)
      for (int m = 0; m < n; ++m)
        if (l != m) between_[l * n + m] = between_[l * n + m] + contact_surface(jump_[l], jump_[m], gains) * out;
  });
  for (int l = 0; l < n; ++l)
    for (int m = l + 1; m < n; ++m) {
      const Point vector = between_[l * n + m] - between_[m * n + l];
      const double area = length(vector);
      if (area < 1e-13 * surface) continue;
      if (!fields.phases[l].is_void && !has_state(fields, l, cell)) continue;
      if (!fields.phases[m].is_void && !has_state(fields, m, cell)) continue;
      const Point normal = (1 / area) * vector;
      Point at{0, 0, 0};
      for (const int k : {m, l})
        if (k != rest_ && valid(k, cell)) at = cells_[k][cell].cut.centroid;
      if (fields.phases[l].is_void)
        contacts_[m * n + l].push(cell, cell, cell, area, -1.0 * normal, at);
      else
        contacts_[l * n + m].push(cell, cell, cell, area, normal, at);
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
    expected = alpha < (1 + tolerance) * there && there < 10 * alpha;
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
  run_contacts(fields, &PhaseKernels::free_surface_in_cells, &PairKernels::contact_in_cells);
}

/// The contacts listed, by one kernel before a void and one between phases.
void SharpInterface::run_contacts(Fields& fields, FreeSurfaceKernel PhaseKernels::*before_void,
                                  ContactKernel PairKernels::*between) {
  const int n = fields.n_phases();
  for (int l = 0; l < n; ++l)
    for (int m = 0; m < n; ++m) {
      ContactList& list = contacts_[l * n + m];
      const std::int32_t count = l == m ? 0 : list.cell.size();
      if (count == 0) continue;
      list.fill();
      if (fields.phases[m].is_void)
        (kernels_[l].*before_void)(fields.phases[l], fields.phases[m].void_pressure, list, count);
      else
        (pairs_[l * n + m].*between)(fields.phases[l], fields.phases[m], list, count);
    }
}

}  // namespace cobasis
