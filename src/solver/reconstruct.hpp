// Second order: from cells to states on both sides of every face, at the middle of the time step (Hancock).
#pragma once

#include "physics/smooth_flow.hpp"
#include "solver/hoop.hpp"
#include "solver/mean_state.hpp"
#include "solver/stencil.hpp"

namespace cobasis {

struct ReconstructionOptions {
  double dt = 0;  ///< of the step; 0: states at its beginning
  bool limited = true;
  const Rings* rings = nullptr;  ///< of axisymmetric scenes
};

/// How far values at faces may leave the range of the neighbours' where the flow is smooth, in units of the material's
/// own scales (rho, c, rho c^2, |e|) times Stencil::tolerance. It keeps smooth extrema at second order.
inline constexpr double smooth_extremum = 0.5;

/// A phase has slopes in a cell that holds more than this of it, over neighbours that do too: what a trace does is no
/// measure of the others.
inline constexpr double least_for_slopes = 0.05;

/// What is around the cells of a list: neighbours that all hold the phase, the same and mirrors among them, or also
/// neighbours without it.
enum class Around { phase, mirrors, gaps };

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

/// Weights of neighbours without the phase, so that there is no slope where nothing is known, and of all in addition,
/// so that no matrix is singular.
inline constexpr double least_known = 0.02, always_known = 1e-6;

template <class Real>
std::array<Real, 2> product(const std::array<std::array<Real, 2>, 2>& m, const std::array<Real, 2>& v) {
  return {m[0][0] * v[0] + m[0][1] * v[1], m[1][0] * v[0] + m[1][1] * v[1]};
}
template <class Real>
std::array<Real, 3> product(const std::array<std::array<Real, 3>, 3>& m, const std::array<Real, 3>& v) {
  std::array<Real, 3> result;
  for (int a = 0; a < 3; ++a) result[a] = m[a][0] * v[0] + m[a][1] * v[1] + m[a][2] * v[2];
  return result;
}
/// Of symmetric matrices.
template <class Real>
std::array<std::array<Real, 2>, 2> inverse_of(const std::array<std::array<Real, 2>, 2>& m) {
  const Real scale = 1.0 / (m[0][0] * m[1][1] - m[0][1] * m[0][1]);
  const Real off = -scale * m[0][1];
  return {{{scale * m[1][1], off}, {off, scale * m[0][0]}}};
}
template <class Real>
std::array<std::array<Real, 3>, 3> inverse_of(const std::array<std::array<Real, 3>, 3>& m) {
  const auto minor = [&](int a, int b, int c, int d) { return m[a][c] * m[b][d] - m[a][d] * m[b][c]; };
  const Real xx = minor(1, 2, 1, 2), xy = minor(1, 2, 2, 0), xz = minor(1, 2, 0, 1);
  const Real scale = 1.0 / (m[0][0] * xx + m[0][1] * xy + m[0][2] * xz);
  const Real yy = minor(0, 2, 0, 2), yz = minor(0, 2, 1, 0), zz = minor(0, 1, 0, 1);
  return {{{scale * xx, scale * xy, scale * xz},
           {scale * xy, scale * yy, scale * yz},
           {scale * xz, scale * yz, scale * zz}}};
}

/// Values of a phase in cells and beyond their faces, as Primitives numbers them.
template <class G, Kind K, class Real, Around A>
struct Neighbourhood {
  using L = Layout<G, K>;
  using P = Primitives<G, K>;
  using State = typename P::template State<Real>;
  static constexpr int D = G::dimension;
  const Phase& phase;
  const Faces& faces;
  const Stencil& stencil;
  Indices<Real> at;

  std::size_t entry(int j) const { return static_cast<std::size_t>(j) * stencil.stride; }
  Real of_entry(const AlignedVector<double>& values, int j) const { return gather<Real>(&values[entry(j)], at); }
  Indices<Real> neighbour(int j) const { return lookup<Real>(&stencil.cell[entry(j)], at); }

