// Contacts of phases inside cells: one Riemann problem along the interface's own normal, so that bodies slide however
// the mesh lies.
#pragma once

#include "physics/ripples.hpp"
#include "physics/smooth_flow.hpp"
#include "solver/contact_sweep.hpp"
#include "solver/mean_state.hpp"

namespace cobasis {

/// Where phase l meets phase m.
struct ContactList {
  CompactList<std::int32_t> cell, cell_l, cell_m;  ///< where the contact acts; where the states are
  CompactList<double> area;                        ///< of the interface [m^2], in a plane [m]
  CompactList<double> normal[3];                   ///< unit normal from l to m
  CompactList<double> at[3];                       ///< its centroid, relative to the cell's [m]
  CompactList<double> speed;                       ///< u* of the contact along it [m/s]
  double friction = 0;                             ///< Coulomb's coefficient, of solids that rub

  explicit ContactList(std::size_t capacity = 0)
      : cell(capacity), cell_l(capacity), cell_m(capacity), area(capacity), speed(capacity) {
    for (auto& component : normal) component = CompactList<double>(capacity);
    for (auto& component : at) component = CompactList<double>(capacity);
  }
  void clear() {
    for (auto* list : {&cell, &cell_l, &cell_m}) list->clear();
    for (auto* list : {&area, &normal[0], &normal[1], &normal[2], &at[0], &at[1], &at[2]}) list->clear();
  }
  void push(std::int32_t where, std::int32_t of_l, std::int32_t of_m, double surface, const Point& n,
            const Point& centroid = {0, 0, 0}) {
    cell.push(where), cell_l.push(of_l), cell_m.push(of_m), area.push(surface);
    normal[0].push(n.x), normal[1].push(n.y), normal[2].push(n.z);
    at[0].push(centroid.x), at[1].push(centroid.y), at[2].push(centroid.z);
  }
  /// Repeats the last entry up to a whole pack.
  void fill() {
    for (auto* list : {&cell, &cell_l, &cell_m}) list->fill(pack_width);
    for (auto* list : {&area, &normal[0], &normal[1], &normal[2], &at[0], &at[1], &at[2]}) list->fill(pack_width);
  }
};

/// A right-handed frame around a unit normal.
template <class G, class Real>
Frame<G, Real> frame_around(const Real& nx, const Real& ny, const Real& nz) {
  if constexpr (G::dimension == 2) {
    return {{nx, ny, {}}, {-ny, nx, {}}, {{}, {}, Real(1.0)}};
  } else {
    const Mask<Real> along_x = magnitude(nx) > Real(0.6);  // t1 = y × n there, else x × n
    const Real other = select(along_x, nx, ny), zero(0.0);
    const Real of_length = 1.0 / square_root(other * other + nz * nz);
    const Vec3<Real> n{nx, ny, nz};
    const Vec3<Real> t1{of_length * select(along_x, nz, zero), of_length * select(along_x, zero, -nz),
                        of_length * select(along_x, -nx, ny)};
    return {n, t1, cross(n, t1)};
  }
}

template <class G, class Real>
Frame<G, Real> contact_frame(const ContactList& list, std::int32_t i) {
  return frame_around<G, Real>(load<Real>(&list.normal[0][i]), load<Real>(&list.normal[1][i]),
                               load<Real>(&list.normal[2][i]));
}

template <class G, Kind K, class Real>
Face<G, K, Real> contact_side(const Phase& phase, const Indices<Real>& cell, const Frame<G, Real>& frame) {
  const CellSide<Real> side{phase, cell};
  return load_face_state<G>(side, load_cobasis_of<G, K>(side), frame);
}

/// The state where the contact is at the middle of the step, by the slopes of its cell; the cell's own where they say
/// another volume of e.
template <class G, Kind K, class Real>
struct SlopedSide {
  using P = Primitives<G, K>;
  const Phase& phase;
  Indices<Real> cell;
  typename P::template State<Real> w;
  Real scale;  ///< of the metric

