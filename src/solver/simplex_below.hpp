// The part of a triangle or tetrahedron below a height, for doubles and packs.
//
// Let h0 <= h1 <= ... be the heights of its corners and r_ij the part of the edge from corner i to corner j that lies
// below d, in [0, 1]. The volume below and the section are sums of products of r_ij and 1 - r_ij: nothing cancels, and
// where heights are equal r_ij is a step. The section is that of d approached from below.
#pragma once

#include <array>

#include "math/pack.hpp"

namespace cobasis {

inline constexpr double smallest_gap = 1e-300;

template <class Real>
Real inverse_gap(const Real& low, const Real& high) {
  return 1.0 / larger(high - low, Real(smallest_gap));
}
template <class Real>
Real part_below(const Real& d, const Real& low, const Real& inverse) {
  return smaller(larger((d - low) * inverse, Real(0.0)), Real(1.0));
}

template <class Real>
void sort_pair(Real& a, Real& b) {
  const Real low = smaller(a, b), high = larger(a, b);
  a = low;
  b = high;
}

template <class Real>
struct Below {
  Real fraction;  ///< of the simplex
  Real density;   ///< its derivative by d
};

template <int D, class Real>
struct SortedSimplex;

template <class Real>
struct SortedSimplex<2, Real> {
  Real h0, h1, i01, i02, i12;

  SortedSimplex() = default;
  explicit SortedSimplex(std::array<Real, 3> h) {
    sort_pair(h[0], h[1]), sort_pair(h[1], h[2]), sort_pair(h[0], h[1]);
    h0 = h[0], h1 = h[1];
    i01 = inverse_gap(h[0], h[1]), i02 = inverse_gap(h[0], h[2]), i12 = inverse_gap(h[1], h[2]);
  }
  Below<Real> below(const Real& d) const {
    const Real r01 = part_below(d, h0, i01), r02 = part_below(d, h0, i02), r12 = part_below(d, h1, i12);
    return {r01 * r02 + r12 * (1.0 - r02), 2.0 * r01 * (1.0 - r12) * i02};
  }
};

template <class Real>
struct SortedSimplex<3, Real> {
  Real h0, h1, h2, i01, i02, i03, i12, i13, i23;

  SortedSimplex() = default;
  explicit SortedSimplex(std::array<Real, 4> h) {
    sort_pair(h[0], h[1]), sort_pair(h[2], h[3]), sort_pair(h[0], h[2]), sort_pair(h[1], h[3]), sort_pair(h[1], h[2]);
    h0 = h[0], h1 = h[1], h2 = h[2];
    i01 = inverse_gap(h[0], h[1]), i02 = inverse_gap(h[0], h[2]), i03 = inverse_gap(h[0], h[3]);
    i12 = inverse_gap(h[1], h[2]), i13 = inverse_gap(h[1], h[3]), i23 = inverse_gap(h[2], h[3]);
  }
  Below<Real> below(const Real& d) const {
    const Real r01 = part_below(d, h0, i01), r02 = part_below(d, h0, i02), r03 = part_below(d, h0, i03);
    const Real r12 = part_below(d, h1, i12), r13 = part_below(d, h1, i13), r23 = part_below(d, h2, i23);
    // Tetrahedra (p0, x01, x02, x03), (p1, x12, x02, x03), (p1, x12, x13, x03), (p2, x23, x13, x03).
    const Real fraction = r01 * r02 * r03 + r12 * r03 * (1.0 - r02) + (1.0 - r03) * (r12 * r13 + r23 * (1.0 - r13));
    const Real density = r01 * (1.0 - r12) * r02 + r12 * (1.0 - r23) * (1.0 - r13);
    return {fraction, 3.0 * density * i03};
  }
};

}  // namespace cobasis
