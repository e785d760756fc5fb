#include "solver/redistribution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/cell_energy.hpp"

namespace cobasis {
namespace {

constexpr double small_fraction = 0.55;  ///< below this volume fraction a phase is averaged
/// A negative volume may take away so much of the neighbour's share that their mean means nothing. The sum of both must
/// exceed this part of the sum of magnitudes: then the mean leaves the range of the two states by half their difference
/// at most.
constexpr double least_sum = 0.5;

/// A pair: the position of its cell among those sent, of the donor among those received, k.
constexpr int choice_size = 3;

std::vector<std::size_t> capacities(const Mesh& mesh, std::size_t per_received, std::size_t per_sent) {
  std::vector<std::size_t> values;
  for (const Neighbour& n : mesh.neighbours)
    values.push_back(per_received * n.receive_count + per_sent * n.send.size());
  return values;
}

std::size_t most_conserved(const Fields& fields) {
  int most = 0;
  for (const Phase& phase : fields.phases) most = std::max(most, phase.n_conserved());
  return most;
}

/// The cell on the other side of face f of an owned cell's list; -1 where there is none.
std::int32_t neighbour_at(const Mesh& mesh, const Faces& faces, std::int32_t cell, int f) {
  const std::int32_t entry = faces.cell_faces[static_cast<std::size_t>(f) * faces.cell_stride + cell];
  const std::int32_t face = entry >> 1;
  if (face >= mesh.first_boundary_face()) return -1;
  const std::int32_t other = entry & 1 ? faces.left[face] : faces.right[face];
  return other == cell ? -1 : other;
}

}  // namespace

Redistribution::Redistribution(const Mpi& mpi, const Mesh& mesh, const Fields& fields)
    : mpi_(mpi),
      remote_(mpi, mesh, fields),
      alpha_(mpi, mesh.neighbours, capacities(mesh, fields.n_phases(), 0), 16),
      choices_(mpi, mesh.neighbours, capacities(mesh, choice_size * fields.n_phases(), 0), 17),
      shares_(mpi, mesh.neighbours,
              capacities(mesh, fields.n_phases() * (1 + 2 * most_conserved(fields)),
                         fields.n_phases() * (1 + 2 * most_conserved(fields))),
              18),
      neighbour_of_halo_(mesh.n_halo),
      asked_(mesh.neighbours.size()),
      received_(mesh.neighbours.size()),
      members_(fields.n_phases()) {
  // Room for every cell at once, so that no step allocates; memory that stays untouched costs nothing.
  pairs_.reserve(mesh.n_cells() + 1);
  second_.reserve(mesh.n_cells() + 1);
  changed_.reserve(2 * (mesh.n_owned + 1));
  for (std::size_t n = 0; n < mesh.neighbours.size(); ++n) {
    const Neighbour& neighbour = mesh.neighbours[n];
    std::fill_n(neighbour_of_halo_.begin() + (neighbour.receive_first - mesh.n_owned), neighbour.receive_count,
                static_cast<std::int32_t>(n));
    asked_[n].reserve(fields.n_phases() * neighbour.send.size());
  }
  for (int k = 0; k < fields.n_phases(); ++k) {
    if (fields.phases[k].is_void) continue;
    members_[k].pair_of.assign(mesh.n_cells(), -1);
    members_[k].chosen.assign(mesh.n_owned, 0);
  }
}

/// The pairs about owned cells.
bool Redistribution::choose(const Mesh& mesh, const Faces& faces, const Fields& fields, int k, std::int32_t cell,
                            double more_than) {
  const Phase& phase = fields.phases[k];
  std::int32_t donor = -1;
  double most = more_than;
  for (int f = 0; f < faces.max_cell_faces; ++f) {
    const std::int32_t other = neighbour_at(mesh, faces, cell, f);
    if (other < 0) continue;
    const double there = phase.alpha[other];
    if (there > most || (donor >= 0 && there == most && mesh.global_id[other] < mesh.global_id[donor]))
      donor = other, most = there;
  }
  if (donor >= 0) pairs_.push_back({cell, donor, k});
  return donor >= 0;
}

/// Appends the pairs about halo cells whose donor is owned.
void Redistribution::share_choices(const Mesh& mesh) {
  for (std::size_t n = 0; n < mesh.neighbours.size(); ++n) {
    choices_.outgoing(n).clear();
    asked_[n].clear();
  }
  for (std::size_t i = 0; i < n_own_pairs_; ++i) {
    const Pair& pair = pairs_[i];
    if (pair.donor < mesh.n_owned) continue;
    const std::int32_t n = neighbour_of_halo_[pair.donor - mesh.n_owned];
    const Neighbour& neighbour = mesh.neighbours[n];
    const auto own = std::lower_bound(neighbour.send.begin(), neighbour.send.end(), pair.cell) - neighbour.send.begin();
    for (const double value : {static_cast<double>(own), static_cast<double>(pair.donor - neighbour.receive_first),
                               static_cast<double>(pair.k)})
      choices_.outgoing(n).push_back(value);
    asked_[n].push_back(static_cast<std::int32_t>(i));
  }
  choices_.start();
  choices_.finish();
  for (std::size_t n = 0; n < mesh.neighbours.size(); ++n) {
    const std::span<const double> in = choices_.incoming(n);
    const Neighbour& neighbour = mesh.neighbours[n];
    received_[n].first = static_cast<std::int32_t>(pairs_.size());
    for (std::size_t at = 0; at < in.size(); at += choice_size)
      pairs_.push_back({neighbour.receive_first + static_cast<std::int32_t>(in[at]),
                        neighbour.send[static_cast<std::size_t>(in[at + 1])], static_cast<int>(in[at + 2])});
    received_[n].second = static_cast<std::int32_t>(pairs_.size());
  }
}

/// What part of the donor the neighbourhood of a small volume needs, to be as large as `target` cells. Around a
/// corner of simplices many volumes are small alike and each other's partners: there all that can be lent is needed.
void Redistribution::lend(const Mesh& mesh, const Fields& fields, Pair& pair, double target) const {
  const CellType type = mesh.cell_type[pair.cell];
  if (type == CellType::triangle || type == CellType::tetrahedron) target = std::numeric_limits<double>::infinity();
  const auto& alpha = fields.phases[pair.k].alpha;
  const double most = 1.0 / (1 + members_[pair.k].chosen[pair.donor]);
  const double missing = (target - alpha[pair.cell]) * fields.volume[pair.cell];
  pair.lent = std::min(most, missing / (alpha[pair.donor] * fields.volume[pair.donor]));
}

/// Visits the pairs to which an owned cell lends, in the order of its faces.
template <class Visit>
void Redistribution::for_each_taker(const Mesh& mesh, const Faces& faces, int k, std::int32_t cell,
                                    const Visit& visit) const {
  const Members& members = members_[k];
  int count = 0;
  for (int f = 0; f < faces.max_cell_faces && count < members.chosen[cell]; ++f) {
    const std::int32_t other = neighbour_at(mesh, faces, cell, f);
    if (other < 0) continue;
    const std::int32_t pair = members.pair_of[other];
    if (pair < 0 || pairs_[pair].donor != cell) continue;
    bool again = false;  // two faces can join the same cells through a periodic pair
    for (int g = 0; g < f; ++g) again = again || neighbour_at(mesh, faces, cell, g) == other;
    if (again) continue;
    visit(pairs_[pair]);
    ++count;
  }
}

/// What an owned cell does not lend.
double Redistribution::kept(const Mesh& mesh, const Faces& faces, int k, std::int32_t cell) const {
  double part = 1;
  for_each_taker(mesh, faces, k, cell, [&](const Pair& pair) { part -= pair.lent; });
  return part;
}

Redistribution::Share Redistribution::share_of(const Fields& fields, int k, std::int32_t cell, double fraction) const {
  const Phase& phase = fields.phases[k];
  const double part = fields.volume[cell] * fraction, volume = phase.alpha[cell] * part;
  Share share;
  share.volume = volume;
  for (int c = 0; c < phase.n_conserved(); ++c)
    share.content[c] = phase.conserved[c][cell] * (c < fields.first_cobasis() ? part : volume);
  return share;
}

/// From the donor's part of the phase to the cell's; to the part of their face where the cell had none before the step.
std::array<double, 3> Redistribution::between(const Mesh& mesh, const Faces& faces, const Fields& fields,
                                              const Pair& pair) const {
  const Phase& phase = fields.phases[pair.k];
  const auto part_of = [&](std::int32_t cell) {
    std::array<double, 3> at{};
    for (int d = 0; d < fields.dimension; ++d) at[d] = phase.centre.component(d)[cell];
    return at;
  };
  const std::array<double, 3> from = part_of(pair.donor), in_cell = part_of(pair.cell);
  std::array<double, 3> delta{};
  for (int f = 0; f < faces.max_cell_faces; ++f) {
    if (neighbour_at(mesh, faces, pair.donor, f) != pair.cell) continue;
    const std::int32_t entry = faces.cell_faces[static_cast<std::size_t>(f) * faces.cell_stride + pair.donor];
    const std::int32_t face = entry >> 1;
    const bool was_there = in_cell != std::array<double, 3>{};
    const Point to_left = mesh.face_centroid[face] - mesh.centroid[mesh.left[face]];
    const Point to_cell = (entry & 1 ? -1.0 : 1.0) * mesh.face_delta[face],
                to_face = entry & 1 ? to_left + to_cell : to_left, way = was_there ? to_cell : to_face;
    delta = {way.x, way.y, way.z};
    for (int d = 0; d < fields.dimension; ++d)
      delta[d] += (was_there ? in_cell[d] : phase.wetted_at[d][face]) - from[d];
    break;
  }
  return delta;
}

/// At second order the states of the pair differ by the donor's slopes. Nothing where they would lead to no state.
std::array<double, Redistribution::most_components> Redistribution::step_beside(const Mesh& mesh, const Faces& faces,
                                                                                const Fields& fields,
                                                                                const Pair& pair) const {
  const Phase& phase = fields.phases[pair.k];
  if (phase.used_slopes.stride == 0) return {};
  const int D = fields.dimension;
  const std::array<double, 3> delta = between(mesh, faces, fields, pair);
  std::array<double, most_components> here{}, there{}, step{};  // rho, u, p, e
  for (int v = 0; v < phase.n_conserved(); ++v) {
    here[v] = (v < 2 + D ? phase.primitive[v] : phase.conserved[v])[pair.donor];
    there[v] = here[v];
    for (int d = 0; d < D; ++d) there[v] += phase.used_slopes.component(v * D + d)[pair.donor] * delta[d];
  }
  step[0] = there[0] - here[0];
  for (int d = 0; d < D; ++d) step[1 + d] = there[0] * there[1 + d] - here[0] * here[1 + d];
  step[1 + D] = total_energy(fields, phase, there.data()) - total_energy(fields, phase, here.data());
  for (int c = 2 + D; c < phase.n_conserved(); ++c) step[c] = there[c] - here[c];
  return there[0] > 0 && std::isfinite(step[1 + D]) ? step : decltype(step){};
}

/// The mean of every pair, from the state before.
void Redistribution::average(const Mesh& mesh, const Faces& faces, const Fields& fields) {
  const auto own_share = [&](const Pair& pair) {
    return share_of(fields, pair.k, pair.cell, kept(mesh, faces, pair.k, pair.cell));
  };
  const auto donors_share = [&](const Pair& pair) { return share_of(fields, pair.k, pair.donor, pair.lent); };
  const auto send = [&](std::vector<double>& out, int k, const Share& share) {
    out.push_back(share.volume);
    out.insert(out.end(), share.content.begin(), share.content.begin() + fields.phases[k].n_conserved());
  };
  for (std::size_t n = 0; n < mesh.neighbours.size(); ++n) {
    std::vector<double>& out = shares_.outgoing(n);
    out.clear();
    for (const std::int32_t i : asked_[n]) send(out, pairs_[i].k, own_share(pairs_[i]));
    for (std::int32_t i = received_[n].first; i < received_[n].second; ++i) {
      const Pair& pair = pairs_[i];
      send(out, pair.k, donors_share(pair));
      out.insert(out.end(), pair.step.begin(), pair.step.begin() + fields.phases[pair.k].n_conserved());
    }
  }
  shares_.start();
  const auto combine = [&](Pair& pair, const Share& a, const Share& b) {
    const double volume = a.volume + b.volume;
    pair.apart = !(volume > least_sum * (std::fabs(a.volume) + std::fabs(b.volume)));
    if (pair.apart) return;
    pair.volume = volume, pair.own = a.volume;
    for (int c = 0; c < fields.phases[pair.k].n_conserved(); ++c) pair.mean[c] = (a.content[c] + b.content[c]) / volume;
  };
  for (std::size_t i = 0; i < n_own_pairs_; ++i) {
    Pair& pair = pairs_[i];
    if (pair.donor < mesh.n_owned) combine(pair, own_share(pair), donors_share(pair));
  }
  shares_.finish();
  for (std::size_t n = 0; n < mesh.neighbours.size(); ++n) {
    const double* in = shares_.incoming(n).data();
    const auto receive = [&](int k) {
      Share share;
      share.volume = *in++;
      const int size = fields.phases[k].n_conserved();
      std::copy_n(in, size, share.content.begin());
      in += size;
      return share;
    };
    // what this rank's pairs ask of the neighbour is what was received there, and the other way round
    for (std::int32_t i = received_[n].first; i < received_[n].second; ++i) {
      Pair& pair = pairs_[i];
      combine(pair, receive(pair.k), donors_share(pair));
    }
    for (const std::int32_t i : asked_[n]) {
      Pair& pair = pairs_[i];
      combine(pair, own_share(pair), receive(pair.k));
      std::copy_n(in, fields.phases[pair.k].n_conserved(), pair.step.begin());
      in += fields.phases[pair.k].n_conserved();
    }
  }
  for (std::size_t i = 0; i < n_own_pairs_; ++i) counters_.apart += pairs_[i].apart;
}

/// The mean over a cell's neighbourhoods, weighted by the part it has in each: its own first, then in the order of its
/// faces.
void Redistribution::take(const Mesh& mesh, const Faces& faces, Fields& fields, int k, std::int32_t cell) {
  Phase& phase = fields.phases[k];
  const int first_cobasis = fields.first_cobasis(), size = phase.n_conserved();
  const double alpha = phase.alpha[cell];
  std::array<double, most_components> own, sum{};
  for (int c = 0; c < size; ++c) own[c] = phase.conserved[c][cell] / (c < first_cobasis ? alpha : 1);
  const auto add = [&](const Pair& pair, double weight, bool donor) {
    if (pair.apart) {
      for (int c = 0; c < size; ++c) sum[c] += weight * own[c];
      return;
    }
    const double beside = donor ? -pair.own / pair.volume : 1 - pair.own / pair.volume;
    for (int c = 0; c < size; ++c) sum[c] += weight * (pair.mean[c] + beside * pair.step[c]);
  };
  const double part = kept(mesh, faces, k, cell);
  const std::int32_t pair = members_[k].pair_of[cell];
  if (pair >= 0)
    add(pairs_[pair], part, false);
  else
    for (int c = 0; c < size; ++c) sum[c] += part * own[c];
  for_each_taker(mesh, faces, k, cell, [&](const Pair& taker) { add(taker, taker.lent, true); });
  for (int c = 0; c < size; ++c) phase.conserved[c][cell] = sum[c] * (c < first_cobasis ? alpha : 1);
}

void Redistribution::run(const Mesh& mesh, const Faces& faces, Fields& fields,
                         std::span<const std::int32_t> candidates) {
  pairs_.clear();
  second_.clear();
  small_.clear();
  bool remote = false;
  fields.share_alpha(mesh, alpha_);
  for (int k = 0; k < fields.n_phases(); ++k) {
    const Phase& phase = fields.phases[k];
    if (phase.is_void) continue;
    for (const std::int32_t cell : candidates) {
      const double alpha = phase.alpha[cell];
      if (alpha == 0 || !(alpha < small_fraction)) continue;
      const double least_donor = RemoteVolumes::least_root(mesh.cell_type[cell]);
      const bool tiny = std::fabs(alpha) <= least_donor;
      if (tiny) small_.emplace_back(cell, k);
      if (choose(mesh, faces, fields, k, cell, std::max(least_donor, std::fabs(alpha)))) {
        if (!(phase.alpha[pairs_.back().donor] < small_fraction)) continue;
        second_.push_back(pairs_.back());
        pairs_.pop_back();
      } else if (tiny) {
        remote = true;
      } else {
        ++counters_.alone;
      }
    }
  }
  counters_.merged += static_cast<std::int64_t>(pairs_.size() + second_.size());
  settle(mesh, faces, fields, small_fraction);
  // A small volume that lends has been averaged itself by now. Were it to lend at the same time, half of what it is
  // would never meet the state of a whole cell, and would grow from step to step.
  if (mpi_.any(!second_.empty())) {
    pairs_.swap(second_);
    settle(mesh, faces, fields, small_fraction);
  }
  if (!mpi_.any(remote)) return;
  counters_.alone += remote_.run(mesh, faces, fields, small_);
}

void Redistribution::mend(const Mesh& mesh, const Faces& faces, Fields& fields,
                          std::span<const std::pair<std::int32_t, int>> volumes) {
  pairs_.clear();
  fields.share_alpha(mesh, alpha_);
  for (const auto& [cell, k] : volumes) counters_.alone += !choose(mesh, faces, fields, k, cell, 0);
  counters_.mended += static_cast<std::int64_t>(pairs_.size());
  settle(mesh, faces, fields, std::numeric_limits<double>::infinity());
}

/// Averages the pairs that were chosen.
void Redistribution::settle(const Mesh& mesh, const Faces& faces, Fields& fields, double target) {
  n_own_pairs_ = pairs_.size();
  share_choices(mesh);
  changed_.clear();
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const Pair& pair = pairs_[i];
    Members& members = members_[pair.k];
    if (pair.cell < mesh.n_owned && members.chosen[pair.cell] == 0) changed_.emplace_back(pair.cell, pair.k);
    members.pair_of[pair.cell] = static_cast<std::int32_t>(i);
    if (pair.donor >= mesh.n_owned) continue;
    if (members.chosen[pair.donor]++ == 0 && members.pair_of[pair.donor] < 0) changed_.emplace_back(pair.donor, pair.k);
  }
  for (Pair& pair : pairs_) {
    if (pair.donor >= mesh.n_owned) continue;
    lend(mesh, fields, pair, target);
    const auto& alpha = fields.phases[pair.k].alpha;
    // slopes of a donor that is small itself depend on the cell, which would get its own errors back
    if (target < 1 && alpha[pair.cell] > 0 && !(alpha[pair.donor] < small_fraction))
      pair.step = step_beside(mesh, faces, fields, pair);
  }
  average(mesh, faces, fields);
  for (const auto& [cell, k] : changed_) take(mesh, faces, fields, k, cell);
  for (const Pair& pair : pairs_) {
    members_[pair.k].pair_of[pair.cell] = -1;
    if (pair.donor < mesh.n_owned) members_[pair.k].chosen[pair.donor] = 0;
  }
}

}  // namespace cobasis
