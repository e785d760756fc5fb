#include "solver/reconstruction.hpp"

#include <algorithm>
#include <bit>
#include <tuple>

namespace cobasis {
namespace {

constexpr int gaps = static_cast<int>(Around::gaps);

/// Per neighbour the faces shared with it: 2 face + own side.
std::vector<std::vector<std::int32_t>> shared_faces(const Mesh& mesh) {
  std::vector<std::vector<std::int32_t>> faces(mesh.neighbours.size());
  for (std::int32_t f = mesh.n_interior_faces; f < mesh.first_boundary_face(); ++f) {
    const int own_side = mesh.left[f] < mesh.n_owned ? 0 : 1;
    const std::int32_t halo = own_side == 0 ? mesh.right[f] : mesh.left[f];
    for (std::size_t n = 0; n < mesh.neighbours.size(); ++n)
      if (halo >= mesh.neighbours[n].receive_first &&
          halo < mesh.neighbours[n].receive_first + mesh.neighbours[n].receive_count)
        faces[n].push_back(2 * f + own_side);
  }
  for (auto& list : faces)
    std::ranges::sort(list, {}, [&](std::int32_t entry) {
      const std::int32_t f = entry >> 1;
      return std::tuple(mesh.global_id[mesh.left[f]], mesh.global_id[mesh.right[f]], mesh.nx[f], mesh.ny[f],
                        mesh.nz[f]);
    });
  return faces;
}

std::vector<std::size_t> capacities(const std::vector<std::vector<std::int32_t>>& faces,
                                    const std::vector<PhaseKernels>& kernels) {
  std::size_t per_face = 0;
  for (const PhaseKernels& k : kernels) per_face += k.n_face_state;
  std::vector<std::size_t> result;
  for (const auto& list : faces) result.push_back(per_face * list.size());
  return result;
}

}  // namespace

Reconstruction::Reconstruction(const Mpi& mpi, const Mesh& mesh, const Faces& faces, Fields& fields,
                               const std::vector<PhaseKernels>& kernels, const std::vector<Boundary>& boundaries)
    : stencil_(make_stencil(mesh, faces, boundaries, fields.multiphase() ? PhaseCount::several : PhaseCount::one, mpi)),
      kernels_(kernels),
      with_slopes_(mesh.n_owned),
      beside_gaps_(mesh.n_owned),
      without_(mesh.n_owned),
      used_(fields.n_phases()),
      flat_(mesh.n_owned + pack_width, 0.0),
      halo_faces_(shared_faces(mesh)),
      exchange_(mpi, mesh.neighbours, capacities(halo_faces_, kernels), 14) {
  if (stencil_.averages) {
    std::size_t per_cell = 0;
    for (std::size_t k = 0; k < fields.phases.size(); ++k) {
      if (fields.phases[k].is_void) continue;
      fields.phases[k].slopes = CellNumbers(fields.n_all, kernels[k].n_slopes);
      fields.phases[k].slopes_known.assign(fields.n_all, 0);
      per_cell += 1 + kernels[k].n_slopes;
    }
    std::vector<std::size_t> capacity;
    for (const Neighbour& neighbour : mesh.neighbours) capacity.push_back(per_cell * neighbour.receive_count);
    slope_exchange_.emplace(mpi, mesh.neighbours, capacity, 15);
  }
  for (Group* group : {&inside_, &beside_halo_})
    for (CellList& cells : group->cells) cells = CellList(mesh.n_owned);
  for (std::int32_t cell = 0; cell < mesh.n_owned; ++cell) {
    bool needs_halo = false;
    for (int j = 0; j < stencil_.size; ++j) {
      const std::int32_t other = stencil_.cell[static_cast<std::size_t>(j) * stencil_.stride + cell];
      needs_halo = needs_halo || (other >= mesh.n_owned && other < mesh.n_cells());
    }
    (needs_halo ? beside_halo_ : inside_).cells[stencil_.at_mirror[cell]].push(cell);
  }
  for (Group* group : {&inside_, &beside_halo_})
    for (CellList& cells : group->cells) {
      const std::int32_t count = cells.size();
      cells.fill(pack_width);  // loads of whole packs go beyond the end
      cells.cut(count);
    }
  for (std::size_t i = 0; i < boundaries.size(); ++i) {
    const BoundaryGroup& group = mesh.boundary_groups[i];
    for (std::int32_t face = group.first; face < group.last; ++face) {
      const bool transmissive = std::holds_alternative<Transmissive>(boundaries[i]);
      if (transmissive) transmissive_.push_back(face);
      if (transmissive || is_prescribed(boundaries[i])) {
        if (const std::int32_t cell = mesh.left[face]; stencil_.averages_in(cell)) flat_[cell] = 1;
      }
      if (!std::holds_alternative<Inflow>(boundaries[i])) continue;
      const std::int32_t ghost = mesh.ghost_of(face);
      for (std::size_t k = 0; k < fields.phases.size(); ++k) {
        Phase& phase = fields.phases[k];
        if (phase.is_void) continue;
        const std::size_t to = phase.face_states.stride + face;
        const int n_primitive = static_cast<int>(phase.primitive.size());
        for (int c = 0; c < kernels[k].n_face_state; ++c)
          phase.face_states.component(c)[to] = c == 0 ? phase.density()[ghost]
                                               : c < n_primitive
                                                   ? phase.primitive[c][ghost]
                                                   : phase.conserved[fields.first_cobasis() + c - n_primitive][ghost];
      }
    }
  }
}

/// Cells of a group in which phase k is present: with_slopes_, beside_gaps_ and without_.
void Reconstruction::select(const Group& group, const Fields& fields, int k, int mirrors) {
  const CellList& cells = group.cells[mirrors];
  with_slopes_.clear();
  beside_gaps_.clear();
  without_.clear();
  const AlignedVector<double>& alpha = fields.phases[k].alpha;
  for (std::int32_t i = 0; i < cells.size(); i += pack_width) {
    const Indices<Pack> at = load_indices<Pack>(&cells[i]);
    const unsigned valid = cells.size() - i >= pack_width ? (1u << pack_width) - 1 : (1u << (cells.size() - i)) - 1;
    unsigned present = valid, sloping = valid & ~positive_lanes(gather<Pack>(flat_.data(), at)), some = sloping;
    if (fields.multiphase()) {
      const Pack own = gather<Pack>(alpha.data(), at);
      Pack least = own;
      for (int j = 0; j < stencil_.size; ++j) {
        const std::int32_t* const neighbours = &stencil_.cell[static_cast<std::size_t>(j) * stencil_.stride];
        least = smaller(least, gather<Pack>(alpha.data(), lookup<Pack>(neighbours, at)));
      }
      present &= positive_lanes(own);
      some &= positive_lanes(own - Pack(least_for_slopes));
      // where the phase has a centroid of its own, its distances are not the cells'
      const bool has_centres = fields.phases[k].centre.stride != 0;
      sloping &= has_centres ? ~positive_lanes(Pack(1.0) - least) : positive_lanes(least - Pack(least_for_slopes));
    }
    if (!fields.cautious.empty()) {
      const unsigned cautious = positive_lanes(gather<Pack>(fields.cautious.data(), at));
      sloping &= ~cautious;
      some &= ~cautious;
    }
    store_chosen(sloping, at, with_slopes_.end());
    with_slopes_.grow(std::popcount(sloping));
    store_chosen(some & ~sloping, at, beside_gaps_.end());
    beside_gaps_.grow(std::popcount(some & ~sloping));
    store_chosen(present & ~some, at, without_.end());
    without_.grow(std::popcount(present & ~some));
  }
}

void Reconstruction::find_slopes(Group& group, Fields& fields, const Faces& faces) {
  for (int k = 0; k < fields.n_phases(); ++k) {
    Phase& phase = fields.phases[k];
    if (phase.is_void) continue;
    for (int mirrors = 0; mirrors < 2; ++mirrors) {
      select(group, fields, k, mirrors);
      for (const auto& [list, around] : {std::pair(&with_slopes_, mirrors), std::pair(&beside_gaps_, gaps)}) {
        const std::int32_t count = list->size();
        for (const std::int32_t cell : list->span()) phase.slopes_known[cell] = 1;
        list->fill(pack_width);
        kernels_[k].find_slopes[around](phase, faces, stencil_, *list, count);
      }
    }
  }
}

void Reconstruction::run(Group& group, Fields& fields, const Faces& faces, const ReconstructionOptions& options) {
  for (int k = 0; k < fields.n_phases(); ++k) {
    Phase& phase = fields.phases[k];
    if (phase.is_void) continue;
    for (int mirrors = 0; mirrors < 2; ++mirrors) {
      select(group, fields, k, mirrors);
      for (const auto& [list, around] : {std::pair(&with_slopes_, mirrors), std::pair(&beside_gaps_, gaps)}) {
        const std::int32_t count = list->size();
        list->fill(pack_width);
        if (around == gaps && phase.used_slopes.stride != 0)
          for (std::int32_t i = 0; i < count; ++i) used_[k].push_back((*list)[i]);
        fallen_ += kernels_[k].reconstruct[around][stencil_.averages](phase, faces, stencil_, *list, count, options);
        reconstructed_ += count;
      }
      const std::int32_t others = without_.size();
      without_.fill(pack_width);
      if (others > 0) kernels_[k].copy_to_faces(phase, faces, without_, others);
      if (options.rings) kernels_[k].hoop_of_cells(phase, *options.rings, without_, others);
    }
  }
}

void Reconstruction::forget_slopes(Fields& fields) {
  for (std::size_t k = 0; k < used_.size(); ++k) {
    CellNumbers& slopes = fields.phases[k].used_slopes;
    for (int c = 0; c < kernels_[k].n_used_slopes; ++c)
      for (const std::int32_t cell : used_[k]) slopes.component(c)[cell] = 0;
    used_[k].clear();
  }
}

void Reconstruction::run_inside(Fields& fields, const Faces& faces, const ReconstructionOptions& options) {
  forget_slopes(fields);
  if (stencil_.averages) {
    // of all cells: where a phase has been it may have left some, of a step that a restart does not know
    for (Phase& phase : fields.phases) std::ranges::fill(phase.slopes_known, 0.0);
    find_slopes(inside_, fields, faces);
  } else {
    run(inside_, fields, faces, options);
  }
}

void Reconstruction::run_beside_halo(const Mesh& mesh, Fields& fields, const Faces& faces,
                                     const ReconstructionOptions& options) {
  if (stencil_.averages) {
    const auto visit = [&](std::int32_t cell, const auto& with) {
      for (std::size_t k = 0; k < fields.phases.size(); ++k) {
        Phase& phase = fields.phases[k];
        if (phase.is_void || (fields.multiphase() && !(phase.alpha[cell] > 0))) continue;
        with(phase.slopes_known[cell]);
        for (int c = 0; c < kernels_[k].n_slopes; ++c) with(phase.slopes.component(c)[cell]);
      }
    };
    find_slopes(beside_halo_, fields, faces);
    send_cells(*slope_exchange_, mesh.neighbours, visit);
    run(inside_, fields, faces, options);
    receive_cells(*slope_exchange_, mesh.neighbours, visit);
  }
  run(beside_halo_, fields, faces, options);
  for (std::size_t k = 0; k < fields.phases.size(); ++k) {
    Phase& phase = fields.phases[k];
    if (phase.is_void) continue;
    for (int c = 0; c < kernels_[k].n_face_state; ++c) {
      double* const values = phase.face_states.component(c);
      for (const std::int32_t face : transmissive_) values[phase.face_states.stride + face] = values[face];
    }
  }
}

void Reconstruction::send(const Mesh& mesh, const Fields& fields) {
  for (std::size_t n = 0; n < halo_faces_.size(); ++n) {
    std::vector<double>& out = exchange_.outgoing(n);
    out.clear();
    for (const std::int32_t entry : halo_faces_[n]) {
      const std::int32_t face = entry >> 1, side = entry & 1, cell = side == 0 ? mesh.left[face] : mesh.right[face];
      for (std::size_t k = 0; k < fields.phases.size(); ++k) {
        const Phase& phase = fields.phases[k];
        if (phase.is_void || (fields.multiphase() && !(phase.alpha[cell] > 0))) continue;
        const std::size_t from = side * phase.face_states.stride + face;
        for (int c = 0; c < kernels_[k].n_face_state; ++c) out.push_back(phase.face_states.component(c)[from]);
      }
    }
  }
  exchange_.start();
}

void Reconstruction::receive(const Mesh& mesh, Fields& fields) {
  exchange_.finish();
  for (std::size_t n = 0; n < halo_faces_.size(); ++n) {
    const double* in = exchange_.incoming(n).data();
    for (const std::int32_t entry : halo_faces_[n]) {
      const std::int32_t face = entry >> 1, side = 1 - (entry & 1),
                         cell = side == 0 ? mesh.left[face] : mesh.right[face];
      for (std::size_t k = 0; k < fields.phases.size(); ++k) {
        Phase& phase = fields.phases[k];
        if (phase.is_void || (fields.multiphase() && !(phase.alpha[cell] > 0))) continue;
        const std::size_t to = side * phase.face_states.stride + face;
        for (int c = 0; c < kernels_[k].n_face_state; ++c) phase.face_states.component(c)[to] = *in++;
      }
    }
  }
}

}  // namespace cobasis
