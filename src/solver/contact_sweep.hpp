// What a face does to two phases that meet there, or to one before a void. Follows sweep_same, which leaves the
// traction and the speeds of both sides.
#pragma once

#include "physics/cobasis_flux.hpp"
#include "physics/longitudinal.hpp"
#include "physics/shear.hpp"
#include "solver/face_sweep.hpp"

namespace cobasis {

/// Faces of one ordered pair of phases (l left, m right, l != m) with their S_lm. For a void partner `side` says on
/// which side the material is (0 left, 1 right).
struct PairList {
  CompactList<std::int32_t> face;
  CompactList<double> share;
  std::int32_t side = 0;
  double friction = 0;  ///< Coulomb's coefficient, of solids that rub
};

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
