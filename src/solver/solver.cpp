#include "solver/solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "math/errors.hpp"
#include "solver/gravity.hpp"
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

/// A step after which a state is not admissible is taken again, with caution around that cell, and then smaller.
double Solver::advance(double until) {
  constexpr int most_attempts = 6;
  const double start = seconds();
  clock_.step_start = start;
  save();
  for (attempt_ = 0;; ++attempt_) {
    caution_->tell(fields_, step_);
    take_step(until);
    if (!mpi_.any(troubled_)) break;
    if (attempt_ + 1 == most_attempts) stop_unphysical();
    ++redone_;
    restore();
    caution_->spread(mesh_, step_, attempt_ + 1);
  }
  book_boundaries(last_dt_);
  time_ = last_dt_ >= until - time_ ? until : time_ + last_dt_;
  ++step_;
  clock_.total += seconds() - start;
  return last_dt_;
}

/// Changes the state, and troubled_ where that failed.
void Solver::take_step(double until) {
  const bool falls = dot(setup_.gravity, setup_.gravity) > 0;
  double fallen = 0;  // [s]; the length of the step is not known yet, but that of the one before is
  if (falls && stable_step_ > 0) {
    fallen = 0.5 * step_to(until, stable_step_);
    accelerate(fields_, fallen * setup_.gravity);
    convert_present();
  }
  send_halo();
  double dt;
  if (setup_.scheme.order == 1 && !sharp_) {
    stable_step_ = sweep_first_order();
    dt = step_to(until, stable_step_);
  } else {
    dt = sweep_centred(until);
  }
  if (dt == 0) return;
  if (sharp_) sharp_->act(faces_, fields_, touched_cells_.span());
  update_cells(dt);
  if (falls) accelerate(fields_, (dt - fallen) * setup_.gravity);
  relax_dust();
  if (redistribution_) redistribution_->run(mesh_, faces_, fields_, touched_cells_.span());
  last_dt_ = dt;
  convert_owned(dt);
}

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

/// The step at the case's CFL number, not beyond `until`; halved from the third attempt on.
double Solver::step_to(double until, double stable_step) const {
  const double step = std::ldexp(setup_.cfl * stable_step, std::min(0, 1 - attempt_));
  return time_ + step < until ? step : until - time_;
}

/// All faces, with the states of their cells. Returns the step at CFL 1.
double Solver::sweep_first_order() {
  begin_sweeps();
  sweep(Part::inside);
  sweep(Part::mirror);
  sweep(Part::prescribed);
  clock_.inside_swept = seconds() - clock_.step_start;
  receive_halo();
  clock_.halo_received = seconds() - clock_.step_start;
  sweep(Part::halo);
  return stable_step();
}

/// All faces, with states and wetted fractions at the middle of the step, whose length must therefore be known before:
/// it follows from the signals of the sweep before, and if they have become so much faster meanwhile that it is too
/// long, the sweep is done again. Returns the step.
double Solver::sweep_centred(double until) {
  constexpr double margin = 1.1;  // the CFL number may be exceeded by so much
  const bool second = setup_.scheme.order == 2;
  ReconstructionOptions options{.dt = stable_step_ > 0 ? step_to(until, stable_step_) : 0,
                                .limited = setup_.scheme.limited,
                                .rings = fields_.rings_or_null()};
  for (bool first = true;; first = false) {
    if (second) {
      const Timed timed(clock_.kernels);
      reconstruction_->run_inside(fields_, faces_, options);
    }
    if (first) {
      receive_halo();
      if (sharp_) sharp_->place(faces_, fields_, followers_);
    }
    if (sharp_) sharp_->wet(faces_, fields_, options.dt);
    if (second) {
      const Timed timed(clock_.kernels);
      reconstruction_->run_beside_halo(mesh_, fields_, faces_, options);
      reconstruction_->send(mesh_, fields_);
    }
    begin_sweeps();
    sweep(Part::inside);
    sweep(Part::mirror);
    sweep(Part::prescribed);
    clock_.inside_swept = seconds() - clock_.step_start;
    if (second) reconstruction_->receive(mesh_, fields_);
    clock_.halo_received = seconds() - clock_.step_start;
    sweep(Part::halo);
    stable_step_ = stable_step();
    if (stable_step_ == 0) return 0;
    if (options.dt > 0 && options.dt <= margin * setup_.cfl * stable_step_) return options.dt;
    options.dt = step_to(until, stable_step_);
  }
}

