// Ripples of surfaces that are compressed along themselves.
#include <algorithm>
#include <cmath>

#include "mesh/geometry.hpp"
#include "solver/sharp_interface.hpp"

namespace cobasis {

/// Of the planes whose contacts are listed.
void SharpInterface::find_ripple_speeds(Fields& fields) {
  const int n = fields.n_phases();
  for (int l = 0; l < n; ++l)
    for (int m = 0; m < n; ++m) {
      const auto& users = speed_users_[l * n + m];
      for (const auto& [cell, k] : users) cells_[k][cell].ripple_speed = 0;
      for (const int phase : {l, m}) {
        if (users.empty() || !kernels_[phase].ripple_speed) continue;
        ContactList& list = contacts_[l * n + m];
        kernels_[phase].ripple_speed(fields.phases[phase], list, static_cast<std::int32_t>(users.size()));
        for (std::size_t i = 0; i < users.size(); ++i) {
          double& speed = cells_[users[i].second][users[i].first].ripple_speed;
          speed = std::max(speed, list.speed[static_cast<std::int32_t>(i)]);
        }
      }
    }
}

/// How far the plane of a cell reaches in it [m].
double SharpInterface::extent(const Fields& fields, int k, std::int32_t cell) const {
  const PlaneSection& cut = cells_[k][cell].cut;
  if (fields.dimension == 3) return std::sqrt(cut.area);
  return mesh_.axisymmetric ? cut.area / (mesh_.centroid[cell].y + cut.centroid.y) : cut.area;
}

/// Levels the step that the planes of a face's cells leave there in phase k, `step` of the face: left minus right. As
/// nothing flows along a surface at rest, no Riemann problem sees it, and ripples two to four cells long would grow
/// where the surface is compressed along itself by a third. They are waves (ripple_speed), and this is their
/// dissipation: volume goes across the face with their speed times the step, and takes along what it contains. Of a
/// smooth surface the step is of third order; at edges, where only one of both cells is compressed, and where they move
/// apart faster than ripples do, it is none of ripples. Upwinding would have half the speed: that leaves some.
void SharpInterface::level(const Faces& faces, Fields& fields, int k, std::int32_t face, double step, double dt) {
  constexpr double farthest = 0.25;    // across the section of either cell, in a step
  constexpr double most_taken = 0.25;  // of a volume, in a step through a face
  constexpr double edge = 0.8;         // cosine of the angle between the normals
  const std::int32_t left = mesh_.left[face], right = mesh_.right[face];
  double speed = infinity, way = infinity;
  for (const std::int32_t cell : {left, right}) {
    const Cell& c = cells_[k][cell];
    if (!valid(k, cell) || c.ring != 1 || borrows(k, cell)) return;  // a borrowed state is not what is there
    const Point along = cross(c.plane.n, Point{faces.nx[face], faces.ny[face], faces.nz[face]});
    speed = std::min(speed, c.ripple_speed * length(along));
    way = std::min(way, farthest * extent(fields, k, cell));
  }
  if (speed == 0 || step == 0 || dot(cells_[k][left].plane.n, cells_[k][right].plane.n) < edge) return;
  const auto& state = fields.phases[k].primitive;
  double slip = 0;  // squared
  for (int d = 0; d < fields.dimension; ++d) slip += std::pow(state[1 + d][left] - state[1 + d][right], 2);
  if (slip > speed * speed) return;
  int other = -1;
  for (int m = 0; m < fields.n_phases(); ++m) {
    if (m == k) continue;
    const auto& alpha = fields.phases[m].alpha;
    const bool in_left = alpha[left] > 0, in_right = alpha[right] > 0;
    if (!in_left && !in_right) continue;
    if (other >= 0 || !in_left || !in_right) return;  // a third phase is near
    if (borrows(m, left) || borrows(m, right)) return;
    other = m;
  }
  if (other < 0) return;
  const bool to_right = step > 0;
  const std::int32_t from = to_right ? left : right, to = to_right ? right : left;
  const double content =
      std::min(fields.phases[k].alpha[from] * fields.volume[from], fields.phases[other].alpha[to] * fields.volume[to]);
  double flow = speed * std::fabs(step);  // [m/s]
  if (dt > 0) flow = std::min({flow, way / dt * std::fabs(step), most_taken * content / (faces.area[face] * dt)});
  fields.phases[k].levelling[face] = to_right ? flow : -flow;
  fields.phases[other].levelling[face] = to_right ? -flow : flow;
}

}  // namespace cobasis