  SlopedSide(const Phase& of, const Indices<Real>& in, const ContactList& list, std::int32_t i) : phase(of), cell(in) {
    const auto mean = mean_state<G, K, Real>(phase, cell);
    for (int v = 0; v < P::size; ++v)
      w[v] = mean[v] + gather<Real>(phase.used_slopes.component(P::size * G::dimension + v), cell);
    for (int d = 0; d < G::dimension; ++d) {
      const Real r = load<Real>(&list.at[d][i]) - gather<Real>(phase.centre.component(d), cell);
      for (int v = 0; v < P::size; ++v)
        w[v] = w[v] + r * gather<Real>(phase.used_slopes.component(v * G::dimension + d), cell);
    }
    Mask<Real> good = w[P::rho] > Real(0.0);
    if constexpr (K == Kind::solid) {
      good = good && is_one_deformation(determinant(cobasis_of<G, K>(w)), determinant(cobasis_of<G, K>(mean)));
    }
    for (int v = 0; v < P::size; ++v) w[v] = select(good, w[v], mean[v]);
    if constexpr (K == Kind::solid) scale = metric_scale(cobasis_of<G, K>(w));
  }
  template <class L>
  Real primitive(int c) const {
    if (c < P::e) return w[c];
    if constexpr (K == Kind::solid)
      if (c == L::metric_scale) return scale;
    return gather<Real>(phase.primitive[c].data(), cell);
  }
  template <class L>
  Real cobasis(int c) const {
    return w[P::e + c];
  }
};

template <class G, Kind K, class Real>
Face<G, K, Real> sloped_contact_side(const Phase& phase, const Indices<Real>& cell, const Frame<G, Real>& frame,
                                     const ContactList& list, std::int32_t i) {
  if (phase.used_slopes.stride == 0) return contact_side<G, K, Real>(phase, cell, frame);
  const SlopedSide<G, K, Real> side(phase, cell, list, i);
  return load_face_state<G>(side, load_cobasis_of<G, K>(side), frame);
}

/// Adds to what a contact does to a phase in its cells, see Layout.
template <class G, Kind K, class Real>
void add_in_cell(Phase& phase, const Indices<Real>& cell, int c, const Real& value) {
  double* const to = phase.inner.component(c);
  scatter(gather<Real>(to, cell) + value, to, cell);
}

/// The phase's side of a contact at u*, P*, along its own outward normal frame.n; w: its tangential velocity there.
template <class G, Kind K, class Real, class Star, class Tangential>
void act_in_cell(Phase& phase, const Indices<Real>& cell, const Frame<G, Real>& frame, const Real& outward_area,
                 const Star& star, const Tangential& w) {
  using L = Layout<G, K>;
  const Real force = outward_area * star.P_star, moved = outward_area * star.u_star;
  add_in_cell<G, K>(phase, cell, L::inner_momentum, -(force * frame.n.x));
  add_in_cell<G, K>(phase, cell, L::inner_momentum + 1, -(force * frame.n.y));
  if constexpr (G::dimension == 3) add_in_cell<G, K>(phase, cell, L::inner_momentum + 2, -(force * frame.n.z));
  add_in_cell<G, K>(phase, cell, L::inner_energy, -(force * star.u_star));
  add_in_cell<G, K>(phase, cell, L::inner_alpha, moved);
  if constexpr (K == Kind::solid) {
    const Vector<G, Real> du =
        velocity_jump(frame, into_frame(frame, load_velocity<G, K>(CellSide<Real>{phase, cell})), star.u_star, w);
    const Cobasis<G, Real> e = load_cobasis<G, Real>(phase, cell);
    const Cobasis<G, Real> change = outward_area * fluctuation(Real(0.0), e, e, du, frame);
    for_each_component(change,
                       [&](int c, const Real& value) { add_in_cell<G, K>(phase, cell, L::inner_cobasis + c, value); });
  }
}

template <class G, Kind K, class Real>
auto free_tangential(const Face<G, K, Real>& s, double side) {
  if constexpr (K == Kind::solid)
    return free_surface_velocity(s, Real(side));
  else
    return Vec3<Zero, Real, Third<G, Real>>{{}, s.u.y, s.u.z};
}

/// `SpeedOnly`: only finds the list's speeds.
template <class G, Kind Kl, Kind Km, Tangent T, class Real, bool SpeedOnly>
COBASIS_KERNEL void contact_in_cells(Phase& phase_l, Phase& phase_m, ContactList& list, std::int32_t n) {
  for (std::int32_t i = 0; i < n; i += lanes<Real>) {
    const Indices<Real> cell = load_indices<Real>(&list.cell[i]), cell_l = load_indices<Real>(&list.cell_l[i]),
                        cell_m = load_indices<Real>(&list.cell_m[i]);
    const Frame<G, Real> frame = contact_frame<G, Real>(list, i);
    const auto side_of_contact = [&]<Kind K>(const Phase& phase, const Indices<Real>& in) {
      return SpeedOnly ? contact_side<G, K, Real>(phase, in, frame)
                       : sloped_contact_side<G, K, Real>(phase, in, frame, list, i);
    };
    const auto l = side_of_contact.template operator()<Kl>(phase_l, cell_l);
    const auto m = side_of_contact.template operator()<Km>(phase_m, cell_m);
    const LongitudinalStar<Real> star = longitudinal<Real>(l, m);
    store(star.u_star, &list.speed[i]);
    if constexpr (!SpeedOnly) {
      const Real area = load<Real>(&list.area[i]);
      if constexpr (T != Tangent::free) {
        const auto [shear, power_l, power_m] = tangential_contact<T>(l, m, star.P_star, list.friction);
        const Vector<G, Real> force = area * out_of_frame(frame, shear.tau);
        const auto pull = [&]<Kind K>(Phase& phase, const Vector<G, Real>& by, const Real& work) {
          using L = Layout<G, K>;
          add_in_cell<G, K>(phase, cell, L::inner_momentum, by.x);
          add_in_cell<G, K>(phase, cell, L::inner_momentum + 1, by.y);
          if constexpr (G::dimension == 3) add_in_cell<G, K>(phase, cell, L::inner_momentum + 2, by.z);
          add_in_cell<G, K>(phase, cell, L::inner_energy, work);
        };
        pull.template operator()<Kl>(phase_l, force, area * power_l);
        pull.template operator()<Km>(phase_m, (-1.0) * force, -(area * power_m));
        act_in_cell<G, Kl>(phase_l, cell, frame, area, star, shear.w_l);
        act_in_cell<G, Km>(phase_m, cell, frame, -area, star, shear.w_r);
      } else {
        act_in_cell<G, Kl>(phase_l, cell, frame, area, star, free_tangential<G, Kl, Real>(l, 1.0));
        act_in_cell<G, Km>(phase_m, cell, frame, -area, star, free_tangential<G, Km, Real>(m, -1.0));
      }
    }
  }
}

/// The same before a void at pressure p0, which is phase m.
template <class G, Kind K, class Real, bool SpeedOnly>
COBASIS_KERNEL void free_surface_in_cells(Phase& phase, double p0, ContactList& list, std::int32_t n) {
  for (std::int32_t i = 0; i < n; i += lanes<Real>) {
    const Indices<Real> cell = load_indices<Real>(&list.cell[i]), cell_l = load_indices<Real>(&list.cell_l[i]);
    const Frame<G, Real> frame = contact_frame<G, Real>(list, i);
    const auto l = SpeedOnly ? contact_side<G, K, Real>(phase, cell_l, frame)
                             : sloped_contact_side<G, K, Real>(phase, cell_l, frame, list, i);
    const LongitudinalStar<Real> star = free_surface<Real>(l, Real(p0));
    store(star.u_star, &list.speed[i]);
    if constexpr (!SpeedOnly)
      act_in_cell<G, K>(phase, cell, frame, load<Real>(&list.area[i]), star, free_tangential<G, K, Real>(l, 1.0));
  }
}

/// The list's speeds: of ripples along surfaces of a solid with the list's normals.
template <class G, class Real>
COBASIS_KERNEL void ripple_speeds(const Phase& phase, ContactList& list, std::int32_t n) {
  for (std::int32_t i = 0; i < n; i += lanes<Real>) {
    const CellSide<Real> side{phase, load_indices<Real>(&list.cell[i])};
    const SolidState<G, Real> state = load_solid_state<G>(side, load_cobasis_of<G, Kind::solid>(side));
    store(ripple_speed(phase.material, state, contact_frame<G, Real>(list, i)), &list.speed[i]);
  }
}

}  // namespace cobasis
