#include "solver/volume_exchange.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <tuple>

#include "solver/stopwatch.hpp"

namespace cobasis {
namespace {

/// A donor keeps a phase that it gives: what is itself small (fragments below 1e-2 may be exchanged by force, others
/// below the threshold) may be about to leave the donor, and must not be given twice.
constexpr double least_fragment = 1e-2;

/// Messages: the position of the asking cell, of the donor, k, j, volume, alpha, dust only, then the content;
/// of a negative volume then also that of phase j.
constexpr int request_head = 7;

std::vector<std::size_t> capacities(const Mesh& mesh, std::size_t per_cell) {
  std::vector<std::size_t> values;
  for (const Neighbour& n : mesh.neighbours)
    values.push_back(per_cell * std::max<std::size_t>(n.send.size(), n.receive_count));
  return values;
}

/// An absent phase starts from e = I when it comes back.
void reset_cobasis(const Fields& fields, Phase& phase, std::int32_t cell) {
  for (int c = fields.first_cobasis(); c < phase.n_conserved(); ++c)
    phase.conserved[c][cell] = identity_cobasis(fields.dimension, c - fields.first_cobasis());
}

std::size_t most_conserved(const Fields& fields) {
  int most = 0;
  for (const Phase& phase : fields.phases) most = std::max(most, phase.n_conserved());
  return most;
}

}  // namespace

VolumeExchange::VolumeExchange(const Mpi& mpi, const Mesh& mesh, const Fields& fields,
                               const ExchangeThresholds& thresholds)
    : thresholds_(thresholds),
      least_to_give_(std::max(least_fragment, thresholds.largest)),
      alpha_(mpi, mesh.neighbours, capacities(mesh, fields.n_phases()), 11),
      requests_out_(mpi, mesh.neighbours,
                    capacities(mesh, fields.n_phases() * (request_head + 2 * most_conserved(fields))), 12),
      answers_(mpi, mesh.neighbours, capacities(mesh, fields.n_phases() * (1 + most_conserved(fields))), 13),
      neighbour_of_halo_(mesh.n_halo),
      sent_(mesh.neighbours.size()),
      read_(mesh.neighbours.size()),
      volume_of_cell_(mesh.n_owned, 0.0) {
  // Room for every cell at once, so that no step allocates; memory that stays untouched costs nothing.
  const std::size_t cells = mesh.n_owned + 1;
  for (auto* requests : {&asked_, &received_}) requests->reserve(cells);
  deposits_.reserve(2 * cells);
  extractions_.reserve(2 * cells);
  completed_ = CellList(cells);
  small_ = CellList(cells);
  for (auto* list : {&order_, &given_, &taken_, &touched_}) list->reserve(2 * cells);
  for (std::size_t n = 0; n < mesh.neighbours.size(); ++n) {
    const Neighbour& neighbour = mesh.neighbours[n];
    std::fill_n(neighbour_of_halo_.begin() + (neighbour.receive_first - mesh.n_owned), neighbour.receive_count,
                static_cast<std::int32_t>(n));
  }
}

Content VolumeExchange::content_of(const Fields& fields, int k, std::int32_t cell) const {
  const Phase& phase = fields.phases[k];
  Content content{};
  for (int c = 0; c < phase.n_conserved(); ++c)
    content[c] = phase.conserved[c][cell] * fields.volume[cell] * (c < fields.first_cobasis() ? 1 : phase.alpha[cell]);
  return content;
}

/// What a volume of the phase holds, of the cell's content.
Content VolumeExchange::part_of(const Fields& fields, int k, std::int32_t cell, double volume) const {
  Content content = content_of(fields, k, cell);
  const double part = volume / (fields.phases[k].alpha[cell] * fields.volume[cell]);
  for (double& value : content) value *= part;
  return content;
}

/// The volume of a phase that an owned cell's own requests may take out of it.
double VolumeExchange::promised(std::int32_t cell, int k) const {
  double volume = 0;
  const auto before = [](const Request& r, std::int32_t c) { return r.cell < c; };
  for (auto r = std::lower_bound(asked_.begin(), asked_.end(), cell, before); r != asked_.end() && r->cell == cell; ++r)
    if (r->negative() && r->j == k) volume -= r->volume;
  return volume;
}

void VolumeExchange::deliver(const Mesh& mesh, const Fields& fields) {
  for (std::size_t n = 0; n < mesh.neighbours.size(); ++n) requests_out_.outgoing(n).clear();
  received_.clear();
  contents_.clear();
  std::fill(sent_.begin(), sent_.end(), 0);
  for (std::size_t i = 0; i < asked_.size(); ++i) {
    Request& r = asked_[i];
    if (r.donor < mesh.n_owned) {
      r.position = static_cast<int>(i);
      received_.push_back(r);
      continue;
    }
    r.neighbour = neighbour_of_halo_[r.donor - mesh.n_owned];
    r.position = sent_[r.neighbour]++;
    const Neighbour& neighbour = mesh.neighbours[r.neighbour];
    const auto own = std::lower_bound(neighbour.send.begin(), neighbour.send.end(), r.cell) - neighbour.send.begin();
    std::vector<double>& out = requests_out_.outgoing(r.neighbour);
    for (const double value :
         {static_cast<double>(own), static_cast<double>(r.donor - neighbour.receive_first), static_cast<double>(r.k),
          static_cast<double>(r.j), r.volume, r.alpha, static_cast<double>(r.dust_only)})
      out.push_back(value);
    const Content content = content_of(fields, r.k, r.cell);
    for (int c = 0; c < fields.phases[r.k].n_conserved(); ++c) out.push_back(content[c]);
    if (!r.negative()) continue;
    const Content other = part_of(fields, r.j, r.cell, -r.volume);
    for (int c = 0; c < fields.phases[r.j].n_conserved(); ++c) out.push_back(other[c]);
  }
  requests_out_.start();
  requests_out_.finish();
  for (std::size_t n = 0; n < mesh.neighbours.size(); ++n) {
    const std::span<const double> in = requests_out_.incoming(n);
    const Neighbour& neighbour = mesh.neighbours[n];
    int position = 0;
    for (std::size_t at = 0; at < in.size(); ++position) {
      const std::int32_t cell = neighbour.receive_first + static_cast<std::int32_t>(in[at]);
      const std::int32_t donor = neighbour.send[static_cast<std::size_t>(in[at + 1])];
      const int k = static_cast<int>(in[at + 2]), j = static_cast<int>(in[at + 3]);
      const double volume = in[at + 4];
      const auto first_content = static_cast<int>(contents_.size());
      std::size_t end = at + request_head;
      const auto read_content = [&](int phase) {
        const int size = fields.phases[phase].n_conserved();
        std::copy_n(in.begin() + end, size, contents_.emplace_back().begin());
        end += size;
      };
      read_content(k);
      if (volume < 0) read_content(j);
      received_.push_back({mesh.global_id[cell], cell, donor, k, j, volume, in[at + 5], in[at + 6] != 0,
                           static_cast<int>(n), position, Answer::refused, first_content});
      at = end;
    }
  }
}

/// Decides on what this rank's cells were asked for.
void VolumeExchange::serve(const Mesh& mesh, const Fields& fields) {
  // negative ones, then the smallest first, ties by the asking cell: the same order for any partition
  order_.resize(received_.size());
  std::iota(order_.begin(), order_.end(), 0);
  std::sort(order_.begin(), order_.end(), [&](std::int32_t i, std::int32_t j) {
    const Request &a = received_[i], &b = received_[j];
    return std::tuple(a.donor, a.drawn(), a.alpha, a.from_id, a.k) <
           std::tuple(b.donor, b.drawn(), b.alpha, b.from_id, b.k);
  });
  double budget = 0;
  const Request* former = nullptr;
  for (const std::int32_t i : order_) {
    Request& r = received_[i];
    const double V = fields.volume[r.donor], size = std::fabs(r.volume);
    if (!former || r.donor != former->donor || r.drawn() != former->drawn())
      budget = fields.phases[r.drawn()].alpha[r.donor] * V - promised(r.donor, r.drawn());
    former = &r;
    const bool local = r.neighbour < 0;
    const bool granted = !r.dust_only && has(budget, size, V);
    const bool dust = !granted && (r.dust_only || std::fabs(r.alpha) < dust_threshold);
    r.answer = granted ? Answer::granted : dust ? Answer::dust : Answer::refused;
    if (granted || dust)
      deposits_.push_back({r.donor, r.k, r.from_id, granted ? r.volume : 0,
                           local ? content_of(fields, r.k, r.cell) : contents_[r.content]});
    Content given{};
    if (granted) {
      budget -= size;
      if (r.negative()) {
        deposits_.push_back(
            {r.donor, r.j, r.from_id, size, local ? part_of(fields, r.j, r.cell, size) : contents_[r.content + 1]});
      } else {
        extractions_.push_back({r.donor, r.j, size});
        given = part_of(fields, r.j, r.donor, size);
      }
    }
    if (local)
      settle(mesh, r, r.answer, given);
    else
      contents_[r.content] = given;
  }
}

void VolumeExchange::collect_answers(const Mesh& mesh, const Fields& fields) {
  order_.resize(received_.size());
  std::iota(order_.begin(), order_.end(), 0);
  std::sort(order_.begin(), order_.end(), [&](std::int32_t a, std::int32_t b) {
    return std::tie(received_[a].neighbour, received_[a].position) <
           std::tie(received_[b].neighbour, received_[b].position);
  });
  for (std::size_t n = 0; n < mesh.neighbours.size(); ++n) answers_.outgoing(n).clear();
  for (const std::int32_t i : order_) {
    const Request& r = received_[i];
    if (r.neighbour < 0) continue;
    std::vector<double>& out = answers_.outgoing(r.neighbour);
    out.push_back(static_cast<double>(r.answer));
    if (r.answer != Answer::granted || r.negative()) continue;
    for (int c = 0; c < fields.phases[r.j].n_conserved(); ++c) out.push_back(contents_[r.content][c]);
  }
  answers_.start();
  answers_.finish();
  std::fill(read_.begin(), read_.end(), 0);
  for (const Request& r : asked_) {
    if (r.neighbour < 0) continue;
    const std::span<const double> in = answers_.incoming(r.neighbour);
    std::size_t& at = read_[r.neighbour];
    const Answer answer = static_cast<Answer>(static_cast<int>(in[at++]));
    Content content{};
    if (answer == Answer::granted && !r.negative()) {
      const int size = fields.phases[r.j].n_conserved();
      std::copy_n(in.begin() + at, size, content.begin());
      at += size;
    }
    settle(mesh, r, answer, content);
  }
}

/// What an answer means for the asking cell.
void VolumeExchange::settle(const Mesh& mesh, const Request& r, Answer answer, const Content& content) {
  if (answer == Answer::refused) {
    ++counters_.kept;
    return;
  }
  if (answer == Answer::granted) {
    ++counters_.exchanges;
    volume_of_cell_[r.cell] += std::fabs(r.volume);
    if (r.negative())
      extractions_.push_back({r.cell, r.j, -r.volume});
    else
      deposits_.push_back({r.cell, r.j, mesh.global_id[r.donor], r.volume, content});
  } else {
    ++counters_.dust;
    deposits_.push_back({r.cell, r.j, mesh.global_id[r.donor], 0, {}});
  }
  extractions_.push_back({r.cell, r.k, infinity});
}

/// All decisions and contents came from the state before: now extracts all, then deposits all.
void VolumeExchange::apply(Fields& fields) {
  std::sort(extractions_.begin(), extractions_.end(), [](const Extraction& a, const Extraction& b) {
    return std::tie(a.cell, a.phase, a.volume) < std::tie(b.cell, b.phase, b.volume);
  });
  for (std::size_t i = 0, next = 0; i < extractions_.size(); i = next) {
    const Extraction& x = extractions_[i];
    double volume = 0;
    for (; next < extractions_.size() && extractions_[next].cell == x.cell && extractions_[next].phase == x.phase;
         ++next)
      volume += extractions_[next].volume;
    Phase& phase = fields.phases[x.phase];
    double& alpha = phase.alpha[x.cell];
    const bool all = volume == infinity;
    const double rest = all ? 0 : 1 - volume / (alpha * fields.volume[x.cell]);
    alpha = all ? 0 : alpha - volume / fields.volume[x.cell];
    for (int c = 0; c < std::min(phase.n_conserved(), fields.first_cobasis()); ++c) phase.conserved[c][x.cell] *= rest;
    if (all) reset_cobasis(fields, phase, x.cell);
    if (given_.empty() || given_.back() != x.cell) given_.push_back(x.cell);
  }
  order_.resize(deposits_.size());
  std::iota(order_.begin(), order_.end(), 0);
  std::sort(order_.begin(), order_.end(), [&](std::int32_t i, std::int32_t j) {
    const Deposit &a = deposits_[i], &b = deposits_[j];
    return std::tie(a.cell, a.phase, a.from_id, a.volume) < std::tie(b.cell, b.phase, b.from_id, b.volume);
  });
  for (const std::int32_t i : order_) {
    const Deposit& deposit = deposits_[i];
    Phase& phase = fields.phases[deposit.phase];
    const double volume = fields.volume[deposit.cell];
    double& alpha = phase.alpha[deposit.cell];
    const double before = alpha * volume, after = before + deposit.volume;
    alpha += deposit.volume / volume;
    for (int c = 0; c < phase.n_conserved(); ++c) {
      double& q = phase.conserved[c][deposit.cell];
      if (c < fields.first_cobasis())
        q += deposit.content[c] / volume;
      else if (deposit.volume != 0 && after != 0)
        q = (before * q + deposit.content[c]) / after;
    }
    if (taken_.empty() || taken_.back() != deposit.cell) taken_.push_back(deposit.cell);
  }
  std::set_union(given_.begin(), given_.end(), taken_.begin(), taken_.end(), std::back_inserter(touched_));
  const Timed timed(kernel_seconds_);
  completed_.clear();
  for (const std::int32_t cell : touched_) completed_.push(cell);
  completed_.fill(pack_width);
  fields.complete(completed_, static_cast<std::int32_t>(touched_.size()));
}

const std::vector<std::int32_t>& VolumeExchange::run(const Mesh& mesh, const Faces& faces, Fields& fields, double dt,
                                                     std::span<const std::int32_t> candidates,
                                                     const std::vector<std::pair<std::int32_t, int>>& forced,
                                                     const Expected& expected) {
  touched_.clear();
  given_.clear();
  taken_.clear();
  deposits_.clear();
  extractions_.clear();
  fields.share_alpha(mesh, alpha_);
  ask(mesh, faces, fields, dt, candidates, forced, expected);
  deliver(mesh, fields);
  serve(mesh, fields);
  collect_answers(mesh, fields);
  apply(fields);
  return touched_;
}

}  // namespace cobasis
