// Pack: as many doubles as the machine adds at once. Everything that depends on how it is made is in this file.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <experimental/simd>
#if defined(__AVX2__)
#include <immintrin.h>
#endif

/// A loop over cells or faces: all that it calls is inlined, so that packs stay in registers.
#define COBASIS_KERNEL [[gnu::flatten]]

namespace cobasis {

using Pack = std::experimental::native_simd<double>;

template <class Real>
inline constexpr int lanes = 1;
template <>
inline constexpr int lanes<Pack> = Pack::size();
inline constexpr int pack_width = lanes<Pack>;

template <class Real>
struct MaskOf {
  using type = bool;
};
template <>
struct MaskOf<Pack> {
  using type = Pack::mask_type;
};
template <class Real>
using Mask = typename MaskOf<Real>::type;

template <class Real>
Real select(bool mask, Real yes, Real no) {
  return mask ? yes : no;
}
inline Pack select(const Pack::mask_type& mask, const Pack& yes, Pack no) {
  where(mask, no) = yes;
  return no;
}
inline Pack select(const Pack::mask_type& mask, const Pack& yes, double no) { return select(mask, yes, Pack(no)); }

/// Whether a value is not a number.
template <class Real>
Mask<Real> is_nan(const Real& value) {
  return value != value;  // NOLINT(misc-redundant-expression)
}

inline bool any(bool mask) { return mask; }
inline bool any(const Pack::mask_type& mask) { return any_of(mask); }

/// One lane of a number or mask.
inline double lane(double x, int) { return x; }
inline double lane(const Pack& x, int i) { return x[i]; }
inline bool lane(bool x, int) { return x; }
inline bool lane(const Pack::mask_type& x, int i) { return x[i]; }

inline double smaller(double a, double b) { return a < b ? a : b; }
inline double larger(double a, double b) { return a > b ? a : b; }
inline Pack smaller(const Pack& a, const Pack& b) { return std::experimental::min(a, b); }
inline Pack larger(const Pack& a, const Pack& b) { return std::experimental::max(a, b); }

inline double square_root(double x) { return std::sqrt(x); }
inline Pack square_root(const Pack& x) { return std::experimental::sqrt(x); }
inline double magnitude(double x) { return std::fabs(x); }
inline Pack magnitude(const Pack& x) { return std::experimental::abs(x); }

/// Indices of one pack of cells, faces or slots.
template <class Real>
using Indices = std::array<std::int32_t, lanes<Real>>;

template <class Real>
Indices<Real> load_indices(const std::int32_t* from) {
  Indices<Real> at;
  std::memcpy(at.data(), from, sizeof at);
  return at;
}
/// table[at], lane by lane.
template <class Real>
Indices<Real> lookup(const std::int32_t* table, const Indices<Real>& at) {
#if defined(__AVX2__)
  if constexpr (lanes<Real> == 8)
    return std::bit_cast<Indices<Real>>(_mm256_i32gather_epi32(table, std::bit_cast<__m256i>(at), 4));
#endif
  Indices<Real> found;
  for (int i = 0; i < lanes<Real>; ++i) found[i] = table[at[i]];
  return found;
}

template <class Real>
Real load(const double* from) {
  if constexpr (lanes<Real> == 1)
    return *from;
  else
    return Real(from, std::experimental::element_aligned);
}
template <class Real>
void store(const Real& value, double* to) {
  if constexpr (lanes<Real> == 1)
    *to = value;
  else
    value.copy_to(to, std::experimental::element_aligned);
}

template <class Real>
Real gather(const double* from, const Indices<Real>& at) {
  if constexpr (lanes<Real> == 1) {
    return from[at[0]];
  } else {
#if defined(__AVX512F__)
    return Real(_mm512_mask_i32gather_pd(_mm512_setzero_pd(), 0xFF, std::bit_cast<__m256i>(at), from, 8));
#else
    return Real([&](auto i) { return from[at[i]]; });
#endif
  }
}
/// Lanes that name the same place must carry the same value.
template <class Real>
void scatter(const Real& value, double* to, const Indices<Real>& at) {
  if constexpr (lanes<Real> == 1) {
    to[at[0]] = value;
  } else {
#if defined(__AVX512F__)
    _mm512_i32scatter_pd(to, std::bit_cast<__m256i>(at), static_cast<__m512d>(value), 8);
#else
    for (int i = 0; i < lanes<Real>; ++i) to[at[i]] = value[i];
#endif
  }
}

/// Lanes with x > 0, as bits.
inline unsigned positive_lanes(const Pack& x) {
#if defined(__AVX512F__)
  return _mm512_cmp_pd_mask(static_cast<__m512d>(x), _mm512_setzero_pd(), _CMP_GT_OQ);
#else
  unsigned bits = 0;
  for (int i = 0; i < pack_width; ++i) bits |= static_cast<unsigned>(x[i] > 0) << i;
  return bits;
#endif
}

/// Writes the chosen lanes one after the other; a whole pack of memory must be there.
inline void store_chosen(unsigned bits, const Pack& x, double* to) {
#if defined(__AVX512F__)
  _mm512_storeu_pd(to, _mm512_maskz_compress_pd(static_cast<__mmask8>(bits), static_cast<__m512d>(x)));
#else
  for (int i = 0; i < pack_width; ++i)
    if (bits >> i & 1) *to++ = x[i];
#endif
}
inline void store_chosen(unsigned bits, const Indices<Pack>& x, std::int32_t* to) {
#if defined(__AVX512F__) && defined(__AVX512VL__)
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(to),
                      _mm256_maskz_compress_epi32(static_cast<__mmask8>(bits), std::bit_cast<__m256i>(x)));
#else
  for (; bits != 0; bits &= bits - 1) *to++ = x[std::countr_zero(bits)];
#endif
}
/// Lanes where two indices agree, as bits.
inline unsigned equal_lanes(const Indices<Pack>& a, const Indices<Pack>& b) {
#if defined(__AVX512F__) && defined(__AVX512VL__)
  return _mm256_cmpeq_epi32_mask(std::bit_cast<__m256i>(a), std::bit_cast<__m256i>(b));
#else
  unsigned bits = 0;
  for (int i = 0; i < pack_width; ++i) bits |= static_cast<unsigned>(a[i] == b[i]) << i;
  return bits;
#endif
}

/// Cube root of a positive normal number, without branches: exponent by integer arithmetic, then Halley's iteration,
/// which triples the digits each time (5 -> 15 -> round-off).
template <class Real>
Real cube_root(const Real& x) {
  std::array<double, lanes<Real>> y;
  store(x, y.data());
  for (double& value : y) {
    const std::uint64_t high = std::bit_cast<std::uint64_t>(value) >> 32;
    value = std::bit_cast<double>((((high * 0x55555556u) >> 32) + 0x2A9F7893u) << 32);
  }
  Real root = load<Real>(y.data());
  for (int iteration = 0; iteration < 3; ++iteration) {
    const Real cube = root * root * root;
    root = root * ((cube + (x + x)) / ((cube + cube) + x));
  }
  return root;
}

}  // namespace cobasis
