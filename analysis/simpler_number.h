// What makes a number simple, for shrinking.
#pragma once
#include <bit>
#include <cmath>
#include <cstdint>

#include "case/float_bits.h"

namespace plumbline {

inline std::uint64_t significand(double v) {
  using F = FloatFormat<double>;
  const std::uint64_t bits = to_bits(v) & ~F::sign_bit, fraction = bits & F::fraction_mask;
  return bits > F::fraction_mask ? fraction | (F::fraction_mask + 1) : fraction;
}

/// From the first bit that is set to the last: 1 for a power of two, 0 for 0.
inline unsigned significant_bits(double v) {
  const std::uint64_t s = significand(v);
  return s == 0 ? 0 : static_cast<unsigned>(std::bit_width(s >> std::countr_zero(s)));
}

/// Simpler is less: four for a significant bit, one for a power of two that the leading bit is away from 1, one for a
/// minus sign. An infinity has no bits.
inline unsigned weight(double v) {
  if (is_zero(v) || !is_finite(v)) return is_negative(v);
  return 4 * significant_bits(v) + static_cast<unsigned>(std::abs(std::ilogb(v))) + is_negative(v);
}

/// To `bits` significant bits: to nearest, down (direction < 0) or up.
inline double rounded_to_bits(double v, int bits, int direction) {
  if (is_zero(v) || !is_finite(v)) return v;
  int exponent;
  const double scaled = std::ldexp(std::frexp(v, &exponent), bits);
  const double r = direction == 0 ? std::nearbyint(scaled) : direction > 0 ? std::ceil(scaled) : std::floor(scaled);
  return std::ldexp(r, exponent - bits);
}

}  // namespace plumbline
