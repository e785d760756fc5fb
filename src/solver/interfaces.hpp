// Which phases meet where: sorts faces into compact lists, pure in a phase, mixed, and per ordered pair of phases with
// the contact surface S_lm.
#pragma once

#include <vector>

#include "solver/face_sweep.hpp"

namespace cobasis {

/// Faces that can be swept at one moment. Open boundary faces go with the inner ones; mirrors have no right cell.
enum class Part { inside, mirror, halo };
inline constexpr int n_parts = 3;

struct FaceRange {
  std::int32_t first, last;
};

class Interfaces {
 public:
  Interfaces(const Faces& faces, const Fields& fields, std::vector<FaceRange> inside, std::vector<FaceRange> mirror,
             std::vector<FaceRange> halo);

  /// Empties all lists before a step.
  void clear(Fields& fields);
  /// Sorts the faces of one part; the cells on both sides must be known.
  void sort(const Faces& faces, Fields& fields, Part part);

  Segment pure(int k, Part part) const { return pure_[k][static_cast<int>(part)]; }
  Segment mixed(int k, Part part) const { return mixed_[k][static_cast<int>(part)]; }
  const PairList& pair(int l, int m) const { return pairs_[l * n_phases_ + m]; }
  Segment pair_segment(int l, int m, Part part) const { return pair_segments_[l * n_phases_ + m][static_cast<int>(part)]; }

  /// Faces that were not pure in the last sort of each part, in ascending order within a part.
  const std::vector<std::int32_t>& mixed_faces() const { return mixed_faces_; }

 private:
  void sort_mixed(const Faces& faces, Fields& fields, Part part, std::size_t first);

  int n_phases_;
  std::vector<FaceRange> ranges_[n_parts];
  std::vector<std::array<Segment, n_parts>> pure_, mixed_, pair_segments_;
  std::vector<PairList> pairs_;
  std::vector<std::int32_t> mixed_faces_;
  std::vector<double> left_, right_, jump_;  // scratch per phase
};

/// Contact surfaces of a face (section 4.1, any number of phases) from the volume fractions left and right:
/// S_lm = max(0, d_l) max(0, -d_m) / sum_k max(0, d_k), d = left - right. The d must sum to zero.
inline double contact_surface(double jump_l, double jump_m, double sum_of_gains) {
  return jump_l > 0 && jump_m < 0 && sum_of_gains > 0 ? jump_l * -jump_m / sum_of_gains : 0;
}

}  // namespace cobasis
