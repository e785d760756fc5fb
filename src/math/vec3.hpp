// Vectors whose components are numbers, packs of numbers, or the compile-time Zero. A plane scene writes the same
// three-dimensional formulas as a space scene; what is Zero by geometry costs neither memory nor arithmetic.
#pragma once

#include <type_traits>

namespace cobasis {

/// The number zero as a type: sums drop it, products with it vanish at compile time.
struct Zero {};

template <class X, class Y = X, class Z = X>
struct Vec3;
template <class T>
inline constexpr bool is_vector = false;
template <class X, class Y, class Z>
inline constexpr bool is_vector<Vec3<X, Y, Z>> = true;
template <class T>
concept NotZero = !std::is_same_v<std::remove_cvref_t<T>, Zero> && !is_vector<std::remove_cvref_t<T>>;

constexpr Zero operator-(Zero) { return {}; }
constexpr Zero operator+(Zero, Zero) { return {}; }
constexpr Zero operator-(Zero, Zero) { return {}; }
constexpr Zero operator*(Zero, Zero) { return {}; }
template <NotZero T>
constexpr T operator+(const T& x, Zero) {
  return x;
}
template <NotZero T>
constexpr T operator+(Zero, const T& x) {
  return x;
}
template <NotZero T>
constexpr T operator-(const T& x, Zero) {
  return x;
}
template <NotZero T>
constexpr T operator-(Zero, const T& x) {
  return -x;
}
template <NotZero T>
constexpr Zero operator*(const T&, Zero) {
  return {};
}
template <NotZero T>
constexpr Zero operator*(Zero, const T&) {
  return {};
}
template <NotZero T>
constexpr Zero operator/(Zero, const T&) {
  return {};
}

template <class X, class Y, class Z>
struct Vec3 {
  X x{};
  Y y{};
  Z z{};
};
template <class X, class Y, class Z>
Vec3(X, Y, Z) -> Vec3<X, Y, Z>;

using Point = Vec3<double>;

template <class A, class B, class C, class P, class Q, class R>
constexpr auto dot(const Vec3<A, B, C>& a, const Vec3<P, Q, R>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class A, class B, class C, class P, class Q, class R>
constexpr auto operator+(const Vec3<A, B, C>& a, const Vec3<P, Q, R>& b) {
  return Vec3{a.x + b.x, a.y + b.y, a.z + b.z};
}

template <class A, class B, class C, class P, class Q, class R>
constexpr auto operator-(const Vec3<A, B, C>& a, const Vec3<P, Q, R>& b) {
  return Vec3{a.x - b.x, a.y - b.y, a.z - b.z};
}

template <class S, class P, class Q, class R>
constexpr auto operator*(const S& s, const Vec3<P, Q, R>& a) {
  return Vec3{s * a.x, s * a.y, s * a.z};
}

template <class A, class B, class C, class P, class Q, class R>
constexpr auto cross(const Vec3<A, B, C>& a, const Vec3<P, Q, R>& b) {
  return Vec3{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace cobasis
