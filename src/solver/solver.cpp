#include "solver/solver.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "solver/gravity.hpp"
#include "solver/stopwatch.hpp"

namespace cobasis {
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
    const bool over = attempt_ + 1 == most_attempts;
    const std::string report = over ? unphysical_report() : std::string();
    restore();
    if (over) throw Unphysical(report);
    ++redone_;
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
  if (creeps()) return find_slowest();
  if (sharp_) sharp_->act(faces_, fields_, touched_cells_.span());
  update_cells(dt);
  if (falls) accelerate(fields_, (dt - fallen) * setup_.gravity);
  relax_pairs(dt);
  relax_dust();
  if (redistribution_) redistribution_->run(mesh_, faces_, fields_, touched_cells_.span());
  last_dt_ = dt;
  convert_owned(dt);
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
    const auto inside = [&] {
      const Timed timed(clock_.kernels);
      if (second) reconstruction_->run_inside(fields_, faces_, options);
    };
    if (!sharp_) inside();
    if (first) {
      receive_halo();
      if (sharp_) sharp_->place(faces_, fields_, followers_);
    }
    if (sharp_) {
      sharp_->wet(faces_, fields_, options.dt);
      inside();
    }
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

/// Calls with(number) for what neighbours must know of a cell.
template <class With>
void Solver::visit_state(std::int32_t cell, const With& with) {
  if (fields_.multiphase())
    for (Phase& phase : fields_.phases) with(phase.alpha[cell]);
  for (Phase& phase : fields_.phases)
    if (!fields_.multiphase() || phase.alpha[cell] > 0)
      for (auto& component : phase.conserved) with(component[cell]);
}

void Solver::send_halo() {
  if (options_.before_halo_send) options_.before_halo_send();
  send_cells(*halo_, mesh_.neighbours, [&](std::int32_t cell, const auto& with) { visit_state(cell, with); });
}

void Solver::receive_halo() {
  receive_cells(*halo_, mesh_.neighbours, [&](std::int32_t cell, const auto& with) { visit_state(cell, with); });
  if (mesh_.neighbours.empty()) return;
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
    if (sharp_) add_halo_followers(k);
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

}  // namespace cobasis
