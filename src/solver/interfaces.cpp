#include "solver/interfaces.hpp"

#include <algorithm>

namespace cobasis {
namespace {

/// Fills the last pack of a list by repeating its last entry.
template <class T>
void fill_pack(T& list) {
  while (list.size() % pack_width != 0) list.push_back(list.back());
}

Segment open_segment(std::size_t first) {
  return {static_cast<std::int32_t>(first), static_cast<std::int32_t>(first)};
}

}  // namespace

Interfaces::Interfaces(const Faces& faces, const Fields& fields, std::vector<FaceRange> inside,
                       std::vector<FaceRange> mirror, std::vector<FaceRange> halo)
    : n_phases_(fields.n_phases()),
      ranges_{std::move(inside), std::move(mirror), std::move(halo)},
      pure_(n_phases_),
      mixed_(n_phases_),
      pair_segments_(n_phases_ * n_phases_),
      pairs_(n_phases_ * n_phases_),
      left_(n_phases_),
      right_(n_phases_),
      jump_(n_phases_) {
  const std::size_t most = faces.n + n_parts * pack_width;
  mixed_faces_.reserve(most);
  for (PairList& pair : pairs_) {
    if (!fields.multiphase()) continue;
    pair.face.reserve(most);
    pair.share.reserve(most);
    pair.side.reserve(most);
  }
}

void Interfaces::clear(Fields& fields) {
  mixed_faces_.clear();
  for (PairList& pair : pairs_) {
    pair.face.clear();
    pair.share.clear();
    pair.side.clear();
  }
  for (Phase& phase : fields.phases) {
    phase.lists.pure.clear();
    phase.lists.mixed.clear();
    phase.lists.mixed_share.clear();
    std::fill(phase.lists.slot_of_face.begin(), phase.lists.slot_of_face.end(), 0);
  }
  for (auto* segments : {&pure_, &mixed_, &pair_segments_})
    for (auto& of_parts : *segments) of_parts.fill({});
}

void Interfaces::sort(const Faces& faces, Fields& fields, Part part) {
  const int p = static_cast<int>(part);
  for (int k = 0; k < n_phases_; ++k) pure_[k][p] = open_segment(fields.phases[k].lists.pure.size());
  const std::size_t first_mixed = mixed_faces_.size();
  const std::int8_t* pure = fields.pure.data();
  for (const FaceRange& range : ranges_[p]) {
    for (std::int32_t f = range.first; f < range.last; ++f) {
      const std::int8_t l = pure[faces.left[f]], r = part == Part::mirror ? l : pure[faces.right[f]];
      if (l < 0 || l != r) {
        mixed_faces_.push_back(f);
      } else if (!fields.phases[l].is_void) {
        SlotLists& lists = fields.phases[l].lists;
        lists.slot_of_face[f] = pack_width + static_cast<std::int32_t>(lists.pure.size());
        lists.pure.push_back(f);
      }
    }
  }
  for (int k = 0; k < n_phases_; ++k) {
    pure_[k][p].last = static_cast<std::int32_t>(fields.phases[k].lists.pure.size());
    fill_pack(fields.phases[k].lists.pure);
  }
  if (fields.multiphase()) sort_mixed(faces, fields, part, first_mixed);
}

void Interfaces::sort_mixed(const Faces& faces, Fields& fields, Part part, std::size_t first) {
  const int p = static_cast<int>(part), n = n_phases_;
  const std::int32_t first_slot = first_mixed_slot(faces);
  for (int k = 0; k < n; ++k) mixed_[k][p] = open_segment(fields.phases[k].lists.mixed.size());
  for (int lm = 0; lm < n * n; ++lm) pair_segments_[lm][p] = open_segment(pairs_[lm].face.size());

  for (std::size_t i = first; i < mixed_faces_.size(); ++i) {
    const std::int32_t f = mixed_faces_[i], l = faces.left[f], r = part == Part::mirror ? l : faces.right[f];
    int dominant = 0;
    for (int k = 0; k < n; ++k) {
      left_[k] = fields.phases[k].alpha[l];
      right_[k] = fields.phases[k].alpha[r];
      jump_[k] = left_[k] - right_[k];
      if (left_[k] + right_[k] > left_[dominant] + right_[dominant]) dominant = k;
      if (fields.phases[k].is_void || !(left_[k] > 0 || right_[k] > 0)) continue;
      SlotLists& lists = fields.phases[k].lists;
      lists.slot_of_face[f] = first_slot + static_cast<std::int32_t>(lists.mixed.size());
      lists.mixed.push_back(f);
      lists.mixed_share.push_back(std::min(left_[k], right_[k]));
    }
    // round-off of (1 - alpha) would otherwise outweigh a trace
    jump_[dominant] = 0;
    for (int k = 0; k < n; ++k)
      if (k != dominant) jump_[dominant] -= fields.phases[k].alpha[l] - fields.phases[k].alpha[r];
    double gains = 0;
    for (int k = 0; k < n; ++k) gains += std::max(0.0, jump_[k]);
    if (!(gains > 0)) continue;
    for (int a = 0; a < n; ++a) {
      if (!(jump_[a] > 0)) continue;
      for (int b = 0; b < n; ++b) {
        const double share = contact_surface(jump_[a], jump_[b], gains);
        if (!(share > 0)) continue;
        PairList& pair = pairs_[a * n + b];
        pair.face.push_back(f);
        pair.share.push_back(share);
        pair.side.push_back(fields.phases[a].is_void ? 1 : 0);
      }
    }
  }
  for (int k = 0; k < n; ++k) {
    mixed_[k][p].last = static_cast<std::int32_t>(fields.phases[k].lists.mixed.size());
    fill_pack(fields.phases[k].lists.mixed);
    fill_pack(fields.phases[k].lists.mixed_share);
  }
  for (int lm = 0; lm < n * n; ++lm) {
    pair_segments_[lm][p].last = static_cast<std::int32_t>(pairs_[lm].face.size());
    fill_pack(pairs_[lm].face);
    fill_pack(pairs_[lm].share);
    fill_pack(pairs_[lm].side);
  }
}

}  // namespace cobasis
