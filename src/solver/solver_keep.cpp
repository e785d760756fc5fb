// What of the solver must outlive it, so that the next one goes on with the same bits.
#include <algorithm>
#include <bit>
#include <cstdint>

#include "solver/solver.hpp"

namespace cobasis {
namespace {

bool same_bits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

}  // namespace

void Solver::keep(Keeper& keeper) {
  keeper.number("time", time_);
  keeper.whole_number("step", step_);
  keeper.number("last_dt", last_dt_);
  keeper.number("stable_step", stable_step_);
  keeper.whole_number("redone", redone_);
  keeper.counter("torn", torn_);
  keeper.counter("followed", followed_);
  keeper.number("seconds", clock_.total);
  keeper.number("seconds_in_kernels", clock_.kernels);
  keeper.number("seconds_in_sweeps", clock_.sweeps);
  for (Phase& phase : fields_.phases) {
    const auto owned = [&](AlignedVector<double>& values) { return std::span(values.data(), mesh_.n_owned); };
    if (fields_.multiphase()) keeper.cells("alpha." + phase.name, owned(phase.alpha));
    for (int c = 0; c < phase.n_conserved(); ++c)
      keeper.cells("conserved." + phase.name + "." + std::to_string(c), owned(phase.conserved[c]));
  }
  keep_derived(keeper);
  for (int k = 0; k < fields_.n_phases(); ++k)
    for (std::size_t c = 0; c < booked_[k].size() && !fields_.phases[k].is_void; ++c)
      keeper.boundary_faces("booked." + fields_.phases[k].name + "." + std::to_string(c), booked_[k][c]);

  CellRows rows{1, {}, {}, 0, fields_.n_phases() - 1.0};
  for (const auto& [cell, k] : followers_) rows.add(cell, {static_cast<double>(k)});
  keeper.some_cells("followers", rows);
  if (keeper.reads()) {
    followers_.clear();
    for (std::size_t i = 0; i < rows.cells.size(); ++i)
      followers_.emplace_back(rows.cells[i], static_cast<int>(rows.values[i]));
  }
  caution_->keep(keeper, mesh_, step_);
  if (sharp_) sharp_->keep(keeper);
  if (reconstruction_) reconstruction_->keep(keeper);
  if (redistribution_) redistribution_->keep(keeper);
  if (exchange_) exchange_->keep(keeper);
}

/// Primitive states and Fields::pure follow from what is kept, up to rare leftovers of earlier steps: a fragment that
/// nothing has touched since it took a neighbour's state, what is left of a phase below zero. These are kept as well.
/// So are, of sharp interfaces, states of phases that have left a cell: where a third phase arrives they may be lent
/// on.
void Solver::keep_derived(Keeper& keeper) {
  for (int k = 0; k < fields_.n_phases(); ++k) {
    Phase& phase = fields_.phases[k];
    if (phase.is_void) continue;
    std::vector<AlignedVector<double>> present = phase.primitive;  // as the run has them
    for (auto& component : phase.primitive)
      for (std::int32_t cell = 0; cell < mesh_.n_owned && sharp_; ++cell)
        if (phase.alpha[cell] == 0 && !component.empty()) component[cell] = 0;
    derive_primitives(k);
    const auto n = static_cast<int>(phase.primitive.size());
    CellRows rows{n, {}, {}};
    for (std::int32_t cell = 0; cell < mesh_.n_owned && !keeper.reads(); ++cell) {
      bool same = true;
      for (int c = 0; c < n; ++c)
        same = same && (phase.primitive[c].empty() || same_bits(phase.primitive[c][cell], present[c][cell]));
      if (same) continue;
      rows.cells.push_back(cell);
      for (int c = 0; c < n; ++c) rows.values.push_back(present[c].empty() ? 0 : present[c][cell]);
    }
    keeper.some_cells("primitive." + phase.name, rows);
    if (!keeper.reads()) phase.primitive = std::move(present);
    for (std::size_t i = 0; i < rows.cells.size() && keeper.reads(); ++i)
      for (int c = 0; c < n; ++c)
        if (!phase.primitive[c].empty()) phase.primitive[c][rows.cells[i]] = rows.row(i)[c];
  }
  if (!fields_.multiphase()) return;
  const auto derived_pure = [&](std::int32_t cell) {
    int only = -1;
    for (int k = 0; k < fields_.n_phases(); ++k) {
      const double alpha = fields_.phases[k].alpha[cell];
      if (alpha == 0) continue;
      if (alpha != 1 || only >= 0) return -1;
      only = k;
    }
    return only;
  };
  CellRows rows{1, {}, {}, -1, fields_.n_phases() - 1.0};
  for (std::int32_t cell = 0; cell < mesh_.n_owned; ++cell) {
    const int pure = derived_pure(cell);
    if (keeper.reads())
      fields_.pure[cell] = pure;
    else if (fields_.pure[cell] != pure)
      rows.add(cell, {static_cast<double>(fields_.pure[cell])});
  }
  keeper.some_cells("pure", rows);
  for (std::size_t i = 0; i < rows.cells.size() && keeper.reads(); ++i)
    fields_.pure[rows.cells[i]] = static_cast<std::int32_t>(rows.values[i]);
}

/// From the conserved quantities of owned cells. What is not admissible gets what the formulas make of it.
void Solver::derive_primitives(int k) {
  Phase& phase = fields_.phases[k];
  scratch_cells_.clear();
  for (std::int32_t cell = 0; cell < mesh_.n_owned; ++cell)
    if (!fields_.multiphase() || phase.alpha[cell] != 0) scratch_cells_.push(cell);
  const std::int32_t count = scratch_cells_.size();
  scratch_cells_.fill(pack_width);
  bad_.clear();
  kernels_[k].primitives(phase, scratch_cells_, count, bad_);
}

void Caution::keep(Keeper& keeper, const Mesh& mesh, std::int64_t step) {
  CellRows rows{1, {}, {}, 0, 0x1p53};
  for (std::int32_t cell = 0; cell < mesh.n_owned; ++cell)
    if (until_[cell] > step) rows.add(cell, {static_cast<double>(until_[cell])});
  keeper.some_cells("caution", rows);
  keeper.whole_number("caution_until", until_any_);
  if (!keeper.reads()) return;
  std::ranges::fill(until_, 0);
  for (std::size_t i = 0; i < rows.cells.size(); ++i) until_[rows.cells[i]] = static_cast<std::int64_t>(rows.values[i]);
  tell_halo(mesh);
}

void SharpInterface::keep(Keeper& keeper) {
  std::int64_t settled = settled_;
  keeper.whole_number("planes_settled", settled);
  keeper.whole_number("planes_step", step_);
  settled_ = settled != 0;
  for (const int k : planes_of_) {
    CellRows normals{3, {}, {}, -1.1, 1.1};
    for (std::int32_t cell = 0; cell < mesh_.n_owned; ++cell)
      if (valid(k, cell) && !keeper.reads()) {
        const Point& n = cells_[k][cell].plane.n;
        normals.add(cell, {n.x, n.y, n.z});
      }
    keeper.some_cells("normals." + std::to_string(k), normals);
    for (std::size_t i = 0; i < normals.cells.size() && keeper.reads(); ++i) {
      Cell& cell = cells_[k][normals.cells[i]];
      cell.plane.n = {normals.row(i)[0], normals.row(i)[1], normals.row(i)[2]};
      cell.step = step_;
    }
  }
  CellRows cut_once{0, {}, {}};
  for (std::int32_t cell = 0; cell < mesh_.n_owned; ++cell)
    if (corners_at_[cell] >= 0) cut_once.cells.push_back(cell);
  keeper.some_cells("cut_once", cut_once);
  for (const std::int32_t cell : cut_once.cells) find_corners(cell);
}

void Reconstruction::keep(Keeper& keeper) {
  keeper.counter("reconstructed", reconstructed_);
  keeper.counter("fallen", fallen_);
}

void Redistribution::keep(Keeper& keeper) {
  keeper.counter("merged", counters_.merged);
  keeper.counter("mended", counters_.mended);
  keeper.counter("alone", counters_.alone);
  keeper.counter("apart", counters_.apart);
}

void VolumeExchange::keep(Keeper& keeper) {
  keeper.counter("exchanges", counters_.exchanges);
  keeper.counter("exchanges_kept", counters_.kept);
  keeper.counter("exchanges_dust", counters_.dust);
  CellRows volumes{1, {}, {}};
  for (std::size_t cell = 0; cell < volume_of_cell_.size(); ++cell)
    if (volume_of_cell_[cell] != 0) volumes.add(static_cast<std::int32_t>(cell), {volume_of_cell_[cell]});
  keeper.some_cells("exchanged_volume", volumes);
  std::ranges::fill(volume_of_cell_, 0);
  for (std::size_t i = 0; i < volumes.cells.size(); ++i) volume_of_cell_[volumes.cells[i]] = volumes.values[i];
}

}  // namespace cobasis
