// The quotient of two integers of several words, rounded correctly where one 64-bit division tells how. Private to the
// oracle.
#pragma once
#include <optional>

#include "case/float_bits.h"
#include "oracle/normalized.h"

namespace plumbline {

/// numerator / denominator * 2^exponent, to nearest, ties to even. No value where the exact quotient is too near to a tie,
/// or where the result would be subnormal or too large. The denominator is not zero.
///
/// With both magnitudes scaled to n, d in [1, 2), the division yields q = floor(floor(n 2^126) / floor(d 2^63)), and
/// q - 2.01 < (n / d) 2^63 < q + 1.01: truncating d raises the quotient by at most 2^64 / 2^63, truncating n and the
/// quotient lower it by at most 1 and a bit. So q has 63 or 64 bits, and where the bits to be dropped are more than 3 units
/// away from the tie, the exact quotient lies on the same side of it.
template <class Real, class Integer>
std::optional<Real> rounded_quotient(const Integer& numerator, const Integer& denominator, int exponent) {
  using F = FloatFormat<Real>;
  if (numerator.sign() == 0) return Real{0};
  const Leading n = leading(numerator), d = leading(denominator);
  const auto q = static_cast<std::uint64_t>((static_cast<Word128>(n.high) << 63 | n.low >> 1) / d.high);
  const int width = static_cast<int>(std::bit_width(q));
  const int dropped = width - F::precision;
  const std::uint64_t half = std::uint64_t{1} << (dropped - 1), rest = q & (2 * half - 1);
  if (rest + 3 >= half && rest <= half + 3) return std::nullopt;
  const std::uint64_t significand = (q >> dropped) + (rest > half ? 1 : 0);  // may be 2^precision: carries below
  const int leading = n.exponent - d.exponent + exponent - 63 + width - 1;
  if (leading < F::min_exponent || leading >= F::max_exponent) return std::nullopt;
  const auto bits = (static_cast<std::uint64_t>(leading - F::min_exponent) << F::fraction_bits) + significand;
  const auto sign = numerator.sign() != denominator.sign() ? F::sign_bit : typename F::Bits{0};
  return from_bits<Real>(static_cast<typename F::Bits>(bits) | sign);
}

}  // namespace plumbline
