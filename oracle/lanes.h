// W binary64 numbers, or 64-bit integers, side by side: the compilers' vector extensions, so that one source serves every
// instruction set. Comparisons give -1 (true) or 0 per lane, and `mask ? x : y` selects per lane.
//
// Included only by the batch kernels, each compiled for another instruction set, and bag/box_probe.h: everything here has
// internal linkage, so that no function compiled for a newer processor can be linked into an older one's path.
#pragma once
#if defined(__FAST_MATH__) || (defined(__FLT_EVAL_METHOD__) && __FLT_EVAL_METHOD__ != 0)
#error "The oracle's proofs need IEEE 754 operations as written: no -ffast-math, no x87 excess precision."
#endif
#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include <bit>
#include <cstdint>
#include <cstring>

namespace plumbline {
namespace {

template <int W>
struct Lanes {
  typedef double Real __attribute__((vector_size(8 * W)));
  typedef long long Int __attribute__((vector_size(8 * W)));
  typedef unsigned long long Word __attribute__((vector_size(8 * W)));

  static Int as_int(Real x) { return (Int)x; }  // the bits
  static Real as_real(Int x) { return (Real)x; }
  static Int no(Int mask) { return ~mask; }
  static Real load(const double* p) {
    Real r;
    std::memcpy(&r, p, sizeof r);
    return r;
  }
  static Real all(double x) { return (Real)(Int{} + std::bit_cast<long long>(x)); }  // bits: FTZ flushes no sum
  static Real abs(Real x) { return as_real(as_int(x) & 0x7fffffffffffffffll); }
  /// Of a NaN operand, the second.
  static Real max(Real x, Real y) { return x > y ? x : y; }
  static Real min(Real x, Real y) { return x < y ? x : y; }
  /// The larger magnitude; of a NaN and a number, either.
  static Real max_abs(Real x, Real y) {
#if defined(__AVX512DQ__)
    if constexpr (W == 8) return (Real)_mm512_range_pd((__m512d)x, (__m512d)y, 0x0b);
#endif
    return max(abs(x), abs(y));
  }
  static bool all_true(Int mask) { return bits(mask) == (1u << W) - 1; }
  /// The product of the low halves, as signed 32-bit integers.
  static Int multiply_halves(Int x, Int y) {
#if defined(__AVX512F__)
    if constexpr (W == 8) return (Int)_mm512_mul_epi32((__m512i)x, (__m512i)y);
#endif
#if defined(__AVX2__)
    if constexpr (W == 4) return (Int)_mm256_mul_epi32((__m256i)x, (__m256i)y);
#endif
    return (Int)((Word)(x << 32 >> 32) * (Word)(y << 32 >> 32));
  }

  /// One bit per lane: whether its mask is true.
  static unsigned bits(Int mask) {
#if defined(__AVX512DQ__)
    if constexpr (W == 8) return _mm512_movepi64_mask((__m512i)mask);
#endif
#if defined(__AVX__)
    if constexpr (W == 4) return static_cast<unsigned>(_mm256_movemask_pd((__m256d)mask));
#endif
#if defined(__SSE2__)
    if constexpr (W == 2) return static_cast<unsigned>(_mm_movemask_pd((__m128d)mask));
#endif
    long long lane[W];
    std::memcpy(lane, &mask, sizeof lane);
    unsigned r = 0;
    for (int i = 0; i < W; ++i) r |= (lane[i] != 0 ? 1u : 0u) << i;
    return r;
  }
};

/// One lane: plain numbers, and masks that are 0 or 1.
template <>
struct Lanes<1> {
  using Real = double;
  using Int = long long;
  using Word = unsigned long long;

  static Int as_int(Real x) { return std::bit_cast<Int>(x); }
  static Real as_real(Int x) { return std::bit_cast<Real>(x); }
  static Int no(Int mask) { return mask ^ 1; }
  static Real abs(Real x) { return as_real(as_int(x) & 0x7fffffffffffffffll); }
  static Real max(Real x, Real y) { return x > y ? x : y; }
  static Real min(Real x, Real y) { return x < y ? x : y; }
  static Real max_abs(Real x, Real y) { return max(abs(x), abs(y)); }
  static bool all_true(Int mask) { return mask != 0; }
};

}  // namespace
}  // namespace plumbline
