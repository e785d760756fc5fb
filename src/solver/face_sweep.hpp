// What a face does: load both sides, turn them into its frame, solve the longitudinal and the shear problem, turn back,
// store. One template for each situation; lists of faces keep the lanes of a pack full.
#pragma once

#include "physics/cobasis_flux.hpp"
#include "physics/longitudinal.hpp"
#include "physics/shear.hpp"
#include "physics/smooth_flow.hpp"
#include "solver/faces.hpp"
#include "solver/field.hpp"

namespace cobasis {

/// Faces of one ordered pair of phases (l left, m right, l != m) with their S_lm. For a void partner `side` says on
/// which side the material is (0 left, 1 right).
struct PairList {
  CompactList<std::int32_t> face;
  CompactList<double> share;
  std::int32_t side = 0;
  double friction = 0;  ///< Coulomb's coefficient, of solids that rub
};

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

/// Density, velocity, pressure and cobasis of cells.
template <class G, Kind K, class Real>
typename Primitives<G, K>::template State<Real> mean_state(const Phase& phase, const Indices<Real>& cell) {
  using P = Primitives<G, K>;
  typename P::template State<Real> w;
  for (int v = 0; v < P::size; ++v)
    w[v] = gather<Real>((v == P::rho ? phase.density()
                         : v < P::e  ? phase.primitive[v]
                                     : phase.conserved[Layout<G, K>::cobasis + v - P::e])
                            .data(),
                        cell);
  return w;
}

/// What slopes of e say of a volume, relative to what that of the density or the mean says. Beyond these bounds the
/// components no longer belong to one deformation.
inline constexpr double least_det = 0.5, most_det = 2;

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
SolidFace<G, Real> load_face_state(const Side& side, const Cobasis<G, Real>& e, const Frame<G, Real>& frame) {
  using L = Layout<G, Kind::solid>;
  const Real scale = side.template primitive<L>(L::metric_scale);
  return face_state(side.phase.material,
                    SolidState<G, Real>{load_fluid_state<G, Kind::solid>(side), scaled_metric(e, scale)}, frame);
}

/// The slots of one pack in one buffer: component c of lane i at data[at[i] + c * pack_width].
template <class Real>
struct SlotPack {
  double* data;
  Indices<Real> at;

