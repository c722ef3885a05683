// A finite double as the integers it is made of. Reads bits only: rounding mode, FTZ and DAZ have no say. Private to the
// oracle.
#pragma once
#include <bit>
#include <cstdint>

#include "case/float_bits.h"

namespace plumbline {

/// +-significand * 2^exponent; the significand is below 2^53, and 0 for zero.
struct Decoded {
  std::uint64_t significand = 0;
  int exponent = 0;
  bool negative = false;

  constexpr Decoded() = default;
  constexpr explicit Decoded(double x)
      : significand(fraction(x)), exponent(ulp_exponent(x)), negative(is_negative(x)) {
    if ((to_bits(x) & FloatFormat<double>::exponent_mask) != 0) significand += FloatFormat<double>::fraction_mask + 1;
  }
  /// The exponent of the lowest set bit; significand != 0.
  constexpr int low() const { return exponent + std::countr_zero(significand); }
  /// One past the exponent of the highest set bit; significand != 0.
  constexpr int high() const { return exponent + static_cast<int>(std::bit_width(significand)); }

 private:
  static constexpr std::uint64_t fraction(double x) { return to_bits(x) & FloatFormat<double>::fraction_mask; }
};

}  // namespace plumbline
