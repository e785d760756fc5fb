#include "solver/interfaces.hpp"

#include <algorithm>

namespace cobasis {
namespace {

Segment open_segment(std::int32_t first) { return {first, first}; }

template <class T>
void close_segment(Segment& segment, CompactList<T>& list) {
  segment.last = list.size();
  list.fill(pack_width);
}

}  // namespace

Interfaces::Interfaces(const Faces& faces, const Fields& fields, std::vector<FaceRange> inside,
                       std::vector<FaceRange> mirror, std::vector<FaceRange> halo, std::vector<FaceRange> prescribed)
    : n_phases_(fields.n_phases()),
      ranges_{std::move(inside), std::move(mirror), std::move(halo), std::move(prescribed)},
      pure_(n_phases_),
      mixed_(n_phases_),
      pair_segments_(n_phases_ * n_phases_),
      pairs_(n_phases_ * n_phases_),
      mixed_faces_(faces.n + n_parts * pack_width),
      acting_(fields.multiphase() ? fields.n_all + pack_width : 0),
      left_(n_phases_),
      right_(n_phases_),
      jump_(n_phases_) {
  for (int l = 0; l < n_phases_; ++l) {
    for (int m = 0; m < n_phases_; ++m) {
      if (l == m) continue;
      PairList& pair = pairs_[l * n_phases_ + m];
      pair.face = CompactList<std::int32_t>(faces.n + n_parts * pack_width);
      pair.share = CompactList<double>(faces.n + n_parts * pack_width);
      pair.side = fields.phases[l].is_void ? 1 : 0;
    }
  }
}

void Interfaces::clear(Fields& fields) {
  mixed_faces_.clear();
  for (PairList& pair : pairs_) {
    pair.face.clear();
    pair.share.clear();
  }
  for (Phase& phase : fields.phases) {
    phase.lists.pure.clear();
    phase.lists.mixed.clear();
    phase.lists.mixed_share.clear();
  }
  for (auto* segments : {&pure_, &mixed_, &pair_segments_})
    for (auto& of_parts : *segments) of_parts.fill({});
  std::fill(acting_.begin(), acting_.end(), 0);
}

COBASIS_KERNEL void Interfaces::sort(Faces& faces, Fields& fields, Part part) {
  const int p = static_cast<int>(part);
  for (int k = 0; k < n_phases_; ++k) pure_[k][p] = open_segment(fields.phases[k].lists.pure.size());
  part_faces_ = open_segment(mixed_faces_.size());
  Indices<Pack> count_up, mixed_cell, far{};
  for (int i = 0; i < pack_width; ++i) count_up[i] = i;
  mixed_cell.fill(-1);
  for (const FaceRange& range : ranges_[p]) {
    for (std::int32_t f = range.first; f < range.last; f += pack_width) {
      const unsigned valid = range.last - f >= pack_width ? (1u << pack_width) - 1 : (1u << (range.last - f)) - 1;
      const Indices<Pack> left = lookup<Pack>(fields.pure.data(), load_indices<Pack>(&faces.left[f]));
      const Indices<Pack> right =
          part == Part::mirror ? left : lookup<Pack>(fields.pure.data(), load_indices<Pack>(&faces.right[f]));
      unsigned pure = equal_lanes(left, right) & ~equal_lanes(left, mixed_cell) & valid;
      if (fields.sharp()) pure &= equal_lanes(load_indices<Pack>(&fields.near[f]), far);
      Indices<Pack> at;
      for (int i = 0; i < pack_width; ++i) at[i] = f + count_up[i];
      if (valid + 1 == 1u << pack_width)
        store(Pack(0.0), &faces.fastest[f]);
      else
        std::fill(&faces.fastest[f], &faces.fastest[range.last], 0.0);
      store_chosen(valid & ~pure, at, mixed_faces_.end());
      mixed_faces_.grow(std::popcount(valid & ~pure));
      for (int k = 0; k < n_phases_; ++k) {
        if (fields.phases[k].is_void) continue;
        SlotLists& lists = fields.phases[k].lists;
        Indices<Pack> phase;
        phase.fill(k);
        const unsigned own = equal_lanes(left, phase) & pure;
        store_chosen(own, at, lists.pure.end());
        std::int32_t slot = pack_width + lists.pure.size();
        for (int i = 0; i < pack_width; ++i)
          if (valid >> i & 1) lists.slot_of_face[f + i] = own >> i & 1 ? slot++ : 0;
        lists.pure.grow(std::popcount(own));
      }
    }
  }
  for (int k = 0; k < n_phases_; ++k) close_segment(pure_[k][p], fields.phases[k].lists.pure);
  close_segment(part_faces_, mixed_faces_);
}

COBASIS_KERNEL void Interfaces::find_contacts(const Faces& faces, Fields& fields, Part part) {
  const int p = static_cast<int>(part), n = n_phases_;
  const std::int32_t first_slot = first_mixed_slot(faces);
  for (int k = 0; k < n; ++k) mixed_[k][p] = open_segment(fields.phases[k].lists.mixed.size());
  for (int lm = 0; lm < n * n; ++lm) pair_segments_[lm][p] = open_segment(pairs_[lm].face.size());
  const Pack zero(0.0);

  for (std::int32_t i = part_faces_.first; i < part_faces_.last; i += pack_width) {
    const Indices<Pack> at = load_indices<Pack>(&mixed_faces_[i]);
    const Indices<Pack> l = lookup<Pack>(faces.left.data(), at);
    const Indices<Pack> r = part == Part::mirror ? l : lookup<Pack>(faces.right.data(), at);
    const int count = std::min(pack_width, part_faces_.last - i);
    const unsigned valid = (1u << count) - 1;

    Pack largest(-1.0);
    for (int k = 0; k < n; ++k) {
      const Phase& phase = fields.phases[k];
      left_[k] = fields.sharp() ? gather<Pack>(phase.wetted[0].data(), at) : gather<Pack>(phase.alpha.data(), l);
      right_[k] = fields.sharp() ? gather<Pack>(phase.wetted[1].data(), at) : gather<Pack>(phase.alpha.data(), r);
      jump_[k] = left_[k] - right_[k];
      largest = larger(largest, left_[k] + right_[k]);
    }
    // The jump of the dominant phase is minus the sum of the others': round-off of (1 - alpha) would outweigh a trace.
    Pack::mask_type found(false);
    for (int k = 0; k < n; ++k) {
      const Pack::mask_type dominant = !found && left_[k] + right_[k] == largest;
      found = found || dominant;
      Pack others(0.0);
      for (int m = 0; m < n; ++m)
        if (m != k) others += left_[m] - right_[m];
      jump_[k] = select(dominant, -others, jump_[k]);
    }
    Pack gains(0.0);
    for (int k = 0; k < n; ++k) gains += larger(zero, jump_[k]);

    for (int k = 0; k < n; ++k) {
      if (fields.phases[k].is_void) continue;
      const unsigned present = positive_lanes(larger(left_[k], right_[k])) & valid;
      SlotLists& lists = fields.phases[k].lists;
      store_chosen(present, at, lists.mixed.end());
      store_chosen(present, smaller(left_[k], right_[k]), lists.mixed_share.end());
      std::int32_t slot = first_slot + lists.mixed.size();
      for (unsigned bits = present; bits != 0; bits &= bits - 1) {
        const int j = std::countr_zero(bits);
        lists.slot_of_face[at[j]] = slot++;
        acting_[l[j]] |= 1 << k;
        acting_[r[j]] |= 1 << k;
      }
      lists.mixed.grow(std::popcount(present));
      lists.mixed_share.grow(std::popcount(present));
    }
    for (int a = 0; a < n; ++a) {
      if ((positive_lanes(jump_[a]) & valid) == 0) continue;
      for (int b = 0; b < n; ++b) {
        if (a == b) continue;
        const Pack share = contact_surface(jump_[a], jump_[b], gains);
        const unsigned meeting = positive_lanes(share) & valid;
        if (meeting == 0) continue;
        PairList& pair = pairs_[a * n + b];
        store_chosen(meeting, at, pair.face.end());
        store_chosen(meeting, share, pair.share.end());
        pair.face.grow(std::popcount(meeting));
        pair.share.grow(std::popcount(meeting));
      }
    }
  }
  for (int k = 0; k < n; ++k) {
    close_segment(mixed_[k][p], fields.phases[k].lists.mixed);
    fields.phases[k].lists.mixed_share.fill(pack_width);
  }
  for (int lm = 0; lm < n * n; ++lm) {
    close_segment(pair_segments_[lm][p], pairs_[lm].face);
    pairs_[lm].share.fill(pack_width);
  }
}

}  // namespace cobasis
