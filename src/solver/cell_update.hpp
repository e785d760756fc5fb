// What faces do to cells: every cell gathers from its faces in its own fixed order, so that the same bits come out for
// any partition. Also the other direction of the conversion: conserved to primitive, with the one evaluation of EOS and
// stress.
#pragma once

#include "solver/face_sweep.hpp"
#include "solver/hoop.hpp"

namespace cobasis {

/// Owned cells whose state left the admissible set: a density or pressure beyond the EOS's bounds, det e <= 0, or not a
/// number.
using BadCells = std::vector<std::int32_t>;

/// Primitive state of the listed cells. `n` need not be a multiple of the pack width; the list is padded to one.
template <class G, Kind K, class Real, class EquationOfState>
COBASIS_KERNEL void primitives(Phase& phase, const EquationOfState& eos, const CellList& cells, std::int32_t n,
                               BadCells& bad) {
  using L = Layout<G, K>;
  for (std::int32_t i = 0; i < n; i += lanes<Real>) {
    const Indices<Real> at = load_indices<Real>(&cells[i]);
    const auto conserved = [&](int c) { return gather<Real>(phase.conserved[c].data(), at); };
    const auto keep = [&](int c, const Real& value) { scatter(value, phase.primitive[c].data(), at); };
    const Real mass = conserved(L::mass);
    const Real alpha = phase.alpha.empty() ? Real(1.0) : gather<Real>(phase.alpha.data(), at);
    const Real rho = mass / alpha;
    const Real E = conserved(L::energy) / mass;
    Vector<G, Real> u;
    u.x = conserved(L::momentum) / mass, u.y = conserved(L::momentum + 1) / mass;
    if constexpr (G::dimension == 3) u.z = conserved(L::momentum + 2) / mass;

    Real e_h = E - 0.5 * dot(u, u);
    Mask<Real> good = rho > Real(0.0);
    if constexpr (K == Kind::solid) {
      const Cobasis<G, Real> e = load_cobasis<G, Real>(phase, at);
      good = good && determinant(e) > Real(0.0);
      const Real scale = metric_scale(e);
      e_h = e_h - elastic_energy(phase.material, scaled_metric(e, scale));
      keep(L::metric_scale, scale);
    }
    const Real p = eos.pressure(rho, e_h);
    good = good && p > Real(eos.lowest_pressure()) && rho < Real(eos.densest());
    if (any(!good)) [[unlikely]] {
      for (int j = 0; j < lanes<Real>; ++j)
        if (!lane(good, j) && i + j < n) bad.push_back(at[j]);
    }
    if (!phase.alpha.empty()) keep(L::rho, rho);
    keep(L::u, u.x), keep(L::u + 1, u.y);
    if constexpr (G::dimension == 3) keep(L::u + 2, u.z);
    keep(L::p, p);
    keep(L::ch2, eos.sound_speed_squared(rho, p));
    keep(L::E, E);
  }
}

/// 2 V / sum over faces of A lambda, the smallest over the listed cells [s]; 0 if a wave speed is not a real number.
template <class Real>
COBASIS_KERNEL double largest_step(const Faces& faces, const AlignedVector<double>& volume, const CellList& cells,
                                   std::int32_t n) {
  Real smallest(infinity);
  for (std::int32_t i = 0; i < n; i += lanes<Real>) {
    const Indices<Real> at = load_indices<Real>(&cells[i]);
    Real sum(0.0);
    for (int j = 0; j < faces.max_cell_faces; ++j) {
      Indices<Real> face = lookup<Real>(&faces.cell_faces[static_cast<std::size_t>(j) * faces.cell_stride], at);
      for (auto& f : face) f >>= 1;
      sum = sum + gather<Real>(faces.area.data(), face) * gather<Real>(faces.fastest.data(), face);
    }
    const Real step = 2.0 * gather<Real>(volume.data(), at) / sum;
    if (any(is_nan(step))) [[unlikely]]
      return 0;
    smallest = smaller(smallest, step);
  }
  double result = infinity;
  for (int j = 0; j < lanes<Real>; ++j) result = smaller(result, lane(smallest, j));
  return result;
}

/// Advances a phase in the listed owned cells by dt. Mixed: the volume fraction changes too, and contacts do work.
///
/// Cobasis: alpha de = -dt/V sum A {u (e_f - e) + n (e·(u* - u_cell))}, outward n. `centring` = 1/2 takes e on the
/// right-hand side at mid-step, 0 at its beginning. `rings`: of axisymmetric scenes, else null.
template <class G, Kind K, class Real, bool Mixed>
COBASIS_KERNEL void update(const Faces& faces, const AlignedVector<double>& volume, const Rings* rings, Phase& phase,
                           const CellList& cells, std::int32_t n, double dt, double centring) {
  using L = Layout<G, K>;
  constexpr int D = G::dimension;
  const std::int32_t first_mixed = first_mixed_slot(faces);
  [[maybe_unused]] const bool turns = phase.is_second_order();
  for (std::int32_t i = 0; i < n; i += lanes<Real>) {
    const Indices<Real> at = load_indices<Real>(&cells[i]);
    std::array<Real, L::n_conserved> change;
    change.fill(Real(0.0));
    Real alpha_gain(0.0), moved(0.0);
    std::array<Real, L::n_cobasis> e;
    std::array<Real, D> u;
    std::array<std::array<Real, D>, D> deformation;  // sum A n (u* - u_cell)
    [[maybe_unused]] std::array<Real, L::n_turn> turned;
    if constexpr (K == Kind::solid) {
      turned.fill(Real(0.0));
      for (int c = 0; c < L::n_cobasis; ++c) e[c] = gather<Real>(phase.conserved[L::cobasis + c].data(), at);
      for (int d = 0; d < D; ++d) u[d] = gather<Real>(phase.primitive[L::u + d].data(), at);
      // of an absent phase it may be no number, if dust without mass was here; faces of no area would not make it zero
      if constexpr (Mixed)
        for (auto& component : u) component = select(magnitude(component) < Real(infinity), component, Real(0.0));
      for (auto& row : deformation) row.fill(Real(0.0));
    }
    for (int j = 0; j < faces.max_cell_faces; ++j) {
      const Indices<Real> entry = lookup<Real>(&faces.cell_faces[static_cast<std::size_t>(j) * faces.cell_stride], at);
      Indices<Real> face, flux_at, gain_at;
      std::array<double, lanes<Real>> sign;
      for (int k = 0; k < lanes<Real>; ++k) {
        face[k] = entry[k] >> 1;
        const std::int32_t slot = phase.lists.slot_of_face[face[k]], side = entry[k] & 1;
        flux_at[k] = slot_base(slot, L::n_flux);
        if constexpr (Mixed)
          gain_at[k] = slot_base(gain_slot(slot, first_mixed), L::n_gain) + side * L::gain_side * pack_width;
        sign[k] = side ? 1 : -1;
      }
      const Real direction = load<Real>(sign.data());
      const auto flux = [&](int c) { return gather<Real>(phase.flux.data() + c * pack_width, flux_at); };
      for (int c = 0; c < L::cobasis; ++c) change[c] = change[c] + direction * flux(c);
      if constexpr (K == Kind::solid) {
        const Real through = flux(L::flux_volume), area = flux(L::flux_area);
        moved = moved + direction * through;
        for (int c = 0; c < L::n_cobasis; ++c)
          change[L::cobasis + c] = change[L::cobasis + c] + direction * (flux(L::flux_cobasis + c) - through * e[c]);
        const AlignedVector<double>* const normal[] = {&faces.nx, &faces.ny, &faces.nz};
        if (turns)
          for (int c = 0; c < L::n_turn; ++c) turned[c] = turned[c] - direction * flux(L::flux_turn + c);
        std::array<Real, D> du;
        for (int d = 0; d < D; ++d) du[d] = direction * (flux(L::flux_velocity + d) - area * u[d]);
        for (int d = 0; d < D; ++d) {
          const Real component = gather<Real>(normal[d]->data(), face);
          for (int b = 0; b < D; ++b) deformation[d][b] = deformation[d][b] + component * du[b];
        }
      }
      if constexpr (Mixed) {
        const auto gain = [&](int c) { return gather<Real>(phase.gain.data() + c * pack_width, gain_at); };
        alpha_gain = alpha_gain + gain(L::gain_alpha);
        for (int c = 0; c < L::cobasis; ++c) change[c] = change[c] + gain(c);
        for (int c = 0; c < L::n_cobasis; ++c)
          change[L::cobasis + c] = change[L::cobasis + c] - gain(L::gain_cobasis + c);
      }
    }
    Real hoop_stretching(0.0);
    if constexpr (D == 2) {
      if (rings) {
        const Real share = Mixed ? gather<Real>(phase.alpha.data(), at) : Real(1.0);
        hoop_stretching = add_hoop<K>(phase, *rings, at, share, change, deformation, u);
      }
    }
    const Real rate = dt / gather<Real>(volume.data(), at);
    Real cobasis_rate = rate;
    if constexpr (Mixed) {
      if (phase.inner.stride != 0) {
        const auto inner = [&](int c) { return gather<Real>(phase.inner.component(c), at); };
        for (int d = 0; d < D; ++d) change[L::momentum + d] = change[L::momentum + d] + inner(L::inner_momentum + d);
        change[L::energy] = change[L::energy] + inner(L::inner_energy);
        alpha_gain = alpha_gain + inner(L::inner_alpha);
        for (int c = 0; c < L::n_cobasis; ++c)
          change[L::cobasis + c] = change[L::cobasis + c] - inner(L::inner_cobasis + c);
      }
      const Real alpha = gather<Real>(phase.alpha.data(), at) + rate * alpha_gain;
      scatter(alpha, phase.alpha.data(), at);
      // what is left of a phase that leaves a cell for many steps ends near 1e-308, where 1 / alpha overflows
      cobasis_rate = select(magnitude(alpha) > Real(1e-200), rate / alpha, Real(0.0));
    }
    for (int c = 0; c < L::cobasis; ++c) {
      double* const to = phase.conserved[c].data();
      scatter(gather<Real>(to, at) + rate * change[c], to, at);
    }
    if constexpr (K == Kind::solid) {
      std::array<Real, L::n_cobasis> e_change{};
      const auto deform = [&](std::array<Real, L::n_cobasis> of) {
        for (int beta = 0; beta < D; ++beta)
          for (int d = 0; d < D; ++d)
            for (int b = 0; b < D; ++b)
              change[L::cobasis + beta * D + d] =
                  change[L::cobasis + beta * D + d] + deformation[d][b] * of[beta * D + b];
        if constexpr (D == 2) change[L::cobasis + 4] = change[L::cobasis + 4] - hoop_stretching * of[4];
      };
      deform(e);
      // the change of e is linear in e: at mid-step e is e + centring * (the change from the beginning)
      for (int c = 0; c < L::n_cobasis; ++c) e_change[c] = centring * (cobasis_rate * change[L::cobasis + c]);
      deform(e_change);
      for (int c = 0; c < L::n_cobasis; ++c) {
        const Real total = change[L::cobasis + c] - moved * e_change[c];
        e[c] = e[c] + cobasis_rate * total;
      }
      if (turns) {
        Real turning_rate = rate;
        // an absent phase has no e to turn: what its faces hold is of some step before
        if constexpr (Mixed) turning_rate = select(cobasis_rate == Real(0.0), Real(0.0), rate);
        for (auto& t : turned) t = turning_rate * t;
        turn_by<D>(e, turned);
      }
      for (int c = 0; c < L::n_cobasis; ++c) scatter(e[c], phase.conserved[L::cobasis + c].data(), at);
    }
  }
}

}  // namespace cobasis