  State state(const Indices<Real>& cell) const { return mean_state<G, K, Real>(phase, cell); }
  std::array<Real, D> normal_of(int j) const {
    Indices<Real> face = lookup<Real>(&faces.cell_faces[entry(j)], at);
    for (auto& f : face) f >>= 1;
    const AlignedVector<double>* const normals[] = {&faces.nx, &faces.ny, &faces.nz};
    std::array<Real, D> normal;
    for (int d = 0; d < D; ++d) normal[d] = gather<Real>(normals[d]->data(), face);
    return normal;
  }
  /// Turns v into its mirror image where face j is a mirror.
  template <class Component>
  void reflect(int j, const Component& v) const {
    const std::array<Real, D> normal = normal_of(j);
    const Real twice = of_entry(stencil.mirror, j);
    Real along(0.0);
    for (int d = 0; d < D; ++d) along = along + v(d) * normal[d];
    for (int d = 0; d < D; ++d) v(d) = v(d) - twice * along * normal[d];
  }
  /// The vectors of e belong to the body's own coordinates, which a mirror turns too. With e H, H the mirror of space,
  /// Q e H is a cobasis of the image for any rotation or mirror Q; Q mirrors the body along this unit vector. At a
  /// plane of symmetry of bodies whose coordinates are those of space that is the plane's normal. Elsewhere nobody
  /// knows how they lie: with the image e n of the normal, e stays as it is where there is no shear.
  std::array<Real, D> body_normal(int j, const std::array<Real, D>& n, const State& w) const {
    std::array<Real, D> image;
    Real square(0.0), aligned(0.0);
    for (int beta = 0; beta < D; ++beta) {
      image[beta] = Real(0.0);
      for (int d = 0; d < D; ++d) image[beta] = image[beta] + w[P::e + beta * D + d] * n[d];
      square = square + image[beta] * image[beta];
      aligned = aligned + image[beta] * n[beta];
    }
    const Real length = square_root(square);
    const Mask<Real> known = of_entry(stencil.body_mirror, j) * aligned > 0.5 * length;
    const Mask<Real> mirrored = of_entry(stencil.mirror, j) > Real(0.0);
    for (int d = 0; d < D; ++d) image[d] = select(mirrored && !known, image[d] / length, n[d]);
    return image;
  }
  /// Turns e(beta, d), of a state or its slopes, into that of the mirror image where face j is a mirror.
  template <class Component>
  void reflect_cobasis(int j, const std::array<Real, D>& body_normal, const Component& e) const {
    const Real twice = of_entry(stencil.mirror, j);
    for (int beta = 0; beta < D; ++beta) reflect(j, [&](int d) -> Real& { return e(beta, d); });
    for (int d = 0; d < D; ++d) {
      Real along(0.0);
      for (int beta = 0; beta < D; ++beta) along = along + e(beta, d) * body_normal[beta];
      for (int beta = 0; beta < D; ++beta) e(beta, d) = e(beta, d) - twice * along * body_normal[beta];
    }
  }
  /// Behind face j: another cell, or the mirror image of this one.
  /// Where that does not hold the phase, `w`, the cell's own state.
  State beyond(int j, const State& w) const {
    State other = state(neighbour(j));
    if constexpr (A != Around::phase) {
      reflect(j, [&](int d) -> Real& { return other[P::u + d]; });
      if constexpr (K == Kind::solid)
        reflect_cobasis(j, body_normal(j, normal_of(j), w),
                        [&](int beta, int d) -> Real& { return other[P::e + beta * D + d]; });
    }
    if constexpr (A == Around::gaps) {
      const Mask<Real> there = holds(j);
      for (int v = 0; v < P::size; ++v) other[v] = select(there, other[v], w[v]);
    }
    return other;
  }
  Mask<Real> holds(int j) const { return gather<Real>(phase.alpha.data(), neighbour(j)) > Real(least_for_slopes); }
  /// Least squares. Beside gaps between the centroids of the phase, weighted by its volume fractions; neighbours
  /// without it hold the slope towards them down, a little.
  typename P::template Gradients<Real> gradient(const State& w) const {
    typename P::template Gradients<Real> of{};
    if constexpr (A != Around::gaps) {
      for (int j = 0; j < stencil.size; ++j) {
        const State other = beyond(j, w);
        for (int d = 0; d < D; ++d) {
          const Real weight = of_entry(stencil.weight[d], j);
          for (int v = 0; v < P::size; ++v) of[v][d] = of[v][d] + weight * (other[v] - w[v]);
        }
      }
    } else {
      std::array<std::array<Real, D>, D> matrix{};
      for (int j = 0; j < stencil.size; ++j) {
        const State other = beyond(j, w);
        const Mask<Real> held = holds(j);
        const auto [r, whole] = displacement(j);
        const Real weight = select(held, gather<Real>(phase.alpha.data(), neighbour(j)), Real(least_known));
        for (int a = 0; a < D; ++a)
          for (int b = 0; b < D; ++b)
            matrix[a][b] = matrix[a][b] + (weight * select(held, r[a] * r[b], whole[a] * whole[b]) +
                                           always_known * (whole[a] * whole[b]));
        for (int v = 0; v < P::size; ++v)
          for (int d = 0; d < D; ++d) of[v][d] = of[v][d] + (weight * r[d]) * (other[v] - w[v]);
      }
      const auto inverse = inverse_of(matrix);
      for (auto& g : of) g = product(inverse, g);
    }
    return of;
  }

