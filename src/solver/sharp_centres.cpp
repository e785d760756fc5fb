// Where the phases lie in cells and on faces that an interface crosses.
#include <utility>

#include "mesh/geometry.hpp"
#include "solver/sharp_interface.hpp"

namespace cobasis {

/// Centroids of the parts of a whole, a cell or a face, relative to its own: part_of(k) gives the share and the
/// centroid of a phase with planes, place(phase, d) says where a component is kept. The phase that takes the rest lies
/// so that all together have the centroid of the whole.
template <class Part, class Place>
void SharpInterface::put_centroids(Fields& fields, const Part& part_of, const Place& place) const {
  const auto put = [&](Phase& phase, const Point& at) {
    place(phase, 0) = at.x;
    place(phase, 1) = at.y;
    if (fields.dimension == 3) place(phase, 2) = at.z;
  };
  Point rest{0, 0, 0};
  double of_rest = 1;
  for (const int k : planes_of_) {
    const auto [share, at] = part_of(k);
    put(fields.phases[k], at);
    rest = rest - share * at;
    of_rest -= share;
  }
  if (rest_ >= 0 && !fields.phases[rest_].is_void)
    put(fields.phases[rest_], of_rest > 0 ? 1 / of_rest * rest : Point{0, 0, 0});
}

/// In cut cells, and in those of other ranks that are halo here.
void SharpInterface::find_centres(Fields& fields) {
  for (Phase& phase : fields.phases)
    for (int d = 0; d < fields.dimension && !phase.is_void; ++d)
      for (const std::int32_t cell : centred_) phase.centre.component(d)[cell] = 0;
  centred_.clear();
  for (const auto* cells : {&cut_cells_, &mixed_cells_})
    for (const std::int32_t cell : *cells) {
      const auto part_of = [&](int k) {
        if (!is_cut(fields, k, cell)) return std::pair(0.0, Point{0, 0, 0});
        return std::pair(fields.phases[k].alpha[cell], centroid_below(find_corners(cell), cells_[k][cell].plane));
      };
      put_centroids(fields, part_of, [&](Phase& phase, int d) -> double& { return phase.centre.component(d)[cell]; });
      centred_.push_back(cell);
    }
  exchange_cells(exchange_, mesh_.neighbours, [&](std::int32_t cell, const auto& with) {
    if (fields.pure[cell] >= 0) return;
    if (cell >= mesh_.n_owned) centred_.push_back(cell);
    for (Phase& phase : fields.phases)
      for (int d = 0; d < fields.dimension && !phase.is_void; ++d) with(phase.centre.component(d)[cell]);
  });
}

/// On a face at the middle of the step, by the planes of the cell on one side.
void SharpInterface::find_wetted_centroids(Fields& fields, std::int32_t face, int side, double dt) const {
  const std::int32_t cell = side == 0 ? mesh_.left[face] : mesh_.right[face];
  const auto part_of = [&](int k) {
    const double share = fields.phases[k].wetted[0][face];
    if (!valid(k, cell) || !(share > 0 && share < 1)) return std::pair(share, Point{0, 0, 0});
    const Cell& c = cells_[k][cell];
    const CutPlane at_mid_step{c.plane.n, c.plane.d + 0.5 * c.speed * dt};
    return std::pair(share, wetted_centroid(outlines_[face], outlines_.center(face, side), at_mid_step));
  };
  put_centroids(fields, part_of, [&](Phase& phase, int d) -> double& { return phase.wetted_at[d][face]; });
}

void SharpInterface::forget_wetted_centroids(Fields& fields, std::int32_t face) const {
  for (Phase& phase : fields.phases)
    for (int d = 0; d < fields.dimension && !phase.is_void; ++d) phase.wetted_at[d][face] = 0;
}

}  // namespace cobasis