  void add(int c, const Real& value) const {
    double* to = data + c * pack_width;
    scatter(gather<Real>(to, at) + value, to, at);
  }
  Real read(int c) const { return gather<Real>(data + c * pack_width, at); }
};

template <class Real>
SlotPack<Real> slot_pack(RawStorage& buffer, int n, const Indices<Real>& slots) {
  SlotPack<Real> pack{buffer.data(), {}};
  for (int i = 0; i < lanes<Real>; ++i) pack.at[i] = slot_base(slots[i], n);
  return pack;
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
      std::array<Real, L::n_turn> turned;
      turned.fill(Real(0.0));
      if constexpr (Order == 2 && B == Beyond::cell) {
        turned = turn(e_l, e_r, frame.n);
        for (auto& angle : turned) angle = (turning * weight * faster(l.cs, r.cs)) * angle;
      }
      for (int c = 0; c < L::n_turn; ++c) keep(L::flux_turn + c, turned[c]);
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

/// The state of one side as sweep_same left it, with density, velocity and energy from where they lie.
template <class G, Kind K, class Real, class Side>
Face<G, K, Real> recall_side(const Side& at, const SlotPack<Real>& sides, int side, const Frame<G, Real>& frame) {
  using L = Layout<G, K>;
  const int c = side * L::n_side;
  Face<G, K, Real> s;
  s.rho = at.template primitive<L>(L::rho);
  s.u = into_frame(frame, load_velocity<G, K>(at));
  s.E = at.template primitive<L>(L::E);
  s.P = sides.read(c);
  s.c1 = sides.read(c + 1);
  if constexpr (K == Kind::solid) {
    s.cs = sides.read(c + 2);
    s.tau.y = sides.read(c + 3);
    if constexpr (G::dimension == 3) s.tau.z = sides.read(c + 4);
  }
  return s;
}

/// What a contact moves per unit area along the normal of its frame, in Cartesian components.
template <class G, class Real>
struct ContactFlux {
  Real mass;
  Vector<G, Real> momentum, convected_momentum, force;  ///< Eulerian; without the contact's own pressure; that pressure
  Real energy, convected_energy, work;

  ContactFlux(const LongitudinalStar<Real>& star, const Flux<G, Real>& flux, const Frame<G, Real>& frame)
      : mass(flux.mass),
        momentum(out_of_frame(frame, flux.momentum)),
        force(star.P_star * frame.n),
        energy(flux.energy),
        convected_energy(flux.convected_energy + (star.P_f * star.u_f - star.P_star * star.u_star)),
        work(star.P_star * star.u_star) {
    auto convected = flux.convected_momentum;
    convected.x = convected.x + (star.P_f - star.P_star);
    convected_momentum = out_of_frame(frame, convected);
  }
};

/// Everything a pair adds to the slots of one of its phases.
template <class G, Kind K, class Real>
struct PairSlots {
  using L = Layout<G, K>;
  SlotPack<Real> gain, sides;

  PairSlots(const Faces& faces, Phase& phase, const FacePack<Real>& face) {
    const Indices<Real> slots = face(phase.lists.slot_of_face);
    Indices<Real> own;
    for (int i = 0; i < lanes<Real>; ++i) own[i] = gain_slot(slots[i], first_mixed_slot(faces));
    gain = slot_pack<Real>(phase.gain, L::n_gain, own);
    sides = slot_pack<Real>(phase.sides, 2 * L::n_side, own);
  }

  /// What the cell on one side gains.
  void add_gain(int side, const Real& mass, const Vector<G, Real>& momentum, const Real& energy,
                const Real& alpha) const {
    const int c = side * L::gain_side;
    gain.add(c + L::mass, mass);
    gain.add(c + L::momentum, momentum.x);
    gain.add(c + L::momentum + 1, momentum.y);
    if constexpr (G::dimension == 3) gain.add(c + L::momentum + 2, momentum.z);
    gain.add(c + L::energy, energy);
    gain.add(c + L::gain_alpha, alpha);
  }
  void add_cobasis(int side, const Cobasis<G, Real>& change) const {
    const int first = side * L::gain_side + L::gain_cobasis;
    for_each_component(change, [&](int c, const Real& value) { gain.add(first + c, value); });
  }
};

template <class G, class Real, class Velocity, class Tangential>
Vector<G, Real> velocity_jump(const Frame<G, Real>& frame, const Velocity& of_cell, const Real& u,
                              const Tangential& w) {
  return out_of_frame(frame, Vec3{u - of_cell.x, w.y - of_cell.y, w.z - of_cell.z});
}

/// Velocity of a phase in its cell, in the face's frame.
template <int Order, Kind K, class G, class Real, class FaceState>
auto cell_velocity(const Phase& phase, const Indices<Real>& cell, const Frame<G, Real>& frame, const FaceState& s) {
  if constexpr (Order == 1)
    return s.u;
  else
    return into_frame(frame, load_velocity<G, K>(CellSide<Real>{phase, cell}));
}

/// Sliding phases, a fluid or a void are free; solids that adhere are bonded; solids with friction rub.
enum class Tangent { free, bonded, rubbing };

/// What acts along a contact of solids: stress and velocities, and the power that goes from m to l per unit area. Heat
/// of friction stays in equal parts on both sides: with the mean velocity of the surfaces, none is lost.
template <class G, class Real>
struct TangentialContact {
  ShearStar<G, Real> shear;
  Real power_l, power_m;
};
template <Tangent T, class G, class Real>
TangentialContact<G, Real> tangential_contact(const SolidFace<G, Real>& l, const SolidFace<G, Real>& m,
                                              [[maybe_unused]] const Real& P_star, [[maybe_unused]] double friction) {
  if constexpr (T == Tangent::bonded) {
    const ShearStar<G, Real> shear = bonded_shear(l, m);
    return {shear, dot(shear.tau, shear.w_l), dot(shear.tau, shear.w_r)};
  } else {
    const ShearStar<G, Real> shear = rubbing_shear(l, m, friction * larger(P_star, Real(0.0)));
    const Real power = 0.5 * dot(shear.tau, shear.w_l + shear.w_r);
    return {shear, power, power};
  }
}

/// Contact of two different phases, l left and m right, along the face normal.
template <class G, Kind Kl, Kind Km, Tangent T, class Real, int Order>
COBASIS_KERNEL void sweep_pair(Faces& faces, Phase& phase_l, Phase& phase_m, const PairList& list, Segment segment) {
  for (std::int32_t i = segment.first; i < segment.last; i += lanes<Real>) {
    const FacePack<Real> face(&list.face[i]);
    const Indices<Real> left = face(faces.left), right = face(faces.right);
    const Frame<G, Real> frame = load_frame<G, Real>(faces, face);
    const PairSlots<G, Kl, Real> slots_l(faces, phase_l, face);
    const PairSlots<G, Km, Real> slots_m(faces, phase_m, face);
    const auto side_l = side_of<Order>(phase_l, face, left, 0), side_m = side_of<Order>(phase_m, face, right, 1);
    const auto l = recall_side<G, Kl, Real>(side_l, slots_l.sides, 0, frame);
    const auto m = recall_side<G, Km, Real>(side_m, slots_m.sides, 1, frame);

    const LongitudinalStar<Real> star = longitudinal<Real>(l, m);
    raise_fastest(faces, face, star.fastest);  // in strong tension faster than either side's own signal
    const ContactFlux<G, Real> contact(star, eulerian_flux<G>(star, l, m), frame);
    const Real weight = face(faces.area) * load<Real>(&list.share[i]);
    const Real zero(0.0);
    const Real weight_l = select(star.from_left, weight, zero), weight_m = select(star.from_left, zero, weight);

    // The phase at the face leaves its own cell and enters the other, where the contact moves; there the other phase
    // gives way. (19) and the Lagrangian part, summed per cell and phase before anything is rounded.
    slots_l.add_gain(0, -(weight_l * contact.mass), (-1.0) * (weight_l * contact.momentum + weight_m * contact.force),
                     -(weight_l * contact.energy + weight_m * contact.work), weight_m * star.u_star);
    slots_l.add_gain(1, weight_l * contact.mass, weight_l * contact.convected_momentum,
                     weight_l * contact.convected_energy, weight_l * star.u_star);
    slots_m.add_gain(1, weight_m * contact.mass, weight_m * contact.momentum + weight_l * contact.force,
                     weight_m * contact.energy + weight_l * contact.work, -(weight_l * star.u_star));
    slots_m.add_gain(0, -(weight_m * contact.mass), (-weight_m) * contact.convected_momentum,
                     -(weight_m * contact.convected_energy), -(weight_m * star.u_star));

    [[maybe_unused]] ShearStar<G, Real> shear;
    if constexpr (T != Tangent::free) {
      const auto tangential = tangential_contact<T>(l, m, star.P_star, list.friction);
      shear = tangential.shear;
      const Vector<G, Real> force = weight * out_of_frame(frame, shear.tau);
      slots_l.add_gain(0, zero, force, weight * tangential.power_l, zero);
      slots_m.add_gain(1, zero, (-1.0) * force, -(weight * tangential.power_m), zero);
    } else {
      if constexpr (Kl == Kind::solid) shear.w_l = free_surface_velocity(l, Real(1.0));
      if constexpr (Km == Kind::solid) shear.w_r = free_surface_velocity(m, Real(-1.0));
    }
    if constexpr (Kl == Kind::solid) {
      const Cobasis<G, Real> e = load_cobasis<G, Real>(phase_l, left),
                             e_f = stretched(load_cobasis_of<G, Kl>(side_l), frame, star.r);
      const Vector<G, Real> du = velocity_jump(frame, cell_velocity<Order, Kl>(phase_l, left, frame, l),
                                               select(star.from_left, star.u_f, star.u_star), shear.w_l);
      slots_l.add_cobasis(0, weight * fluctuation(select(star.from_left, star.u_f, zero), e_f, e, du, frame));
      const Cobasis<G, Real> e_right = load_cobasis<G, Real>(phase_l, right);
      slots_l.add_cobasis(1, (-weight_l) * invader_fluctuation(star.u_star, star.u_f, e_f, e_right, frame));
    }
    if constexpr (Km == Kind::solid) {
      const Cobasis<G, Real> e = load_cobasis<G, Real>(phase_m, right),
                             e_f = stretched(load_cobasis_of<G, Km>(side_m), frame, star.r);
      const Vector<G, Real> du = velocity_jump(frame, cell_velocity<Order, Km>(phase_m, right, frame, m),
                                               select(star.from_left, star.u_star, star.u_f), shear.w_r);
      slots_m.add_cobasis(1, (-weight) * fluctuation(select(star.from_left, zero, star.u_f), e_f, e, du, frame));
      const Cobasis<G, Real> e_left = load_cobasis<G, Real>(phase_m, left);
      slots_m.add_cobasis(0, weight_m * invader_fluctuation(star.u_star, star.u_f, e_f, e_left, frame));
    }
  }
}

/// A material before a void at pressure p0: a free surface. Solved along the material's outward normal.
template <class G, Kind K, class Real, int Order>
COBASIS_KERNEL void sweep_free_surface(Faces& faces, Phase& phase, double p0, const PairList& list, Segment segment) {
  for (std::int32_t i = segment.first; i < segment.last; i += lanes<Real>) {
    const FacePack<Real> face(&list.face[i]);
    const Indices<Real> inside = face(list.side == 0 ? faces.left : faces.right);
    const Indices<Real> outside = face(list.side == 0 ? faces.right : faces.left);
    Frame<G, Real> frame = load_frame<G, Real>(faces, face);
    const Real outward(list.side == 0 ? 1.0 : -1.0);
    frame.n = outward * frame.n;
    frame.t1 = outward * frame.t1;  // keeps the frame right-handed; only t1's line matters

    const PairSlots<G, K, Real> slots(faces, phase, face);
    const int own = list.side, other = 1 - own;
    const auto side = side_of<Order>(phase, face, inside, own);
    auto l = recall_side<G, K, Real>(side, slots.sides, own, frame);
    if constexpr (K == Kind::solid && G::dimension == 3) l.tau.z = outward * l.tau.z;  // t2 did not turn with n and t1

    const LongitudinalStar<Real> star = free_surface<Real>(l, Real(p0));
    raise_fastest(faces, face, star.fastest);
    const ContactFlux<G, Real> contact(star, eulerian_flux<G>(star, l, l), frame);
    const Real weight = face(faces.area) * load<Real>(&list.share[i]);
    const Real zero(0.0);
    const Real advancing = select(star.from_left, weight, zero), retreating = select(star.from_left, zero, weight);
    slots.add_gain(own, -(advancing * contact.mass),
                   (-1.0) * (advancing * contact.momentum + retreating * contact.force),
                   -(advancing * contact.energy + retreating * contact.work), retreating * star.u_star);
    slots.add_gain(other, advancing * contact.mass, advancing * contact.convected_momentum,
                   advancing * contact.convected_energy, advancing * star.u_star);

    if constexpr (K == Kind::solid) {
      const Cobasis<G, Real> e = load_cobasis<G, Real>(phase, inside),
                             e_f = stretched(load_cobasis_of<G, K>(side), frame, star.r);
      const auto w_star = free_surface_velocity(l, Real(1.0));
      const Vector<G, Real> du = velocity_jump(frame, cell_velocity<Order, K>(phase, inside, frame, l),
                                               select(star.from_left, star.u_f, star.u_star), w_star);
      slots.add_cobasis(own, weight * fluctuation(select(star.from_left, star.u_f, zero), e_f, e, du, frame));
      const Cobasis<G, Real> e_outside = load_cobasis<G, Real>(phase, outside);
      slots.add_cobasis(other, (-advancing) * invader_fluctuation(star.u_star, star.u_f, e_f, e_outside, frame));
    }
  }
}

}  // namespace cobasis
