// What a face does to a phase that is on both of its sides: load both, turn them into its frame, solve the longitudinal
// and the shear problem, turn back, store. One template for each situation; lists of faces keep the lanes of a pack
// full.
#pragma once

#include "physics/cobasis_flux.hpp"
#include "physics/longitudinal.hpp"
#include "physics/shear.hpp"
#include "physics/smooth_flow.hpp"
#include "solver/faces.hpp"
#include "solver/field.hpp"

namespace cobasis {

/// Where a sweep finds the state of one side: in the cells there (first order) …
template <class Real>
struct CellSide {
  const Phase& phase;
  Indices<Real> cell;

  template <class L>
  Real primitive(int c) const {
    return gather<Real>((c == L::rho ? phase.density() : phase.primitive[c]).data(), cell);
  }
  template <class L>
  Real cobasis(int c) const {
    return gather<Real>(phase.conserved[L::cobasis + c].data(), cell);
  }
};

/// … or reconstructed at the faces.
template <class Real>
struct FaceSide {
  const Phase& phase;
  Indices<Real> at;  ///< face, plus the stride on the right side
  bool consecutive;

  Real component(int c) const {
    const double* const from = phase.face_states.component(c);
    return consecutive ? load<Real>(from + at[0]) : gather<Real>(from, at);
  }
  template <class L>
  Real primitive(int c) const {
    return component(c);
  }
  template <class L>
  Real cobasis(int c) const {
    return component(L::n_primitive + c);
  }
};

template <int Order, class Real>
auto side_of(const Phase& phase, const FacePack<Real>& face, const Indices<Real>& cell, int side) {
  if constexpr (Order == 1) {
    return CellSide<Real>{phase, cell};
  } else {
    FaceSide<Real> at{phase, face.at, face.consecutive};
    const auto shift = static_cast<std::int32_t>(side * phase.face_states.stride);
    for (auto& i : at.at) i += shift;
    return at;
  }
}

template <class G, Kind K, class Side>
auto load_velocity(const Side& side) {
  using L = Layout<G, K>;
  using Real = decltype(side.template primitive<L>(0));
  Vector<G, Real> v;
  v.x = side.template primitive<L>(L::u);
  v.y = side.template primitive<L>(L::u + 1);
  if constexpr (G::dimension == 3) v.z = side.template primitive<L>(L::u + 2);
  return v;
}

template <class G, class Real>
Cobasis<G, Real> load_cobasis(const Phase& phase, const Indices<Real>& at) {
  return make_cobasis<G>(
      [&](int c) { return gather<Real>(phase.conserved[Layout<G, Kind::solid>::cobasis + c].data(), at); });
}

/// Calls f(component, value) for the components of a cobasis that exist in the geometry.
template <class G, class Real, class F>
void for_each_component(const Cobasis<G, Real>& e, F&& f) {
  f(0, e.e1.x), f(1, e.e1.y);
  if constexpr (G::dimension == 2) {
    f(2, e.e2.x), f(3, e.e2.y), f(4, e.e3.z);
  } else {
    f(2, e.e1.z), f(3, e.e2.x), f(4, e.e2.y), f(5, e.e2.z), f(6, e.e3.x), f(7, e.e3.y), f(8, e.e3.z);
  }
}

template <class G, Kind K, class Side>
auto load_fluid_state(const Side& side) {
  using L = Layout<G, K>;
  using Real = decltype(side.template primitive<L>(0));
  return FluidState<G, Real>{side.template primitive<L>(L::rho), load_velocity<G, K>(side),
                             side.template primitive<L>(L::p), side.template primitive<L>(L::ch2),
                             side.template primitive<L>(L::E)};
}

/// A fluid's state carries no cobasis: Zero stands in its place.
template <class G, Kind K, class Side>
auto load_cobasis_of(const Side& side) {
  if constexpr (K == Kind::solid)
    return make_cobasis<G>([&](int c) { return side.template cobasis<Layout<G, K>>(c); });
  else
    return Zero{};
}

template <class G, class Side, class Real>
FluidFace<G, Real> load_face_state(const Side& side, Zero, const Frame<G, Real>& frame) {
  return face_state(load_fluid_state<G, Kind::fluid>(side), frame);
}
/// The metric is formed from e, which is needed anyway; a cell keeps only its scale.
template <class G, class Side, class Real>
SolidState<G, Real> load_solid_state(const Side& side, const Cobasis<G, Real>& e) {
  using L = Layout<G, Kind::solid>;
  const Real scale = side.template primitive<L>(L::metric_scale);
  return {load_fluid_state<G, Kind::solid>(side), scaled_metric(e, scale)};
}
template <class G, class Side, class Real>
SolidFace<G, Real> load_face_state(const Side& side, const Cobasis<G, Real>& e, const Frame<G, Real>& frame) {
  return face_state(side.phase.material, load_solid_state<G>(side, e), frame);
}

/// Mixed slots have their own numbering in the buffers that pure faces do not need.
inline std::int32_t first_mixed_slot(const Faces& faces) {
  return pack_width + (faces.n + 5 * pack_width) / pack_width * pack_width;
}
inline std::int32_t gain_slot(std::int32_t slot, std::int32_t first_mixed) {
  return slot < first_mixed ? 0 : slot - first_mixed + pack_width;
}

/// Lane j of one side is read where the other side is.
template <class Real>
void stand_in(CellSide<Real>& absent, const CellSide<Real>& present, int j) {
  absent.cell[j] = present.cell[j];
}
template <class Real>
void stand_in(FaceSide<Real>& absent, const FaceSide<Real>& present, int j) {
  absent.at[j] = present.at[j];
  absent.consecutive = false;
}

/// What each side gains where ripples are levelled: volume, with mass, momentum, energy and cobasis of the side from
/// which it comes. `flow`: from left to right [m^3/s].
template <class G, Kind K, class Real, class E>
void keep_levelling(const Phase& phase, const FacePack<Real>& face, const Faces& faces, const Face<G, K, Real>& l,
                    const Face<G, K, Real>& r, const E& e_l, const E& e_r, const Frame<G, Real>& frame, double* gain) {
  using L = Layout<G, K>;
  const Real flow = face(phase.levelling) * face(faces.area);
  const Mask<Real> from_left = flow > Real(0.0);
  const auto u_l = out_of_frame(frame, l.u), u_r = out_of_frame(frame, r.u);
  const Real mass = flow * select(from_left, l.rho, r.rho), E_from = select(from_left, l.E, r.E);
  for (int side = 0; side < 2; ++side) {
    const Real sign(side == 0 ? -1.0 : 1.0);
    const auto keep = [&](int c, const Real& value) {
      store(sign * value, gain + (side * L::gain_side + c) * pack_width);
    };
    keep(L::mass, mass);
    keep(L::momentum, mass * select(from_left, u_l.x, u_r.x));
    keep(L::momentum + 1, mass * select(from_left, u_l.y, u_r.y));
    if constexpr (G::dimension == 3) keep(L::momentum + 2, mass * select(from_left, u_l.z, u_r.z));
    keep(L::energy, mass * E_from);
    keep(L::gain_alpha, flow);
    if constexpr (K == Kind::solid) {
      const Indices<Real> cell = face(side == 0 ? faces.left : faces.right);
      for_each_component(upwind(from_left, e_l, e_r), [&](int c, const Real& value) {
        keep(L::gain_cobasis + c, flow * (gather<Real>(phase.conserved[L::cobasis + c].data(), cell) - value));
      });
    }
  }
}

/// What lies right of a face: another cell, the mirror image of the left one, or what the case prescribes.
enum class Beyond { cell, mirror, prescribed };

/// The left state goes on into an opening to a pressure: star state along its own wave; where it is faster than that,
/// the left state itself.
template <class Real, class FaceL>
LongitudinalStar<Real> select_outlet(const Mask<Real>& outlet, const FaceL& l, const Real& pressure,
                                     const LongitudinalStar<Real>& wall) {
  const LongitudinalStar<Real> open = free_surface<Real>(l, pressure);
  return {.u_star = select(outlet, open.u_star, wall.u_star),
          .P_star = select(outlet, open.P_star, wall.P_star),
          .from_left = (outlet && open.from_left) || (!outlet && wall.from_left),
          .u_f = select(outlet, open.u_f, wall.u_f),
          .P_f = select(outlet, open.P_f, wall.P_f),
          .r = select(outlet, open.r, wall.r),
          .mass_speed = select(outlet, open.mass_speed, wall.mass_speed),
          .fastest = select(outlet, open.fastest, wall.fastest)};
}

/// At second order the cobases on both sides of a face are turned towards each other, among their own vectors, with
/// this part of the speed of shear waves. Stress and energy do not change by it, so nothing else would keep neighbours
/// from turning apart by errors of grad u that alternate from cell to cell; carried on, the mean of two that are turned
/// has another volume than either.
inline constexpr double turning = 0.25;

/// Riemann problem of a phase with itself. Pure: the whole face. Mixed: its share S_kk (possibly 0); the traction and
/// speeds of both sides are kept for the pairs that the face's phases form.
template <class G, Kind K, class Real, bool Mixed, Beyond B, int Order>
COBASIS_KERNEL void sweep_same(Faces& faces, Phase& phase, Segment segment) {
  using L = Layout<G, K>;
  const CompactList<std::int32_t>& list = Mixed ? phase.lists.mixed : phase.lists.pure;
  const std::int32_t first_slot = Mixed ? first_mixed_slot(faces) : pack_width;
  for (std::int32_t i = segment.first; i < segment.last; i += lanes<Real>) {
    const FacePack<Real> face(&list[i]);
    const Indices<Real> left = face(faces.left), right = face(faces.right);
    auto side_l = side_of<Order>(phase, face, left, 0), side_r = side_of<Order>(phase, face, right, 1);
    if constexpr (Mixed) {
      for (int j = 0; j < lanes<Real>;
           ++j) {  // where the phase is absent on one side, the other side's state stands in
        const bool in_left = phase.alpha[left[j]] > 0, in_right = phase.alpha[right[j]] > 0;
        if (in_right && !in_left) stand_in(side_l, side_r, j);
        if (in_left && !in_right) stand_in(side_r, side_l, j);
      }
    }
    const Frame<G, Real> frame = load_frame<G, Real>(faces, face);
    const auto e_l = load_cobasis_of<G, K>(side_l);
    const auto e_r = load_cobasis_of<G, K>(B == Beyond::cell ? side_r : side_l);
    Face<G, K, Real> l = load_face_state<G>(side_l, e_l, frame), r;
    [[maybe_unused]] Mask<Real> outlet;
    if constexpr (B == Beyond::mirror) {
      r = mirrored(l);
    } else if constexpr (B == Beyond::prescribed) {
      const Prescribed& given = faces.prescribed;
      Vector<G, Real> wall;
      wall.x = face(given.u[0]), wall.y = face(given.u[1]);
      if constexpr (G::dimension == 3) wall.z = face(given.u[2]);
      outlet = face(given.outlet) > Real(0.0);
      const auto in_frame = into_frame(frame, wall);
      r = behind_wall(l, Vector<G, Real>{in_frame.x, in_frame.y, in_frame.z}, face(given.bonded), outlet);
    } else {
      r = load_face_state<G>(side_r, e_r, frame);
    }
    const Real signal = faster(signal_speed(l), signal_speed(r));
    if (phase.low_mach != 0) reduce_slow_jump(l, r, Real(phase.low_mach));
    LongitudinalStar<Real> star = longitudinal<Real>(l, r);
    if constexpr (B == Beyond::prescribed) star = select_outlet(outlet, l, face(faces.prescribed.pressure), star);
    raise_fastest(faces, face, faster(signal, star.fastest));
    Flux<G, Real> flux = eulerian_flux<G>(star, l, r);
    Real weight = face(faces.area);
    if constexpr (Mixed) weight = weight * load<Real>(&phase.lists.mixed_share[i]);

    const std::int32_t slot = first_slot + i;
    double* const out = phase.flux.data() + slot_base(slot, L::n_flux);
    const auto keep = [&](int c, const Real& value) { store(value, out + c * pack_width); };
    if constexpr (K == Kind::solid) {
      const ShearStar<G, Real> shear = bonded_shear(l, r);
      flux.momentum = flux.momentum - shear.tau;
      flux.energy = flux.energy - dot(shear.tau, shear.w_l);

      const Real moved = weight * star.u_f;
      const Vector<G, Real> u_star = out_of_frame(frame, Vec3{star.u_f, shear.w_l.y, shear.w_l.z});
      const Cobasis<G, Real> e_f =
          B == Beyond::mirror ? e_l : stretched(upwind(star.from_left, e_l, e_r), frame, star.r);
      for_each_component(e_f, [&](int c, const Real& value) { keep(L::flux_cobasis + c, moved * value); });
      keep(L::flux_volume, moved);
      keep(L::flux_velocity, weight * u_star.x), keep(L::flux_velocity + 1, weight * u_star.y);
      if constexpr (G::dimension == 3) keep(L::flux_velocity + 2, weight * u_star.z);
      keep(L::flux_area, weight);
      if constexpr (Order == 2) {
        std::array<Real, L::n_turn> turned;
        turned.fill(Real(0.0));
        if constexpr (B == Beyond::cell) {
          turned = turn(e_l, e_r, frame.n);
          for (auto& angle : turned) angle = (turning * weight * faster(l.cs, r.cs)) * angle;
        }
        for (int c = 0; c < L::n_turn; ++c) keep(L::flux_turn + c, turned[c]);
      }
    }
    const Vector<G, Real> momentum = out_of_frame(frame, flux.momentum);
    keep(L::mass, weight * flux.mass);
    keep(L::momentum, weight * momentum.x), keep(L::momentum + 1, weight * momentum.y);
    if constexpr (G::dimension == 3) keep(L::momentum + 2, weight * momentum.z);
    keep(L::energy, weight * flux.energy);

    if constexpr (Mixed) {
      const std::int32_t own = gain_slot(slot, first_slot);
      double* const gain = phase.gain.data() + slot_base(own, L::n_gain);
      for (int c = 0; c < L::n_gain; ++c) store(Real(0.0), gain + c * pack_width);
      if constexpr (B == Beyond::cell)
        if (!phase.levelling.empty() && any(magnitude(face(phase.levelling)) > Real(0.0)))
          keep_levelling<G, K>(phase, face, faces, l, r, e_l, e_r, frame, gain);
      double* const sides = phase.sides.data() + slot_base(own, 2 * L::n_side);
      const auto keep_side = [&](int side, const Face<G, K, Real>& s) {
        double* const to = sides + side * L::n_side * pack_width;
        store(s.P, to);
        store(s.c1, to + pack_width);
        if constexpr (K == Kind::solid) {
          store(s.cs, to + 2 * pack_width);
          store(s.tau.y, to + 3 * pack_width);
          if constexpr (G::dimension == 3) store(s.tau.z, to + 4 * pack_width);
        }
      };
      keep_side(0, l);
      keep_side(1, r);
    }
  }
}

}  // namespace cobasis