  /// From the cell's part of the phase to the one beyond face j, and from cell to cell.
  std::pair<std::array<Real, D>, std::array<Real, D>> displacement(int j) const {
    std::array<Real, D> whole;
    for (int d = 0; d < D; ++d) whole[d] = of_entry(stencil.delta[d], j);
    auto r = whole;
    if (phase.centre.stride != 0) {
      const std::array<Real, D> own = centre(at);
      std::array<Real, D> other = centre(neighbour(j));
      reflect(j, [&](int d) -> Real& { return other[d]; });
      for (int d = 0; d < D; ++d) r[d] = r[d] + (other[d] - own[d]);
    }
    return {r, whole};
  }
  std::array<Real, D> centre(const Indices<Real>& cell) const {
    std::array<Real, D> r;
    for (int d = 0; d < D; ++d) r[d] = gather<Real>(phase.centre.component(d), cell);
    return r;
  }
  /// From the cell's part of the phase to that of face j.
  std::array<Real, D> to_face(int j) const {
    std::array<Real, D> r;
    for (int d = 0; d < D; ++d) r[d] = of_entry(stencil.to_face[d], j);
    if constexpr (A == Around::gaps) {
      if (phase.centre.stride != 0) {
        const std::array<Real, D> own = centre(at);
        Indices<Real> face = lookup<Real>(&faces.cell_faces[entry(j)], at);
        for (auto& f : face) f >>= 1;
        // cells with fewer faces than others have their own centroid instead, which limits nothing
        const Mask<Real> exists = gather<Real>(faces.area.data(), face) > Real(0.0);
        for (int d = 0; d < D; ++d)
          r[d] = select(exists, r[d] + (gather<Real>(phase.wetted_at[d].data(), face) - own[d]), Real(0.0));
      }
    }
    return r;
  }

  /// The gradients of the mirror image; w: the cell's own state.
  void mirror(typename P::template Gradients<Real>& gradient, int j, const State& w) const {
    for (auto& of_quantity : gradient) reflect(j, [&](int d) -> Real& { return of_quantity[d]; });
    for (int along = 0; along < D; ++along) {
      reflect(j, [&](int d) -> Real& { return gradient[P::u + d][along]; });
      if constexpr (K == Kind::solid)
        reflect_cobasis(j, body_normal(j, normal_of(j), w),
                        [&](int beta, int d) -> Real& { return gradient[P::e + beta * D + d][along]; });
    }
  }
};

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