void Solver::begin_sweeps() {
  if (fields_.multiphase())
    interfaces_->clear(fields_);
  else
    std::fill(faces_.fastest.begin(), faces_.fastest.end(), 0.0);
}

/// 2 V / sum A lambda of the sweeps just done, smallest over all cells of all ranks; 0 where a wave speed is not a
/// finite number.
double Solver::stable_step() {
  if (fields_.multiphase()) list_cells();
  double step;
  {
    const Timed timed(clock_.kernels);
    step = options_.scalar ? largest_step<double>(faces_, fields_.volume, material_cells_, material_count_)
                           : largest_step<Pack>(faces_, fields_.volume, material_cells_, material_count_);
  }
  if (step == 0) find_undefined_speed();
  return mpi_.min(step);
}

void Solver::sweep(Part part) {
  if (part == Part::prescribed && faces_.prescribed.outlet.empty()) return;
  const Timed timed(clock_.kernels), timed_sweep(clock_.sweeps);
  if (fields_.multiphase()) {
    interfaces_->sort(faces_, fields_, part);
    interfaces_->find_contacts(faces_, fields_, part);
  }
  const int n = fields_.n_phases();
  for (int k = 0; k < n; ++k) {
    Phase& phase = fields_.phases[k];
    if (phase.is_void) continue;
    const PhaseKernels& of = kernels_[k];
    const auto pure = part == Part::mirror       ? of.sweep_pure_mirror
                      : part == Part::prescribed ? of.sweep_pure_prescribed
                                                 : of.sweep_pure;
    const auto mixed = part == Part::mirror       ? of.sweep_mixed_mirror
                       : part == Part::prescribed ? of.sweep_mixed_prescribed
                                                  : of.sweep_mixed;
    pure(faces_, phase, interfaces_->pure(k, part));
    if (fields_.multiphase()) mixed(faces_, phase, interfaces_->mixed(k, part));
  }
  for (int l = 0; l < n; ++l) {
    for (int m = 0; m < n; ++m) {
      const Segment segment = interfaces_->pair_segment(l, m, part);
      if (l == m || segment.first == segment.last) continue;
      const PairList& list = interfaces_->pair(l, m);
      Phase& left = fields_.phases[l];
      Phase& right = fields_.phases[m];
      if (right.is_void)
        kernels_[l].sweep_free_surface(faces_, left, right.void_pressure, list, segment);
      else if (left.is_void)
        kernels_[m].sweep_free_surface(faces_, right, left.void_pressure, list, segment);
      else
        pair_kernels_[l * n + m].sweep(faces_, left, right, list, segment);
    }
  }
}

void Solver::send_halo() {
  for (std::size_t i = 0; i < mesh_.neighbours.size(); ++i) {
    std::vector<double>& out = halo_->outgoing(i);
    out.clear();
    for (const std::int32_t cell : mesh_.neighbours[i].send) {
      if (fields_.multiphase())
        for (const Phase& phase : fields_.phases) out.push_back(phase.alpha[cell]);
      for (const Phase& phase : fields_.phases)
        if (!fields_.multiphase() || phase.alpha[cell] > 0)
          for (const auto& component : phase.conserved) out.push_back(component[cell]);
    }
  }
  if (options_.before_halo_send) options_.before_halo_send();
  halo_->start();
}

void Solver::receive_halo() {
  halo_->finish();
  if (mesh_.neighbours.empty()) return;
  for (std::size_t i = 0; i < mesh_.neighbours.size(); ++i) {
    const Neighbour& neighbour = mesh_.neighbours[i];
    const double* in = halo_->incoming(i).data();
    for (std::int32_t j = 0; j < neighbour.receive_count; ++j) {
      const std::int32_t cell = neighbour.receive_first + j;
      if (fields_.multiphase())
        for (Phase& phase : fields_.phases) phase.alpha[cell] = *in++;
      for (Phase& phase : fields_.phases)
        if (!fields_.multiphase() || phase.alpha[cell] > 0)
          for (auto& component : phase.conserved) component[cell] = *in++;
    }
  }
  if (fields_.multiphase()) {
    scratch_cells_.clear();
    for (std::int32_t cell = mesh_.n_owned; cell < mesh_.n_cells(); ++cell) scratch_cells_.push(cell);
    scratch_cells_.fill(pack_width);
    fields_.complete(scratch_cells_, mesh_.n_halo);
  }
  for (int k = 0; k < fields_.n_phases(); ++k) {
    Phase& phase = fields_.phases[k];
    if (phase.is_void) continue;
    scratch_cells_.clear();
    for (std::int32_t cell = mesh_.n_owned; cell < mesh_.n_cells(); ++cell)
      if (!fields_.multiphase() || phase.alpha[cell] > 0) scratch_cells_.push(cell);
    const std::int32_t count = scratch_cells_.size();
    scratch_cells_.fill(pack_width);
    const Timed timed(clock_.kernels);
    bad_.clear();  // the owner reports
    kernels_[k].primitives(phase, scratch_cells_, count, bad_);
    if (!sharp_) continue;
    for (const std::int32_t cell : bad_)
      if (phase.alpha[cell] < fragment_of_sharp && phase.alpha[cell] >= without_state) followers_.emplace_back(cell, k);
    for (std::int32_t cell = mesh_.n_owned; cell < mesh_.n_cells(); ++cell)
      if (phase.alpha[cell] > 0 && phase.alpha[cell] < without_state) followers_.emplace_back(cell, k);
  }
}

