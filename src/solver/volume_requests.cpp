// Which small volumes ask which neighbour to take them.
#include <algorithm>
#include <bit>
#include <cmath>

#include "solver/stopwatch.hpp"
#include "solver/volume_exchange.hpp"

namespace cobasis {
namespace {

/// What another phase's dust may change of a stretched phase's pressure when it takes over the volume.
constexpr double change_in_tension = 1e-4;

/// The largest volume fraction in a cell that counts as dust there. Beside planes, in a phase that is stretched the
/// least bubble grows, by a constant factor each step: what is nothing beside the tension must go before it tears the
/// phase.
double largest_dust(const Fields& fields, const Phase& carrier, std::int32_t cell, bool planes) {
  if (!planes || carrier.is_void) return dust_threshold;
  const int D = fields.dimension;
  const double p = carrier.primitive[1 + D][cell],
               stiffness = carrier.primitive[0][cell] * carrier.primitive[2 + D][cell];
  return p < 0 && stiffness > 0 ? std::max(dust_threshold, change_in_tension * -p / stiffness) : dust_threshold;
}

/// Round-off can leave content without volume.
bool may_be_there(const Phase& phase, std::int32_t cell) {
  return phase.alpha[cell] != 0 || (!phase.is_void && phase.conserved[0][cell] != 0);
}

}  // namespace

void VolumeExchange::request(const Mesh& mesh, const Faces& faces, const Fields& fields, std::int32_t cell, int k,
                             bool forced, bool planes) {
  const auto alpha = [&](int phase, std::int32_t at) { return fields.phases[phase].alpha[at]; };
  int j = k == 0 ? 1 : 0;
  for (int phase = 0; phase < fields.n_phases(); ++phase)
    if (phase != k && alpha(phase, cell) > alpha(j, cell)) j = phase;
  const double own = alpha(k, cell), volume = own * fields.volume[cell];

  std::int32_t donor = -1, richest = -1, ahead = -1;
  double most_ahead = 0;
  const auto better = [&](std::int32_t candidate, std::int32_t than) {
    if (than < 0) return true;
    const double a = alpha(k, candidate), b = alpha(k, than);
    return a > b || (a == b && mesh.global_id[candidate] < mesh.global_id[than]);
  };
  for (int f = 0; f < faces.max_cell_faces; ++f) {
    const std::int32_t entry = faces.cell_faces[static_cast<std::size_t>(f) * faces.cell_stride + cell];
    const std::int32_t face = entry >> 1;
    if (face >= mesh.first_boundary_face()) continue;
    const std::int32_t d = entry & 1 ? faces.left[face] : faces.right[face];
    if (d == cell) continue;
    if (const Phase& carrier = fields.phases[j]; !carrier.is_void) {
      double flow = carrier.conserved[1][cell] * faces.nx[face] + carrier.conserved[2][cell] * faces.ny[face];
      if (fields.dimension == 3) flow += carrier.conserved[3][cell] * faces.nz[face];
      flow *= (entry & 1 ? -1 : 1) * faces.area[face];
      if (flow > most_ahead) ahead = d, most_ahead = flow;
    }
    if (!(alpha(k, d) > own)) continue;
    if (better(d, richest)) richest = d;
    if (!(alpha(k, d) > std::fabs(own))) continue;
    if (forced && alpha(k, d) < least_to_give_) continue;  // what is inadmissible needs a healthy partner
    // a negative volume comes with the cell's own j: part of a tiny alpha_j in d would be more than all that is there
    const double left = volume < 0 ? alpha(k, d) : alpha(j, d) >= least_to_give_ ? alpha(j, d) : 0;
    if (has(left * fields.volume[d], std::fabs(volume), fields.volume[d]) && better(d, donor)) donor = d;
  }
  if (volume < 0 && !has(alpha(j, cell) * fields.volume[cell], -volume, fields.volume[cell])) donor = -1;
  // dust is about to leave a donor that has no more than dust of the phase: a body beside it takes it
  if (donor >= 0 && alpha(k, donor) < dust_threshold && alpha(k, richest) >= least_to_give_) donor = -1;
  // what stays behind where no neighbour has the phase any more follows it
  if (richest < 0) richest = ahead;
  const bool dust_only =
      donor < 0 && richest >= 0 && std::fabs(own) < largest_dust(fields, fields.phases[j], cell, planes);
  if (dust_only) donor = richest;
  if (donor < 0) {
    ++counters_.kept;
    return;
  }
  asked_.push_back({mesh.global_id[cell], cell, donor, k, j, volume, own, dust_only, -1, 0, Answer::refused, -1});
}

/// The candidates with a phase that is there in small, and those with a forced one.
COBASIS_KERNEL void VolumeExchange::find_small(const Fields& fields, std::span<const std::int32_t> candidates,
                                               const std::vector<std::pair<std::int32_t, int>>& forced) {
  small_.clear();
  auto next_forced = forced.begin();
  const auto n = static_cast<std::int32_t>(candidates.size());
  for (std::int32_t i = 0; i < n; i += pack_width) {
    Indices<Pack> at;
    for (int j = 0; j < pack_width; ++j) at[j] = candidates[std::min(i + j, n - 1)];
    unsigned small = 0;
    for (const Phase& phase : fields.phases) {
      const Pack alpha = gather<Pack>(phase.alpha.data(), at);
      Pack there = magnitude(alpha);
      if (!phase.is_void) there += magnitude(gather<Pack>(phase.conserved[0].data(), at));
      small |= positive_lanes(thresholds_.largest - alpha) & positive_lanes(there);
    }
    for (int j = 0; j < pack_width && next_forced != forced.end(); ++j) {
      if (next_forced->first == at[j]) small |= 1u << j;
      while (next_forced != forced.end() && next_forced->first <= at[j]) ++next_forced;
    }
    if (n - i < pack_width) small &= (1u << (n - i)) - 1;
    store_chosen(small, at, small_.end());
    small_.grow(std::popcount(small));
  }
}

void VolumeExchange::ask(const Mesh& mesh, const Faces& faces, const Fields& fields, double dt,
                         std::span<const std::int32_t> candidates,
                         const std::vector<std::pair<std::int32_t, int>>& forced, const Expected& expected) {
  asked_.clear();
  {
    const Timed timed(kernel_seconds_);
    find_small(fields, candidates, forced);
  }
  auto next_forced = forced.begin();
  for (const std::int32_t cell : small_.span()) {
    // the threshold follows the speed of the material, so that slow fronts move as exactly as fast ones
    int material = -1;
    for (int k = 0; k < fields.n_phases(); ++k)
      if (!fields.phases[k].is_void &&
          (material < 0 || fields.phases[k].alpha[cell] > fields.phases[material].alpha[cell]))
        material = k;
    const Phase& m = fields.phases[material];
    const double mass = m.conserved[0][cell];
    double swept = 0;
    for (int f = 0; f < faces.max_cell_faces && mass > 0; ++f) {
      const std::int32_t face = faces.cell_faces[static_cast<std::size_t>(f) * faces.cell_stride + cell] >> 1;
      double un = m.conserved[1][cell] * faces.nx[face] + m.conserved[2][cell] * faces.ny[face];
      if (fields.dimension == 3) un += m.conserved[3][cell] * faces.nz[face];
      swept += faces.area[face] * std::fabs(un);
    }
    if (mass > 0) swept /= mass;
    const double threshold =
        std::max(thresholds_.smallest, std::min(thresholds_.largest, 0.1 * dt * swept / (2 * fields.volume[cell])));
    for (int k = 0; k < fields.n_phases(); ++k) {
      const double alpha = fields.phases[k].alpha[cell];
      const bool is_forced = next_forced != forced.end() && *next_forced == std::pair(cell, k);
      if (is_forced) ++next_forced;
      if (!may_be_there(fields.phases[k], cell) || !(alpha < threshold || is_forced)) continue;
      const bool planes = static_cast<bool>(expected);
      if (is_forced || alpha < thresholds_.smallest || !planes || alpha < largest_dust(fields, m, cell, planes) ||
          !expected(cell, k))
        request(mesh, faces, fields, cell, k, is_forced, planes);
    }
  }
}

}  // namespace cobasis
