// The bits of a binary32 or binary64 number: ordinals, units in the last place, neighbours. Integer arithmetic only,
// so that nothing here depends on rounding mode, FTZ or DAZ.
#pragma once
#include <bit>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace plumbline {

template <class Real>
  requires std::is_same_v<Real, float> || std::is_same_v<Real, double>
struct FloatFormat {
  using Bits = std::conditional_t<std::is_same_v<Real, float>, std::uint32_t, std::uint64_t>;
  using Ordinal = std::conditional_t<std::is_same_v<Real, float>, std::int32_t, std::int64_t>;
  static constexpr int precision = std::numeric_limits<Real>::digits;  // significant bits, the hidden one included
  static constexpr int fraction_bits = precision - 1;
  static constexpr int max_exponent = std::numeric_limits<Real>::max_exponent - 1;   // of the leading bit of max()
  static constexpr int min_exponent = std::numeric_limits<Real>::min_exponent - 1;   // of the least normal number
  static constexpr int least_exponent = min_exponent - fraction_bits;                // of the least subnormal
  static constexpr Bits sign_bit = Bits{1} << (8 * sizeof(Real) - 1);
  static constexpr Bits fraction_mask = (Bits{1} << fraction_bits) - 1;
  static constexpr Bits exponent_mask = static_cast<Bits>(~sign_bit & ~fraction_mask);
};

template <class Real>
constexpr auto to_bits(Real x) {
  return std::bit_cast<typename FloatFormat<Real>::Bits>(x);
}

template <class Real>
constexpr Real from_bits(typename FloatFormat<Real>::Bits bits) {
  return std::bit_cast<Real>(bits);
}

template <class Real>
constexpr bool is_finite(Real x) {
  using F = FloatFormat<Real>;
  return (to_bits(x) & F::exponent_mask) != F::exponent_mask;
}

template <class Real>
constexpr bool is_nan(Real x) {
  using F = FloatFormat<Real>;
  return (to_bits(x) & ~F::sign_bit) > F::exponent_mask;
}

/// +0 or -0; a subnormal is not zero, DAZ or not.
template <class Real>
constexpr bool is_zero(Real x) {
  return (to_bits(x) & ~FloatFormat<Real>::sign_bit) == 0;
}

template <class Real>
constexpr bool is_negative(Real x) {
  return (to_bits(x) & FloatFormat<Real>::sign_bit) != 0;
}

/// The position of x among all numbers of its format: neighbours differ by 1, +0 and -0 are both 0. x is not NaN.
template <class Real>
constexpr auto ordinal(Real x) {
  using F = FloatFormat<Real>;
  const auto magnitude = static_cast<typename F::Ordinal>(to_bits(x) & ~F::sign_bit);
  return is_negative(x) ? static_cast<typename F::Ordinal>(-magnitude) : magnitude;
}

template <class Real>
constexpr Real from_ordinal(typename FloatFormat<Real>::Ordinal n) {
  using F = FloatFormat<Real>;
  using Bits = typename F::Bits;
  return n < 0 ? from_bits<Real>(static_cast<Bits>(-n) | F::sign_bit) : from_bits<Real>(static_cast<Bits>(n));
}

/// The number n units in the last place above x (below, if n < 0), stopping at +-infinity.
template <class Real>
constexpr Real step_ulps(Real x, typename FloatFormat<Real>::Ordinal n) {
  using F = FloatFormat<Real>;
  constexpr auto inf = static_cast<typename F::Ordinal>(F::exponent_mask);
  const auto at = ordinal(x);
  if (n > 0 && at > inf - n) return from_ordinal<Real>(inf);
  if (n < 0 && at < -inf - n) return from_ordinal<Real>(-inf);
  return from_ordinal<Real>(at + n);
}

/// The exponent of the unit in the last place of x: ulp(x) = 2^ulp_exponent(x). That of zero is the least
/// subnormal's. x is finite.
template <class Real>
constexpr int ulp_exponent(Real x) {
  using F = FloatFormat<Real>;
  const int biased = static_cast<int>((to_bits(x) & F::exponent_mask) >> F::fraction_bits);
  return F::least_exponent + (biased > 1 ? biased - 1 : 0);
}

/// Whether x is a binary32 number: rounding it to binary32 changes nothing.
constexpr bool is_binary32(double x) {
  if (!is_finite(x) || is_zero(x)) return true;
  using F = FloatFormat<double>;
  const int biased = static_cast<int>((to_bits(x) & F::exponent_mask) >> F::fraction_bits);
  const auto fraction = to_bits(x) & F::fraction_mask;
  const auto significand = biased == 0 ? fraction : fraction | (F::fraction_mask + 1);
  const int low = std::countr_zero(significand) + F::least_exponent + (biased > 1 ? biased - 1 : 0);
  const int high = static_cast<int>(std::bit_width(significand)) - 1 + F::least_exponent + (biased > 1 ? biased - 1 : 0);
  using S = FloatFormat<float>;
  return high <= S::max_exponent && low >= S::least_exponent && high - low < S::precision;
}

}  // namespace plumbline