/// Which cells each phase is updated in: those inside the phase, and those where anything else is near.
COBASIS_KERNEL void Solver::list_cells() {
  const Timed timed(clock_.kernels);
  const int n = fields_.n_phases();
  int the_void = -2;
  for (int k = 0; k < n; ++k) {
    pure_cells_[k].clear();
    mixed_cells_[k].clear();
    if (fields_.phases[k].is_void) the_void = k;
  }
  touched_cells_.clear();
  material_cells_.clear();
  const auto same = [](int value) {
    Indices<Pack> all;
    all.fill(value);
    return all;
  };
  const auto choose = [](CellList& list, unsigned bits, const Indices<Pack>& at) {
    store_chosen(bits, at, list.end());
    list.grow(std::popcount(bits));
  };
  for (std::int32_t first = 0; first < mesh_.n_owned; first += pack_width) {
    const std::int32_t count = std::min(pack_width, mesh_.n_owned - first);
    const unsigned valid = (1u << count) - 1;
    const Indices<Pack> pure = load_indices<Pack>(&fields_.pure[first]),
                        acting = load_indices<Pack>(&interfaces_->acting()[first]);
    const unsigned touched = ~equal_lanes(acting, same(0)) & valid;
    const unsigned material = touched | (~equal_lanes(pure, same(the_void)) & valid);
    if (material == 0) continue;
    Indices<Pack> at;
    for (int i = 0; i < pack_width; ++i) at[i] = first + i;
    choose(touched_cells_, touched, at);
    choose(material_cells_, material, at);
    for (int k = 0; k < n; ++k) {
      if (k == the_void) continue;
      choose(pure_cells_[k], equal_lanes(pure, same(k)) & ~touched & valid, at);
      Indices<Pack> acts;
      for (int i = 0; i < pack_width; ++i) acts[i] = acting[i] & (1 << k);
      // a phase may fill a cell that only others touch
      const Pack alpha = load<Pack>(&fields_.phases[k].alpha[first]);
      const unsigned present = positive_lanes(alpha) | positive_lanes(-alpha);
      choose(mixed_cells_[k], (~equal_lanes(acts, same(0)) | present) & touched, at);
    }
  }
  material_count_ = material_cells_.size();
  material_cells_.fill(pack_width);
}

void Solver::update_cells(double dt) {
  const Timed timed(clock_.kernels);
  const double centring = setup_.scheme.order == 2 ? 0.5 : 0;
  for (int k = 0; k < fields_.n_phases(); ++k) {
    Phase& phase = fields_.phases[k];
    if (phase.is_void) continue;
    if (fields_.rings && setup_.scheme.order == 2) {  // the state of fragments was borrowed after slopes were found
      scratch_cells_.clear();
      for (const auto& [cell, follower] : followers_)
        if (follower == k && cell < mesh_.n_owned) scratch_cells_.push(cell);
      const std::int32_t count = scratch_cells_.size();
      scratch_cells_.fill(pack_width);
      kernels_[k].hoop_of_cells(phase, *fields_.rings, scratch_cells_, count);
    }
    for (const bool mixed : {false, true}) {
      CellList& cells = mixed ? mixed_cells_[k] : pure_cells_[k];
      const std::int32_t count = fields_.multiphase() ? cells.size() : mixed ? 0 : mesh_.n_owned;
      cells.fill(pack_width);
      if (fields_.rings && setup_.scheme.order == 1) kernels_[k].hoop_of_cells(phase, *fields_.rings, cells, count);
      (mixed ? kernels_[k].update_mixed : kernels_[k].update_pure)(faces_, fields_.volume, fields_.rings_or_null(),
                                                                   phase, cells, count, dt, mixed ? 0 : centring);
    }
  }
  if (!fields_.multiphase()) return;
  const std::int32_t touched = touched_cells_.size();
  touched_cells_.fill(pack_width);
  fields_.complete(touched_cells_, touched);
  touched_cells_.cut(touched);
}

