// A number that carries its derivative with respect to one parameter, for use as `Real` in the physics.
#pragma once

#include "math/pack.hpp"

namespace cobasis {

/// `Value`: double or Pack.
template <class Value>
struct DualNumber {
  Value value = 0, slope = 0;

  DualNumber() = default;
  DualNumber(const Value& v, const Value& s = Value(0.0)) : value(v), slope(s) {}  // NOLINT: a number is a constant
  DualNumber(double v)                                                             // NOLINT
      requires(!std::is_same_v<Value, double>)
      : value(v), slope(0.0) {}

  friend DualNumber operator-(const DualNumber& a) { return {-a.value, -a.slope}; }
  friend DualNumber operator+(const DualNumber& a, const DualNumber& b) {
    return {a.value + b.value, a.slope + b.slope};
  }
  friend DualNumber operator-(const DualNumber& a, const DualNumber& b) {
    return {a.value - b.value, a.slope - b.slope};
  }
  friend DualNumber operator*(const DualNumber& a, const DualNumber& b) {
    return {a.value * b.value, a.slope * b.value + a.value * b.slope};
  }
  friend DualNumber operator*(double a, const DualNumber& b) { return {a * b.value, a * b.slope}; }
  friend DualNumber operator*(const DualNumber& a, double b) { return b * a; }
  friend DualNumber operator/(const DualNumber& a, double b) { return {a.value / b, a.slope / b}; }
  friend DualNumber operator/(const DualNumber& a, const DualNumber& b) {
    const Value q = a.value / b.value;
    return {q, (a.slope - q * b.slope) / b.value};
  }
  friend bool operator<(const DualNumber& a, const DualNumber& b) { return a.value < b.value; }
  friend bool operator>(const DualNumber& a, const DualNumber& b) { return a.value > b.value; }
  friend bool operator<=(const DualNumber& a, const DualNumber& b) { return a.value <= b.value; }
  friend bool operator>=(const DualNumber& a, const DualNumber& b) { return a.value >= b.value; }
};

using Dual = DualNumber<double>;

inline Dual smaller(const Dual& a, const Dual& b) { return a < b ? a : b; }
inline Dual larger(const Dual& a, const Dual& b) { return a > b ? a : b; }
inline Dual magnitude(const Dual& x) { return x < 0 ? -x : x; }
template <class Value>
DualNumber<Value> square_root(const DualNumber<Value>& x) {
  const Value root = square_root(x.value);
  return {root, 0.5 * x.slope / root};
}
template <class Value>
DualNumber<Value> cube_root(const DualNumber<Value>& x) {
  const Value root = cube_root(x.value);
  return {root, x.slope / (3.0 * root * root)};
}

}  // namespace cobasis
