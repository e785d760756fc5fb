// Random frames, deformations and face states of space scenes.
#pragma once

#include <array>
#include <cmath>
#include <random>

#include "physics/face_state.hpp"

namespace cobasis {

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  double magnitude(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }

  /// Three orthonormal vectors, right-handed.
  Frame<Space, double> frame() {
    std::normal_distribution<double> normal;
    const auto unit = [](const Point& v) { return (1 / std::sqrt(dot(v, v))) * v; };
    const auto direction = [&] { return unit(Point{normal(engine_), normal(engine_), normal(engine_)}); };
    const Point n = direction();
    Point t1 = direction();
    t1 = unit(t1 - dot(t1, n) * n);
    t1 = unit(t1 - dot(t1, n) * n);
    return {n, t1, cross(n, t1)};
  }

  /// The same normal, other tangents.
  Frame<Space, double> turned(const Frame<Space, double>& frame) {
    const double angle = between(0, 6.283);
    const Point t1 = std::cos(angle) * frame.t1 + std::sin(angle) * frame.t2;
    return {frame.n, t1, cross(frame.n, t1)};
  }

  /// Rotated stretches between exp(-strain) and exp(strain).
  Cobasis<Space, double> cobasis(double strain) {
    const Frame<Space, double> q = frame(), s = frame();
    const Point stretch{std::exp(between(-strain, strain)), std::exp(between(-strain, strain)),
                        std::exp(between(-strain, strain))};
    const auto column = [&](const Point& row) {
      return (stretch.x * row.x) * q.n + (stretch.y * row.y) * q.t1 + (stretch.z * row.z) * q.t2;
    };
    return {column(s.n), column(s.t1), column(s.t2)};
  }

  SolidFace<Space, double> face(double largest_velocity = 3000) {
    SolidFace<Space, double> s;
    s.rho = magnitude(1, 1e4);
    const auto velocity = [&] { return between(-largest_velocity, largest_velocity); };
    s.u = {velocity(), velocity(), velocity()};
    s.c1 = magnitude(300, 6000);
    s.cs = s.c1 * between(0.3, 0.9);
    s.P = s.rho * s.c1 * s.c1 * between(-0.5, 2);
    s.E = 0.5 * dot(s.u, s.u) + s.c1 * s.c1 * between(0.5, 3);
    s.tau = {{}, s.rho * s.cs * s.cs * between(-0.3, 0.3), s.rho * s.cs * s.cs * between(-0.3, 0.3)};
    return s;
  }

 private:
  std::mt19937 engine_;
};

/// Entries of a cobasis: [beta][i].
template <class Real>
using Rows = std::array<std::array<Real, 3>, 3>;

template <class Real>
Rows<Real> rows(const Cobasis<Space, double>& e) {
  return {{{e.e1.x, e.e1.y, e.e1.z}, {e.e2.x, e.e2.y, e.e2.z}, {e.e3.x, e.e3.y, e.e3.z}}};
}
template <class Real>
Cobasis<Space, Real> cobasis_of(const Rows<Real>& r) {
  return {{r[0][0], r[0][1], r[0][2]}, {r[1][0], r[1][1], r[1][2]}, {r[2][0], r[2][1], r[2][2]}};
}
template <class Real>
Rows<Real> matrix(const Symmetric<Space, Real>& s) {
  return {{{s.xx, s.xy, s.xz}, {s.xy, s.yy, s.yz}, {s.xz, s.yz, s.zz}}};
}
inline std::array<double, 3> list(const Point& v) { return {v.x, v.y, v.z}; }

/// The plane-strain part of a random deformation, in both geometries.
inline std::pair<Cobasis<Plane, double>, Cobasis<Space, double>> plane_strain(Random& random) {
  const double xx = random.between(0.7, 1.4), xy = random.between(-0.3, 0.3), yx = random.between(-0.3, 0.3),
               yy = random.between(0.7, 1.4), zz = random.between(0.7, 1.4);
  return {{{xx, xy, {}}, {yx, yy, {}}, {{}, {}, zz}}, {{xx, xy, 0}, {yx, yy, 0}, {0, 0, zz}}};
}

}  // namespace cobasis