void Solver::book_boundaries(double dt) {
  const int D = fields_.dimension;
  const std::int32_t first_mixed = first_mixed_slot(faces_);
  for (int k = 0; k < fields_.n_phases(); ++k) {
    const Phase& phase = fields_.phases[k];
    if (phase.is_void) continue;
    const PhaseKernels& kernels = kernels_[k];
    const std::int32_t* const slots = &phase.lists.slot_of_face[mesh_.first_boundary_face()];
    for (std::int32_t i = 0; i < mesh_.n_boundary_faces; ++i) {
      const std::int32_t slot = slots[i];
      if (slot == 0) continue;
      const double* flux = phase.flux.data() + slot_base(slot, kernels.n_flux);
      for (int c = 0; c < D + 2; ++c) booked_[k][c][i] += dt * flux[c * pack_width];
      if (slot < first_mixed) continue;
      const double* gain = phase.gain.data() + slot_base(gain_slot(slot, first_mixed), kernels.n_gain);
      for (int c = 0; c < D + 2; ++c) booked_[k][c][i] -= dt * gain[c * pack_width];
    }
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
  }
  followers_.clear();
  for (const auto& [cell, k] : inadmissible)
    if (sharp_ && fields_.phases[k].alpha[cell] < fragment_of_sharp)
      followers_.emplace_back(cell, k);
    else
      note_troubled(cell, k);
  followed_ += static_cast<std::int64_t>(followers_.size());
  if (!sharp_) return;
  for (int k = 0; k < fields_.n_phases(); ++k)
    for (const std::int32_t cell : touched_cells_.span())
      if (!fields_.phases[k].is_void && fields_.phases[k].alpha[cell] > 0 &&
          fields_.phases[k].alpha[cell] < without_state)
        followers_.emplace_back(cell, k);
  std::sort(followers_.begin(), followers_.end());
  followers_.erase(std::unique(followers_.begin(), followers_.end()), followers_.end());
}

/// The index of the void; -1: there is none.
int Solver::find_void() const {
  for (int k = 0; k < fields_.n_phases(); ++k)
    if (fields_.phases[k].is_void) return k;
  return -1;
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
      if (alpha[cell] > 0 && alpha[cell] < dust) torn_ += relax_to_void(fields_, k, void_phase, cell, tolerance);
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
  constexpr int most_passes = 4;
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
      "fraction {:.6g}, density {:.6g} kg/m^3, pressure {:.6g} Pa",
      step_, time_, phase.name, unphysical_id_, x.x, x.y, x.z, alpha, phase.density()[cell],
      phase.primitive[1 + fields_.dimension][cell]);
  if (phase.kind == Kind::solid) {
    std::string e;
    for (int c = fields_.first_cobasis(); c < phase.n_conserved(); ++c)
      e += fmt::format("{}{:.6g}", e.empty() ? "" : " ", phase.conserved[c][cell]);
    unphysical_ += fmt::format(", cobasis ({})", e);
  }
}

/// A wave speed that is not a finite number: names the phase whose state in the cell, or beside it, makes it so.
void Solver::find_undefined_speed() {
  for (std::int32_t i = 0; i < material_count_; ++i) {
    const std::int32_t cell = material_cells_[i];
    for (int j = 0; j < faces_.max_cell_faces; ++j) {
      const std::int32_t face = faces_.cell_faces[static_cast<std::size_t>(j) * faces_.cell_stride + cell] >> 1;
      if (std::isfinite(faces_.fastest[face])) continue;
      int largest = -1;
      for (int k = 0; k < fields_.n_phases(); ++k)
        if (!fields_.phases[k].is_void &&
            (largest < 0 || fields_.phases[k].alpha[cell] > fields_.phases[largest].alpha[cell]))
          largest = k;
      note_troubled(cell, largest);
      unphysical_ += "; a wave speed is not a finite number";
      return;
    }
  }
}

void Solver::stop_unphysical() const {
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
  throw Unphysical(text);
}

}  // namespace cobasis
