// Where the state lives: per phase one aligned array per component over the rank's cells, and the buffers that carry
// what faces do to cells.
#pragma once

#include <cstdint>
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

  /// What a face does to a phase: flux of mass, momentum, energy (left to right), cobasis fluctuations of the left and
  /// of the right cell. In mixed faces also, per side, the gain of mass, momentum, energy, alpha by contacts.
  static constexpr int flux_cobasis[2] = {2 + D, 2 + D + n_cobasis};
  static constexpr int n_flux = 2 + D + 2 * n_cobasis;
  static constexpr int gain_alpha = 2 + D, gain_side = 3 + D;
  static constexpr int n_gain = 2 * gain_side;
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

struct Phase {
  std::string name;
  bool is_void = false;
  Kind kind = Kind::fluid;
  Eos eos;
  HyperelasticMaterial material;
  double void_pressure = 0;  ///< [Pa]

  AlignedVector<double> alpha;                   ///< all cells; empty in a scene of one phase
  std::vector<AlignedVector<double>> conserved;  ///< [component][cell]
  std::vector<AlignedVector<double>> primitive;  ///< [component][cell]; valid where the phase is present

  SlotLists lists;
  RawStorage flux;   ///< n_flux per slot
  RawStorage gain;   ///< n_gain per mixed slot
  RawStorage sides;  ///< n_side for the left and n_side for the right, per mixed slot

  /// [kg/m^3]; alone in its scene, a phase has no other mass per volume than this.
  const AlignedVector<double>& density() const { return alpha.empty() ? conserved[0] : primitive[0]; }

  int numbers_per_cell() const {
    return static_cast<int>(conserved.size() + primitive.size()) + (alpha.empty() ? -1 : 1);
  }
  int n_conserved() const { return static_cast<int>(conserved.size()); }
};

/// Cells to do something with; `fill` makes the last pack whole.
using CellList = CompactList<std::int32_t>;

/// Component c of the cobasis of an undeformed solid, in the numbering of Layout.
inline double identity_cobasis(int dimension, int c) {
  return dimension == 2 ? (c == 0 || c == 3 || c == 4) : (c == 0 || c == 4 || c == 8);
}

struct Fields {
  std::vector<Phase> phases;
  int dimension = 2;
  std::int32_t n_owned = 0;
  std::int32_t n_all = 0;            ///< owned, halo, ghosts
  AlignedVector<double> volume;      ///< of owned and halo cells
  AlignedVector<std::int32_t> pure;  ///< index of the only phase in a cell, -1 if there are several; all cells

  int n_phases() const { return static_cast<int>(phases.size()); }
  bool multiphase() const { return phases.size() > 1; }
  int first_cobasis() const { return 2 + dimension; }  ///< component of the conserved arrays, see Layout

  /// Makes the sum of the volume fractions of a cell exactly one: the void takes what the others leave, or else the
  /// largest phase does. Sets `pure`.
  void complete(std::int32_t cell);
  /// The same for the first n of a list.
  void complete(const CellList& cells, std::int32_t n);
};

}  // namespace cobasis
