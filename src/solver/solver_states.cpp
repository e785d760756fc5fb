// What a step leaves behind: primitive states, fragments, states that are not admissible; and the way back to before
// it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/solver.hpp"
#include "solver/splinter.hpp"
#include "solver/stopwatch.hpp"

namespace cobasis {
namespace {

/// Below this volume fraction an inadmissible state is given to a neighbour.
constexpr double fragment = 1e-2, fragment_of_sharp = 3e-2;
/// Contacts may take somewhat more of a phase from a cell than there is; neighbours give it back.
constexpr double most_negative = -3e-2;
/// With sharp interfaces a volume fraction below this has no state of its own, admissible or not: round-off of what a
/// step takes from it and gives it again may be more than it contains.
constexpr double without_state = 1e-6;

}  // namespace

void Solver::save() {
  std::size_t i = 0;
  const auto keep = [&](const AlignedVector<double>& values) {
    if (i == saved_.size()) saved_.emplace_back(mesh_.n_owned);
    std::copy_n(values.begin(), values.empty() ? 0 : mesh_.n_owned, saved_[i++].begin());
  };
  for (const Phase& phase : fields_.phases) {
    keep(phase.alpha);
    for (const auto& component : phase.conserved) keep(component);
  }
  saved_followers_ = followers_;
  saved_stable_step_ = stable_step_;
}

void Solver::restore() {
  std::size_t i = 0;
  const auto put_back = [&](AlignedVector<double>& values) {
    std::copy_n(saved_[i++].begin(), values.empty() ? 0 : mesh_.n_owned, values.begin());
  };
  for (Phase& phase : fields_.phases) {
    put_back(phase.alpha);
    for (auto& component : phase.conserved) put_back(component);
  }
  followers_ = saved_followers_;
  stable_step_ = saved_stable_step_;
  unphysical_.clear();
  troubled_ = false;
  convert_present();
  if (!fields_.multiphase()) return;
  scratch_cells_.clear();
  for (std::int32_t cell = 0; cell < mesh_.n_owned; ++cell) scratch_cells_.push(cell);
  scratch_cells_.fill(pack_width);
  fields_.complete(scratch_cells_, mesh_.n_owned);
}

/// Primitive states of what is in owned cells and was admissible at the end of a step.
void Solver::convert_present() {
  const Timed timed(clock_.kernels);
  for (int k = 0; k < fields_.n_phases(); ++k) {
    Phase& phase = fields_.phases[k];
    if (phase.is_void) continue;
    scratch_cells_.clear();
    for (std::int32_t cell = 0; cell < mesh_.n_owned; ++cell)
      if (!fields_.multiphase() || phase.alpha[cell] != 0) scratch_cells_.push(cell);
    const std::int32_t count = scratch_cells_.size();
    scratch_cells_.fill(pack_width);
    bad_.clear();
    kernels_[k].primitives(phase, scratch_cells_, count, bad_);
    if (!sharp_) continue;
    for (const std::int32_t cell : bad_)  // a follower that nothing has touched since
      if (std::find(followers_.begin(), followers_.end(), std::pair(cell, k)) == followers_.end())
        followers_.emplace_back(cell, k);
  }
}

/// The cells of the list that hold the phase; what fills up a list may come twice.
void Solver::choose_present(CellList& cells, const Phase& phase) {
  const Timed timed(clock_.kernels);
  scratch_cells_.clear();
  cells.fill(pack_width);
  for (std::int32_t i = 0; i < cells.size(); i += pack_width) {
    const Indices<Pack> at = load_indices<Pack>(&cells[i]);
    const unsigned here = positive_lanes(gather<Pack>(phase.alpha.data(), at));
    store_chosen(here, at, scratch_cells_.end());
    scratch_cells_.grow(std::popcount(here));
  }
}

void Solver::convert_owned(double dt) {
  const auto convert = [&](int k, CellList& cells) {
    const std::int32_t count = cells.size();
    cells.fill(pack_width);
    const Timed timed(clock_.kernels);
    kernels_[k].primitives(fields_.phases[k], cells, count, bad_);
  };
  if (!fields_.multiphase()) {
    bad_.clear();
    const Timed timed(clock_.kernels);
    kernels_[0].primitives(fields_.phases[0], material_cells_, material_count_, bad_);
    for (const std::int32_t cell : bad_) note_troubled(cell, 0);
    return;
  }

  std::vector<std::pair<std::int32_t, int>> inadmissible;
  for (int k = 0; k < fields_.n_phases(); ++k) {
    const Phase& phase = fields_.phases[k];
    if (phase.is_void) continue;
    choose_present(mixed_cells_[k], phase);
    bad_.clear();
    convert(k, pure_cells_[k]);
    convert(k, scratch_cells_);
    for (const std::int32_t cell : bad_) inadmissible.emplace_back(cell, k);
  }
  for (const std::int32_t cell : touched_cells_.span())
    for (int k = 0; k < fields_.n_phases(); ++k)
      if (!(fields_.phases[k].alpha[cell] > most_negative)) note_troubled(cell, k);
  if (mpi_.any(troubled_)) return;
  std::sort(inadmissible.begin(), inadmissible.end());
  inadmissible.erase(std::unique(inadmissible.begin(), inadmissible.end()), inadmissible.end());

  relax_splinters(inadmissible);
  // Between bodies the neighbour's state mends a cell better than caution does: a step with diffuse interfaces at an
  // impact leaves its mark for good. What tears before a void is not mended so.
  const bool tears = std::ranges::any_of(fields_.phases, [](const Phase& phase) { return phase.is_void; });
  if (attempt_ == 0 && tears) {
    for (const auto& [cell, k] : inadmissible)
      if (fields_.phases[k].alpha[cell] >= (sharp_ ? fragment_of_sharp : fragment)) note_troubled(cell, k);
    if (mpi_.any(troubled_)) return;
  }
  if (redistribution_) mend(inadmissible);
  relax_splinters(inadmissible);
  if (exchange_) {
    std::vector<std::pair<std::int32_t, int>> fragments;
    for (const auto& [cell, k] : inadmissible)
      if (fields_.phases[k].alpha[cell] < fragment) fragments.emplace_back(cell, k);
    VolumeExchange::Expected expected;
    if (sharp_) expected = [&](std::int32_t cell, int k) { return sharp_->expects(fields_, k, cell, dt); };
    const double kernels_before = exchange_->kernel_seconds();
    const std::vector<std::int32_t>& exchanged =
        exchange_->run(mesh_, faces_, fields_, dt, touched_cells_.span(), fragments, expected);
    clock_.kernels += exchange_->kernel_seconds() - kernels_before;
    std::vector<std::pair<std::int32_t, int>> remaining;
    for (const auto& entry : inadmissible)
      if (!std::binary_search(exchanged.begin(), exchanged.end(), entry.first)) remaining.push_back(entry);
    for (int k = 0; k < fields_.n_phases(); ++k) {
      if (fields_.phases[k].is_void) continue;
      scratch_cells_.clear();
      for (const std::int32_t cell : exchanged)
        if (fields_.phases[k].alpha[cell] > 0) scratch_cells_.push(cell);
      bad_.clear();
      convert(k, scratch_cells_);
      for (const std::int32_t cell : bad_) remaining.emplace_back(cell, k);
    }
    inadmissible = std::move(remaining);
    if (redistribution_) mend(inadmissible);  // what was exchanged may have been owed
  }
  followers_.clear();
  for (const auto& [cell, k] : inadmissible)
    if (sharp_ && fields_.phases[k].alpha[cell] < fragment_of_sharp)
      followers_.emplace_back(cell, k);
    else
      note_troubled(cell, k);
  followed_ += static_cast<std::int64_t>(followers_.size());
  if (!sharp_) return;
  for (const auto& [cell, k] : orphans_->find(mesh_, faces_, fields_, followers_, without_state))
    note_troubled(cell, k);
  // Of all cells, whether the step touched them or not: so do the ranks that see them as their halo.
  for (int k = 0; k < fields_.n_phases(); ++k) {
    if (fields_.phases[k].is_void) continue;
    const auto& alpha = fields_.phases[k].alpha;
    for (std::int32_t cell = 0; cell < mesh_.n_owned; ++cell)
      if (alpha[cell] > 0 && alpha[cell] < without_state) followers_.emplace_back(cell, k);
  }
  std::sort(followers_.begin(), followers_.end());
  followers_.erase(std::unique(followers_.begin(), followers_.end()), followers_.end());
}

/// Of bad_, and of what is always one.
void Solver::add_halo_followers(int k) {
  const auto& alpha = fields_.phases[k].alpha;
  for (const std::int32_t cell : bad_)
    if (alpha[cell] < fragment_of_sharp && alpha[cell] >= without_state) followers_.emplace_back(cell, k);
  for (std::int32_t cell = mesh_.n_owned; cell < mesh_.n_cells(); ++cell)
    if (alpha[cell] > 0 && alpha[cell] < without_state) followers_.emplace_back(cell, k);
}

/// The index of the void; -1: there is none.
int Solver::find_void() const {
  for (int k = 0; k < fields_.n_phases(); ++k)
    if (fields_.phases[k].is_void) return k;
  return -1;
}

/// Phases that share a cell exchange momentum and volume, pair by pair, after all else that the step does to them.
void Solver::relax_pairs(double dt) {
  for (const RelaxedPair& pair : relaxed_pairs_)
    for (const std::int32_t cell : touched_cells_.span()) relax(fields_, pair, cell, dt);
}

/// Dust before a void has the void's pressure, about.
void Solver::relax_dust() {
  constexpr double tolerance = 0.1;
  const int void_phase = find_void();
  if (void_phase < 0) return;
  for (int k = 0; k < fields_.n_phases(); ++k) {
    if (k == void_phase) continue;
    const auto& alpha = fields_.phases[k].alpha;
    for (const std::int32_t cell : touched_cells_.span())
      if (alpha[cell] > 0 && alpha[cell] < largest_dust)
        torn_ += relax_to_void(fields_, k, void_phase, cell, tolerance);
  }
}

/// Before a void: see relax_to_void.
void Solver::relax_splinters(std::vector<std::pair<std::int32_t, int>>& inadmissible) {
  const int void_phase = find_void();
  if (void_phase < 0) return;
  const auto relaxed = [&](const std::pair<std::int32_t, int>& splinter) {
    const auto [cell, k] = splinter;
    if (fields_.phases[k].alpha[cell] > largest_splinter || !relax_to_void(fields_, k, void_phase, cell)) return false;
    scratch_cells_.clear();
    scratch_cells_.push(cell);
    scratch_cells_.fill(pack_width);
    bad_.clear();
    kernels_[k].primitives(fields_.phases[k], scratch_cells_, 1, bad_);
    ++torn_;
    return bad_.empty();
  };
  inadmissible.erase(std::remove_if(inadmissible.begin(), inadmissible.end(), relaxed), inadmissible.end());
}

/// Averages what is not admissible with neighbours until it is; what cannot be mended stays in the list.
void Solver::mend(std::vector<std::pair<std::int32_t, int>>& inadmissible) {
  constexpr int most_passes = 16;
  for (int pass = 0; pass < most_passes && mpi_.any(!inadmissible.empty()); ++pass) {
    redistribution_->mend(mesh_, faces_, fields_, inadmissible);
    std::vector<std::pair<std::int32_t, int>> changed = redistribution_->changed(), remaining;
    std::sort(changed.begin(), changed.end());
    for (const auto& volume : inadmissible)
      if (!std::binary_search(changed.begin(), changed.end(), volume)) remaining.push_back(volume);
    for (int k = 0; k < fields_.n_phases(); ++k) {
      if (fields_.phases[k].is_void) continue;
      scratch_cells_.clear();
      for (const auto& [cell, phase] : changed)
        if (phase == k && fields_.phases[k].alpha[cell] > 0) scratch_cells_.push(cell);
      const std::int32_t count = scratch_cells_.size();
      scratch_cells_.fill(pack_width);
      bad_.clear();
      kernels_[k].primitives(fields_.phases[k], scratch_cells_, count, bad_);
      for (const std::int32_t cell : bad_) remaining.emplace_back(cell, k);
    }
    std::sort(remaining.begin(), remaining.end());
    inadmissible = std::move(remaining);
  }
}

void Solver::note_troubled(std::int32_t cell, int k) {
  troubled_ = true;
  caution_->note(cell);
  note_unphysical(k, cell);
}

void Solver::note_unphysical(int k, std::int32_t cell) {
  if (!unphysical_.empty() && unphysical_id_ <= mesh_.global_id[cell]) return;
  unphysical_id_ = mesh_.global_id[cell];
  const Phase& phase = fields_.phases[k];
  const Point x = mesh_.centroid[cell];
  const double alpha = phase.alpha.empty() ? 1 : phase.alpha[cell];
  unphysical_ = fmt::format(
      "step {}, time {:.9g} s: phase '{}' left its admissible states in cell {} at ({:.6g}, {:.6g}, {:.6g}): volume "
      "fraction {:.6g}",
      step_, time_, phase.name, unphysical_id_, x.x, x.y, x.z, alpha);
  if (phase.is_void) return;
  unphysical_ += fmt::format(", density {:.6g} kg/m^3, pressure {:.6g} Pa", phase.density()[cell],
                             phase.primitive[1 + fields_.dimension][cell]);
  if (phase.kind == Kind::solid) {
    std::string e;
    for (int c = fields_.first_cobasis(); c < phase.n_conserved(); ++c)
      e += fmt::format("{}{:.6g}", e.empty() ? "" : " ", phase.conserved[c][cell]);
    unphysical_ += fmt::format(", cobasis ({})", e);
  }
}

/// Of the length of a step: names the phase that has most of the cell.
void Solver::blame(std::int32_t cell, const std::string& why) {
  int largest = -1;
  for (int k = 0; k < fields_.n_phases(); ++k)
    if (!fields_.phases[k].is_void &&
        (largest < 0 || fields_.phases[k].alpha[cell] > fields_.phases[largest].alpha[cell]))
      largest = k;
  note_troubled(cell, largest);
  unphysical_ += "; " + why;
}

/// A wave speed that is not a finite number, because of a state in the cell or beside it.
void Solver::find_undefined_speed() {
  for (std::int32_t i = 0; i < material_count_; ++i) {
    const std::int32_t cell = material_cells_[i];
    for (int j = 0; j < faces_.max_cell_faces; ++j) {
      const std::int32_t face = faces_.cell_faces[static_cast<std::size_t>(j) * faces_.cell_stride + cell] >> 1;
      if (!std::isfinite(faces_.fastest[face])) return blame(cell, "a wave speed is not a finite number");
    }
  }
}

/// Whether no machine would take all the steps that are left at this pace, and the case sets no number of them.
bool Solver::creeps() const {
  constexpr double most_steps = 1e10;
  return !setup_.max_steps && setup_.cfl * stable_step_ * most_steps < setup_.end_time;
}

/// The cell that makes the step so small, on the rank that has it.
void Solver::find_slowest() {
  for (std::int32_t i = 0; i < material_count_; ++i) {
    CellList cell(pack_width);
    cell.push(material_cells_[i]);
    cell.fill(pack_width);
    if (largest_step<double>(faces_, fields_.volume, cell, 1) <= (1 + 1e-9) * stable_step_)
      return blame(material_cells_[i], fmt::format("waves or flow this fast allow steps of {:.3g} s", stable_step_));
  }
  troubled_ = true;
}

/// The same on all ranks. Collective.
std::string Solver::unphysical_report() const {
  const bool own = !unphysical_.empty();
  const double first = mpi_.min(own ? static_cast<double>(unphysical_id_) : infinity);
  const bool speaks = own && static_cast<double>(unphysical_id_) == first;
  const int speaker = static_cast<int>(mpi_.max(speaks ? mpi_.rank() : -1));
  std::string text = unphysical_;
  if (speaker != 0) {
    if (mpi_.rank() == speaker) mpi_.send(0, std::vector<char>(text.begin(), text.end()));
    if (mpi_.root()) {
      const std::vector<char> bytes = mpi_.receive(speaker);
      text.assign(bytes.begin(), bytes.end());
    }
  }
  mpi_.broadcast(text);
  return text;
}

}  // namespace cobasis
