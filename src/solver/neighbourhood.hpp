// What a phase has in a cell and beyond its faces, mirror images among it, and the gradient that follows.
#pragma once

#include "physics/smooth_flow.hpp"
#include "solver/mean_state.hpp"
#include "solver/stencil.hpp"

namespace cobasis {

/// A phase has slopes in a cell that holds more than this of it, over neighbours that do too: what a trace does is no
/// measure of the others.
inline constexpr double least_for_slopes = 0.05;

/// What is around the cells of a list: neighbours that all hold the phase, the same and mirrors among them, or also
/// neighbours without it.
enum class Around { phase, mirrors, gaps };

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
  bool is_mirror_of_any(int j) const { return any(of_entry(stencil.mirror, j) > Real(0.0)); }
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
  /// Behind face j: another cell, or the mirror image of this one. Where that does not hold the phase, `w`, the cell's
  /// own state.
  State beyond(int j, const State& w) const {
    State other = state(neighbour(j));
    if constexpr (A != Around::phase) {
      reflect(j, [&](int d) -> Real& { return other[P::u + d]; });
      if constexpr (K == Kind::solid)
        if (is_mirror_of_any(j))
          reflect_cobasis(j, body_normal(j, normal_of(j), w),
                          [&](int beta, int d) -> Real& { return other[P::e + beta * D + d]; });
    }
    if constexpr (A == Around::gaps) {
      const Mask<Real> there = holds(j);
      for (int v = 0; v < P::size; ++v) other[v] = select(there, other[v], w[v]);
    }
    return other;
  }
  /// Whether the phase is behind face j. Its mirror image is where it touches the mirror: of a wall that something else
  /// lies before, a body knows nothing.
  Mask<Real> holds(int j) const {
    Mask<Real> there = gather<Real>(phase.alpha.data(), neighbour(j)) > Real(least_for_slopes);
    if (!phase.wetted[0].empty() && is_mirror_of_any(j)) {
      Indices<Real> face = lookup<Real>(&faces.cell_faces[entry(j)], at);
      for (auto& f : face) f >>= 1;
      const Mask<Real> full = gather<Real>(phase.alpha.data(), at) == Real(1.0);
      const Mask<Real> touches = gather<Real>(phase.wetted[0].data(), face) > Real(0.0);
      there = there && (full || touches || !(of_entry(stencil.mirror, j) > Real(0.0)));
    }
    return there;
  }
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
    if (!is_mirror_of_any(j)) return;
    for (auto& of_quantity : gradient) reflect(j, [&](int d) -> Real& { return of_quantity[d]; });
    for (int along = 0; along < D; ++along) reflect(j, [&](int d) -> Real& { return gradient[P::u + d][along]; });
    if constexpr (K == Kind::solid) {
      const std::array<Real, D> in_body = body_normal(j, normal_of(j), w);
      for (int along = 0; along < D; ++along)
        reflect_cobasis(j, in_body, [&](int beta, int d) -> Real& { return gradient[P::e + beta * D + d][along]; });
    }
  }
};

}  // namespace cobasis
