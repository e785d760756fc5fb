// Where the state lives: per phase one aligned array per component over the rank's cells, and the buffers that carry
// what faces do to cells.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "math/aligned.hpp"
#include "math/pack.hpp"
#include "physics/eos.hpp"
#include "physics/hyperelastic_material.hpp"

namespace cobasis {

/// Numbering of components. Conserved quantities are per volume of the cell (alpha rho, …); the cobasis is intensive.
template <class G, Kind K>
struct Layout {
  static constexpr int D = G::dimension;
  static constexpr int n_cobasis = K == Kind::solid ? G::n_cobasis : 0;

  static constexpr int mass = 0, momentum = 1, energy = 1 + D, cobasis = 2 + D;  // conserved
  static constexpr int n_conserved = 2 + D + n_cobasis;
  static constexpr int rho = 0, u = 1, p = 1 + D, ch2 = 2 + D, E = 3 + D, metric_scale = 4 + D;  // primitive
  static constexpr int n_primitive = K == Kind::solid ? 5 + D : 4 + D;

  /// What a face does to a phase: flux of mass, momentum, energy (left to right); of a solid also what its cobasis
  /// changes by: u e and u of the face (normal velocities), the velocity u* at the face, the area, and the turn that it
  /// gives the right cell at second order, all but the area times the area. In mixed faces also, per side, the gain of
  /// mass, momentum, energy, alpha, cobasis by contacts.
  static constexpr int flux_cobasis = 2 + D, flux_volume = flux_cobasis + n_cobasis, flux_velocity = flux_volume + 1,
                       flux_area = flux_velocity + D;
  static constexpr int flux_turn = flux_area + 1, n_turn = D == 2 ? 1 : 3;
  static constexpr int n_flux = K == Kind::solid ? flux_turn + n_turn : 2 + D;
  static constexpr int gain_alpha = 2 + D, gain_cobasis = 3 + D, gain_side = gain_cobasis + n_cobasis;
  static constexpr int n_gain = 2 * gain_side;
  /// What contacts inside a cell do to a phase there.
  static constexpr int inner_momentum = 0, inner_energy = D, inner_alpha = D + 1, inner_cobasis = D + 2,
                       n_inner = inner_cobasis + n_cobasis;
  /// State of a phase on one side of a face, where it is reconstructed: as primitive, then the cobasis.
  static constexpr int n_face_state = n_primitive + n_cobasis;
  /// Traction and speeds of both sides, kept where a face's state serves several pairs: P, c1 (, tau_12, tau_13, c_s).
  static constexpr int n_side = K == Kind::solid ? 2 + D : 2;
};

/// Position of component 0 of a slot in a buffer with n components per slot: blocks of one pack.
inline std::int32_t slot_base(std::int32_t slot, int n) {
  return slot / pack_width * pack_width * n + slot % pack_width;
}

/// Faces on which a phase acts, in compact lists. Slot 0 is the empty slot: its values are always zero.
struct SlotLists {
  CompactList<std::int32_t> pure;            ///< faces between two cells that hold only this phase
  CompactList<std::int32_t> mixed;           ///< other faces where the phase is on at least one side
  CompactList<double> mixed_share;           ///< S_kk of these
  AlignedVector<std::int32_t> slot_of_face;  ///< n_faces + 1 entries; the last is the face of nobody
};

/// States of a phase on both sides of every face, reconstructed from the cells: [component][side][face].
struct FaceStates {
  RawStorage storage;
  std::size_t stride = 0;  ///< numbers per component and side; not a multiple of a page

  static std::size_t stride_for(std::size_t n_faces) { return (n_faces + 64) / 64 * 64 + 8; }
  double* component(int c) { return storage.data() + 2 * stride * c; }
  const double* component(int c) const { return storage.data() + 2 * stride * c; }
};

/// Several numbers per cell: [number][cell].
struct CellNumbers {
  RawStorage storage;
  std::size_t stride = 0;

  CellNumbers() = default;
  CellNumbers(std::size_t n_cells, int n)
      : storage(FaceStates::stride_for(n_cells) * n), stride(FaceStates::stride_for(n_cells)) {}
  double* component(int c) { return storage.data() + stride * c; }
  const double* component(int c) const { return storage.data() + stride * c; }
};

struct Phase {
  std::string name;
  bool is_void = false;
  Kind kind = Kind::fluid;
  Eos eos;
  HyperelasticMaterial material;
  double void_pressure = 0;  ///< [Pa]
  double low_mach = 0;       ///< 1: less dissipation where the flow is slow, see low_mach_jump; 0: none of that

