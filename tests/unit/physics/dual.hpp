// A number that carries its derivative with respect to one parameter, for use as `Real` in the physics.
#pragma once

#include <cmath>

#include "math/pack.hpp"

namespace cobasis {

struct Dual {
  double value = 0, slope = 0;

  Dual() = default;
  Dual(double v, double s = 0) : value(v), slope(s) {}  // NOLINT: a number is a constant

  friend Dual operator-(const Dual& a) { return {-a.value, -a.slope}; }
  friend Dual operator+(const Dual& a, const Dual& b) { return {a.value + b.value, a.slope + b.slope}; }
  friend Dual operator-(const Dual& a, const Dual& b) { return {a.value - b.value, a.slope - b.slope}; }
  friend Dual operator*(const Dual& a, const Dual& b) {
    return {a.value * b.value, a.slope * b.value + a.value * b.slope};
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const double q = a.value / b.value;
    return {q, (a.slope - q * b.slope) / b.value};
  }
  friend bool operator<(const Dual& a, const Dual& b) { return a.value < b.value; }
  friend bool operator>(const Dual& a, const Dual& b) { return a.value > b.value; }
  friend bool operator<=(const Dual& a, const Dual& b) { return a.value <= b.value; }
  friend bool operator>=(const Dual& a, const Dual& b) { return a.value >= b.value; }
};

inline Dual smaller(const Dual& a, const Dual& b) { return a < b ? a : b; }
inline Dual larger(const Dual& a, const Dual& b) { return a > b ? a : b; }
inline Dual magnitude(const Dual& x) { return x < 0 ? -x : x; }
inline Dual square_root(const Dual& x) {
  const double root = std::sqrt(x.value);
  return {root, 0.5 * x.slope / root};
}
inline Dual cube_root(const Dual& x) {
  const double root = std::cbrt(x.value);
  return {root, x.slope / (3 * root * root)};
}

}  // namespace cobasis
