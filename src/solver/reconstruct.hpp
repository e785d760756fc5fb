// Second order: from cells to states on both sides of every face, at the middle of the time step (Hancock).
#pragma once

#include "solver/hoop.hpp"
#include "solver/neighbourhood.hpp"

namespace cobasis {

struct ReconstructionOptions {
  double dt = 0;  ///< of the step; 0: states at its beginning
  bool limited = true;
  const Rings* rings = nullptr;  ///< of axisymmetric scenes
};

/// How far values at faces may leave the range of the neighbours' where the flow is smooth, in units of the material's
/// own scales (rho, c, rho c^2, |e|) times Stencil::tolerance. It keeps smooth extrema at second order.
inline constexpr double smooth_extremum = 0.5;

/// A state at a face, with what the EOS and the stored energy make of it.
template <class G, Kind K, class Real, class EquationOfState>
void store_face_state(Phase& phase, const EquationOfState& eos,
                      const typename Primitives<G, K>::template State<Real>& s, const Indices<Real>& to) {
  using L = Layout<G, K>;
  using P = Primitives<G, K>;
  const auto keep = [&](int c, const Real& value) { scatter(value, phase.face_states.component(c), to); };
  Real E = eos.energy(s[P::rho], s[P::p]);
  for (int d = 0; d < G::dimension; ++d) {
    E = E + 0.5 * (s[P::u + d] * s[P::u + d]);
    keep(L::u + d, s[P::u + d]);
  }
  if constexpr (K == Kind::solid) {
    const Cobasis<G, Real> e = cobasis_of<G, K>(s);
    const Real scale = metric_scale(e);
    E = E + elastic_energy(phase.material, scaled_metric(e, scale));
    keep(L::metric_scale, scale);
    for (int c = 0; c < P::n_cobasis; ++c) keep(L::n_primitive + c, s[P::e + c]);
  }
  keep(L::rho, s[P::rho]);
  keep(L::p, s[P::p]);
  keep(L::ch2, eos.sound_speed_squared(s[P::rho], s[P::p]));
  keep(L::E, E);
}

/// The same from cells as they are: where a phase is beside what it is not, or alone.
template <class G, Kind K, class Real>
COBASIS_KERNEL void copy_to_faces(Phase& phase, const Faces& faces, const CellList& cells, std::int32_t n) {
  using L = Layout<G, K>;
  for (std::int32_t i = 0; i < n; i += lanes<Real>) {
    const Indices<Real> at = load_indices<Real>(&cells[i]);
    for (int j = 0; j < faces.max_cell_faces; ++j) {
      const Indices<Real> entry = lookup<Real>(&faces.cell_faces[static_cast<std::size_t>(j) * faces.cell_stride], at);
      Indices<Real> to;
      for (int k = 0; k < lanes<Real>; ++k)
        to[k] = (entry[k] >> 1) + (entry[k] & 1) * static_cast<std::int32_t>(phase.face_states.stride);
      for (int c = 0; c < L::n_face_state; ++c) {
        const AlignedVector<double>& from = c == L::rho          ? phase.density()
                                            : c < L::n_primitive ? phase.primitive[c]
                                                                 : phase.conserved[L::cobasis + c - L::n_primitive];
        scatter(gather<Real>(from.data(), at), phase.face_states.component(c), to);
      }
    }
  }
}

/// Keeps the gradients of a phase in the listed cells, to be averaged.
template <class G, Kind K, class Real, Around A>
COBASIS_KERNEL void find_slopes(Phase& phase, const Faces& faces, const Stencil& stencil, const CellList& cells,
                                std::int32_t n) {
  using P = Primitives<G, K>;
  constexpr int D = G::dimension;
  for (std::int32_t i = 0; i < n; i += lanes<Real>) {
    const Neighbourhood<G, K, Real, A> here{phase, faces, stencil, load_indices<Real>(&cells[i])};
    const auto gradient = here.gradient(here.state(here.at));
    for (int v = 0; v < P::size; ++v)
      for (int d = 0; d < D; ++d) scatter(gradient[v][d], phase.slopes.component(v * D + d), here.at);
  }
}

/// Writes the state of a phase in the faces' buffer on the listed cells' sides. Returns in how many cells the state
/// would have been inadmissible at a face; those are taken as they are, at first order.
template <class G, Kind K, class Real, class EquationOfState, Around A, bool Averaged>
COBASIS_KERNEL std::int64_t reconstruct(Phase& phase, const EquationOfState& eos, const Faces& faces,
                                        const Stencil& stencil, const CellList& cells, std::int32_t n,
                                        const ReconstructionOptions& options) {
  using L = Layout<G, K>;
  using P = Primitives<G, K>;
  constexpr int D = G::dimension;
  std::int64_t fallen = 0;
  for (std::int32_t i = 0; i < n; i += lanes<Real>) {
    const Indices<Real> at = load_indices<Real>(&cells[i]);
    const Neighbourhood<G, K, Real, A> here{phase, faces, stencil, at};
    const auto w = here.state(at);
    auto low = w, high = w;
    typename P::template State<Real> slope_factor;
    slope_factor.fill(Real(1.0));
    typename P::template Gradients<Real> gradient;
    if constexpr (Averaged) {
      for (int v = 0; v < P::size; ++v)
        for (int d = 0; d < D; ++d) gradient[v][d] = gather<Real>(phase.slopes.component(v * D + d), at);
      const auto own = gradient;
      for (int j = 0; j < stencil.size; ++j) {
        const Indices<Real> neighbour = here.neighbour(j);
        const Real share = here.of_entry(stencil.average, j);
        const Mask<Real> known = gather<Real>(phase.slopes_known.data(), neighbour) * share > Real(0.0);
        typename P::template Gradients<Real> other;
        for (int v = 0; v < P::size; ++v)
          for (int d = 0; d < D; ++d) other[v][d] = gather<Real>(phase.slopes.component(v * D + d), neighbour);
        if constexpr (A != Around::phase) here.mirror(other, j, w);
        for (int v = 0; v < P::size; ++v)
          for (int d = 0; d < D; ++d)
            gradient[v][d] = gradient[v][d] + select(known, share * (other[v][d] - own[v][d]), Real(0.0));
      }
    } else {
      gradient = here.gradient(w);
    }
    for (int j = 0; j < stencil.size; ++j) {
      const auto other = here.beyond(j, w);
      for (int v = 0; v < P::size; ++v) {
        low[v] = smaller(low[v], other[v]);
        high[v] = larger(high[v], other[v]);
      }
    }

    const Real ch2 = gather<Real>(phase.primitive[L::ch2].data(), at);
    const auto along = [&](int v, const std::array<Real, D>& r) {
      Real change = gradient[v][0] * r[0];
      for (int d = 1; d < D; ++d) change = change + gradient[v][d] * r[d];
      return change;
    };
    if (options.limited) {
      const Real tolerance = smooth_extremum * gather<Real>(stencil.tolerance.data(), at);
      typename P::template State<Real> scale;
      scale[P::rho] = w[P::rho];
      for (int d = 0; d < D; ++d) scale[P::u + d] = square_root(ch2);
      scale[P::p] = w[P::rho] * ch2;
      if constexpr (K == Kind::solid) {
        const Real size = 1.0 / square_root(gather<Real>(phase.primitive[L::metric_scale].data(), at));  // det^{1/3}
        for (int c = 0; c < P::n_cobasis; ++c) scale[P::e + c] = size;
      }
      for (int v = 0; v < P::size; ++v) {
        high[v] = (high[v] - w[v]) + tolerance * scale[v];
        low[v] = (low[v] - w[v]) - tolerance * scale[v];
      }
      for (int j = 0; j < faces.max_cell_faces; ++j) {
        const auto r = here.to_face(j);
        for (int v = 0; v < P::size; ++v) {
          const Real change = along(v, r);
          const Real room = select(change > Real(0.0), high[v], low[v]);
          Mask<Real> fits = magnitude(change) <= magnitude(room);
          if constexpr (A == Around::gaps) fits = fits || !here.holds(j);
          slope_factor[v] = smaller(slope_factor[v], select(fits, Real(1.0), room / change));
        }
      }
      // one factor for all components of e: limited one by one, they would no longer belong to one deformation
      for (int c = 1; c < P::n_cobasis; ++c) slope_factor[P::e] = smaller(slope_factor[P::e], slope_factor[P::e + c]);
      for (int c = 1; c < P::n_cobasis; ++c) slope_factor[P::e + c] = slope_factor[P::e];
      for (int v = 0; v < P::size; ++v)
        for (int d = 0; d < D; ++d) gradient[v][d] = slope_factor[v] * gradient[v][d];
    }
    auto rate = rates_of_change<G, K, Real>(phase.material, w, gradient, ch2);
    if constexpr (D == 2) {
      if (options.rings)
        add_hoop_rates<K, Real>(phase.material, w, ch2, gather<Real>(options.rings->inverse_radius.data(), at), rate);
    }
    const Real half(0.5 * options.dt);

    const auto at_place = [&](const std::array<Real, D>& r) {
      typename P::template State<Real> s;
      for (int v = 0; v < P::size; ++v) s[v] = w[v] + (along(v, r) + half * rate[v]);
      return s;
    };
    const auto at_face = [&](int j) { return at_place(here.to_face(j)); };
    Mask<Real> good = !is_nan(w[P::rho]);
    Real det_per_density(0.0);
    if constexpr (K == Kind::solid) det_per_density = determinant(cobasis_of<G, K>(w)) / w[P::rho];
    for (int j = 0; j < faces.max_cell_faces; ++j) {
      const auto s = at_face(j);
      good = good && s[P::rho] > Real(0.0) && s[P::rho] < Real(eos.densest()) && s[P::p] > Real(eos.lowest_pressure());
      if constexpr (K == Kind::solid)
        good = good && is_one_deformation(determinant(cobasis_of<G, K>(s)), det_per_density * s[P::rho]);
    }
    if (any(!good)) [[unlikely]] {
      for (int k = 0; k < lanes<Real>; ++k) fallen += i + k < n && !lane(good, k);
    }
    if constexpr (D == 2) {
      if (options.rings) {
        const AlignedVector<double>* const to_section = options.rings->to_section;
        auto s = at_place({gather<Real>(to_section[0].data(), at), gather<Real>(to_section[1].data(), at)});
        for (int v = 0; v < P::size; ++v) s[v] = select(good, s[v], w[v]);
        const Real at_rest = gather<Real>(options.rings->lever.data(), at) * w[P::u + 1];
        s[P::u + 1] = select(good, s[P::u + 1], at_rest);
        keep_hoop<K>(phase, at, s);
      }
    }
    if constexpr (A == Around::gaps) {
      if (phase.used_slopes.stride != 0)
        for (int v = 0; v < P::size; ++v) {
          for (int d = 0; d < D; ++d)
            scatter(select(good, gradient[v][d], Real(0.0)), phase.used_slopes.component(v * D + d), at);
          scatter(select(good, half * rate[v], Real(0.0)), phase.used_slopes.component(P::size * D + v), at);
        }
    }
    for (int j = 0; j < faces.max_cell_faces; ++j) {
      const Indices<Real> entry = lookup<Real>(&faces.cell_faces[static_cast<std::size_t>(j) * faces.cell_stride], at);
      Indices<Real> to;
      for (int k = 0; k < lanes<Real>; ++k)
        to[k] = (entry[k] >> 1) + (entry[k] & 1) * static_cast<std::int32_t>(phase.face_states.stride);
      auto s = at_face(j);
      for (int v = 0; v < P::size; ++v) s[v] = select(good, s[v], w[v]);
      store_face_state<G, K>(phase, eos, s, to);
    }
  }
  return fallen;
}

}  // namespace cobasis
