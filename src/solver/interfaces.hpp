// Which phases meet where: sorts faces into compact lists, pure in a phase, mixed, and per ordered pair of phases with
// the contact surface S_lm.
#pragma once

#include <vector>

#include "solver/contact_sweep.hpp"

namespace cobasis {

/// Faces that can be swept at one moment. Open boundary faces go with the inner ones; mirrors have no right cell, and
/// that of what the case prescribes is the left one.
enum class Part { inside, mirror, halo, prescribed };
inline constexpr int n_parts = 4;

struct FaceRange {
  std::int32_t first, last;
};

class Interfaces {
 public:
  static constexpr int most_phases = 31;  ///< one bit each

  Interfaces(const Faces& faces, const Fields& fields, std::vector<FaceRange> inside, std::vector<FaceRange> mirror,
             std::vector<FaceRange> halo, std::vector<FaceRange> prescribed = {});

  /// Empties all lists before a step.
  void clear(Fields& fields);
  /// Sorts the faces of one part into those that are pure in a phase and the others; both cells must be known. Resets
  /// the faces' fastest signals.
  void sort(Faces& faces, Fields& fields, Part part);
  /// Contact surfaces of the others, (Table 1) for any number of phases.
  void find_contacts(const Faces& faces, Fields& fields, Part part);

  Segment pure(int k, Part part) const { return pure_[k][static_cast<int>(part)]; }
  Segment mixed(int k, Part part) const { return mixed_[k][static_cast<int>(part)]; }
  const PairList& pair(int l, int m) const { return pairs_[l * n_phases_ + m]; }
  void set_friction(int l, int m, double coefficient) { pairs_[l * n_phases_ + m].friction = coefficient; }
  Segment pair_segment(int l, int m, Part part) const {
    return pair_segments_[l * n_phases_ + m][static_cast<int>(part)];
  }

  /// Bit k: phase k acts on a cell through a face that is not pure. Of all cells, ghosts included.
  const AlignedVector<std::int32_t>& acting() const { return acting_; }

 private:
  int n_phases_;
  std::vector<FaceRange> ranges_[n_parts];
  std::vector<std::array<Segment, n_parts>> pure_, mixed_, pair_segments_;
  std::vector<PairList> pairs_;
  CompactList<std::int32_t> mixed_faces_;
  Segment part_faces_;  // of mixed_faces_, in the part last sorted
  AlignedVector<std::int32_t> acting_;
  std::vector<Pack> left_, right_, jump_;  // scratch per phase
};

/// S_lm = max(0, d_l) max(0, -d_m) / sum_k max(0, d_k), d = left - right volume fraction; the d must sum to zero.
template <class Real>
Real contact_surface(const Real& d_l, const Real& d_m, const Real& sum_of_gains) {
  const Real zero(0.0);
  const Real product = larger(zero, d_l) * larger(zero, -d_m);
  return select(product > zero, product / sum_of_gains, zero);
}

}  // namespace cobasis