  AlignedVector<double> alpha;                   ///< all cells; empty in a scene of one phase
  std::vector<AlignedVector<double>> conserved;  ///< [component][cell]
  std::vector<AlignedVector<double>> primitive;  ///< [component][cell]; valid where the phase is present

  SlotLists lists;
  RawStorage flux;         ///< n_flux per slot
  RawStorage gain;         ///< n_gain per mixed slot
  RawStorage sides;        ///< n_side for the left and n_side for the right, per mixed slot
  FaceStates face_states;  ///< of the second order
  CellNumbers slopes;      ///< of the second order, where gradients are averaged: [quantity and direction][cell]
  AlignedVector<double> slopes_known;  ///< per cell 1 or 0
  CellNumbers hoop;                    ///< of axisymmetric scenes, see keep_hoop
  CellNumbers inner;                   ///< of sharp interfaces: what contacts inside cells do
  AlignedVector<double> wetted[2];     ///< of sharp interfaces: fraction of each face as seen from its left and its
                                       ///< right cell, where Fields::near says so
  /// Of sharp interfaces at second order, per cell: where the phase's centroid lies, relative to the cell's [m], and
  /// the slopes with which it was reconstructed, [quantity and direction][cell], then by how much every quantity
  /// changes in half a step; all 0 far from interfaces.
  CellNumbers centre, used_slopes;
  AlignedVector<double> wetted_at[3];  ///< likewise per face: where its part of it lies, relative to the face's [m]
  /// Of sharp interfaces beside a solid, per face: volume of the phase that goes from left to right to level ripples,
  /// per area and time [m/s].
  AlignedVector<double> levelling;

  /// [kg/m^3]; alone in its scene, a phase has no other mass per volume than this.
  const AlignedVector<double>& density() const { return alpha.empty() ? conserved[0] : primitive[0]; }

  int numbers_per_cell() const {
    return static_cast<int>(conserved.size() + primitive.size()) + (alpha.empty() ? -1 : 1);
  }
  int n_conserved() const { return static_cast<int>(conserved.size()); }
  bool is_second_order() const { return face_states.stride != 0; }
};

/// Cells to do something with; `fill` makes the last pack whole.
using CellList = CompactList<std::int32_t>;

/// Component c of the cobasis of an undeformed solid, in the numbering of Layout.
inline double identity_cobasis(int dimension, int c) {
  return dimension == 2 ? (c == 0 || c == 3 || c == 4) : (c == 0 || c == 4 || c == 8);
}

/// Axisymmetric scenes: cells as rings around the x axis. For the faces of a cell sum A n = section e_r.
struct Rings {
  AlignedVector<double> section;         ///< area of the section times 2 pi [m^2]
  AlignedVector<double> inverse_radius;  ///< of the ring's centroid [1/m]
  AlignedVector<double> to_section[2];   ///< from the ring's centroid to the section's [m]
  AlignedVector<double> lever;           ///< radius of the section's centroid over that of the ring's
};

class NeighbourExchange;
struct Mesh;

struct Fields {
  std::vector<Phase> phases;
  int dimension = 2;
  std::int32_t n_owned = 0;
  std::int32_t n_all = 0;        ///< owned, halo, ghosts
  AlignedVector<double> volume;  ///< of owned and halo cells
  std::optional<Rings> rings;    ///< of owned and halo cells; none unless axisymmetric
  /// Of sharp interfaces: whether an interface is so near to a face that phases share it during the step. Else both its
  /// cells are pure in the same phase.
  AlignedVector<std::int32_t> near;
  AlignedVector<double> cautious;  ///< 1 in cells that stay at first order and without sharp interfaces, else 0; empty:
                                   ///< in no cell
  AlignedVector<std::int32_t> pure;  ///< index of the only phase in a cell, -1 if there are several; all cells

  const Rings* rings_or_null() const { return rings ? &*rings : nullptr; }
  int n_phases() const { return static_cast<int>(phases.size()); }
  bool sharp() const { return !near.empty(); }
  bool multiphase() const { return phases.size() > 1; }
  int first_cobasis() const { return 2 + dimension; }  ///< component of the conserved arrays, see Layout

  /// Makes the sum of the volume fractions of a cell exactly one: the void takes what the others leave, or else the
  /// largest phase does. Sets `pure`.
  void complete(std::int32_t cell);
  /// The same for the first n of a list.
  void complete(const CellList& cells, std::int32_t n);
  /// Halo cells get their owners' volume fractions, through an exchange with room for them. Collective.
  void share_alpha(const Mesh& mesh, NeighbourExchange& exchange);
};

}  // namespace cobasis
