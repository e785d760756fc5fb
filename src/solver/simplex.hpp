// Triangles and tetrahedra, and their part inside a surface.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "math/vec3.hpp"

namespace cobasis {

/// Triangle (D = 2) or tetrahedron (D = 3). Its measure carries a sign: summed over the simplices of a cell, parts that
/// lie outside a very distorted cell cancel.
template <int D>
using Simplex = std::array<Point, D + 1>;

inline double length_of(const Point& a) { return std::sqrt(dot(a, a)); }

inline double measure(const Simplex<2>& s) {
  const Point a = s[1] - s[0], b = s[2] - s[0];
  return 0.5 * (a.x * b.y - a.y * b.x);
}
inline double measure(const Simplex<3>& s) { return dot(s[1] - s[0], cross(s[2] - s[0], s[3] - s[0])) / 6; }

/// The part of a simplex inside a surface that crosses each edge at most once.
template <int D>
struct Cut {
  std::vector<Simplex<D>> inside;  ///< together the part inside, oriented as the simplex
  std::vector<Point> surface;      ///< corners of the cut, in order around it; empty if there is none
};

/// `is_inside`: per corner. `crossing(i, o)`: where the edge from the inside corner i to the outside corner o is cut.
template <int D, class Crossing>
Cut<D> cut_simplex(const Simplex<D>& s, const std::array<bool, D + 1>& is_inside, const Crossing& crossing) {
  // Inside corners first; an odd number of exchanges turns the orientation, which measure() would see.
  std::array<int, D + 1> order{};
  int n_inside = 0;
  for (int i = 0; i <= D; ++i) {
    if (is_inside[i]) order[n_inside++] = i;
  }
  for (int i = 0, n = n_inside; i <= D; ++i) {
    if (!is_inside[i]) order[n++] = i;
  }
  if (n_inside == 0) return {};
  if (n_inside == D + 1) return {{s}, {}};
  bool odd = false;
  for (int i = 0; i <= D; ++i) {
    for (int j = i + 1; j <= D; ++j) odd ^= order[i] > order[j];
  }

  const auto p = [&](int i) { return s[order[i]]; };
  const auto x = [&](int i, int j) { return crossing(order[i], order[j]); };
  Cut<D> cut;
  if constexpr (D == 2) {
    if (n_inside == 1) {
      const Point a = x(0, 1), b = x(0, 2);
      cut = {{{p(0), a, b}}, {a, b}};
    } else {
      const Point a = x(0, 2), b = x(1, 2);
      cut = {{{p(0), p(1), b}, {p(0), b, a}}, {a, b}};
    }
  } else {
    // A prism with the triangles (a0, a1, a2), (b0, b1, b2).
    const auto prism = [](const Point& a0, const Point& a1, const Point& a2, const Point& b0, const Point& b1,
                          const Point& b2) -> std::vector<Simplex<3>> {
      return {{a0, a1, a2, b0}, {a1, b1, a2, b0}, {a2, b1, b2, b0}};
    };
    if (n_inside == 1) {
      const Point a = x(0, 1), b = x(0, 2), c = x(0, 3);
      cut = {{{p(0), a, b, c}}, {a, b, c}};
    } else if (n_inside == 2) {
      const Point a = x(0, 2), b = x(0, 3), c = x(1, 2), d = x(1, 3);
      cut = {prism(p(0), a, b, p(1), c, d), {a, b, d, c}};
    } else {
      const Point a = x(0, 3), b = x(1, 3), c = x(2, 3);
      cut = {prism(p(0), p(1), p(2), a, b, c), {a, b, c}};
    }
  }
  if (odd) {
    for (Simplex<D>& part : cut.inside) std::swap(part[0], part[1]);
  }
  return cut;
}

/// Cut where the linear interpolant of the signed distance d vanishes.
template <int D, class Distance>
Cut<D> cut_linear(const Simplex<D>& s, const Distance& distance) {
  std::array<double, D + 1> d{};
  std::array<bool, D + 1> is_inside{};
  for (int i = 0; i <= D; ++i) {
    d[i] = distance(s[i]);
    is_inside[i] = d[i] >= 0;
  }
  return cut_simplex<D>(s, is_inside, [&](int i, int o) { return s[i] + (d[i] / (d[i] - d[o])) * (s[o] - s[i]); });
}

template <int D>
std::pair<Simplex<D>, Simplex<D>> bisect_longest_edge(const Simplex<D>& s) {
  int a = 0, b = 1;
  double longest = 0;
  for (int i = 0; i <= D; ++i) {
    for (int j = i + 1; j <= D; ++j) {
      const Point edge = s[j] - s[i];
      if (const double squared = dot(edge, edge); squared > longest) longest = squared, a = i, b = j;
    }
  }
  std::pair halves(s, s);
  halves.first[a] = halves.second[b] = 0.5 * (s[a] + s[b]);
  return halves;
}

template <int D>
double longest_edge(const Simplex<D>& s) {
  double longest = 0;
  for (int i = 0; i <= D; ++i) {
    for (int j = i + 1; j <= D; ++j) longest = std::max(longest, length_of(s[j] - s[i]));
  }
  return longest;
}

}  // namespace cobasis
