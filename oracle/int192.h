// Signed integers of 192 bits, as much of them as determinants of 62-bit integers need: sums of products of a 64-bit with a
// 128-bit integer. Nothing overflows for results below 2^191. Private to the oracle.
#pragma once
#include <bit>
#include <cstdint>

namespace plumbline {

__extension__ using Int128 = __int128;
__extension__ using Word128 = unsigned __int128;

struct Int192 {
  std::uint64_t low = 0;
  Int128 high = 0;  ///< value = high * 2^64 + low

  int sign() const {  // without a branch: signs are what can't be predicted
    const int negative = high < 0, zero = (low | static_cast<std::uint64_t>(high) | static_cast<std::uint64_t>(high >> 64)) == 0;
    return 1 - zero - 2 * negative;
  }
};

inline Int192 operator+(const Int192& x, const Int192& y) {
  const std::uint64_t low = x.low + y.low;
  return {low, x.high + y.high + (low < x.low ? 1 : 0)};
}

inline Int192 operator-(const Int192& x) {
  return {-x.low, -x.high - (x.low != 0 ? 1 : 0)};
}

inline Int192 operator-(const Int192& x, const Int192& y) {
  return {x.low - y.low, x.high - y.high - (x.low < y.low ? 1 : 0)};
}

inline Int192 multiply(std::int64_t x, Int128 y) {
  const auto y_low = static_cast<std::uint64_t>(y);
  const auto y_high = static_cast<std::int64_t>(y >> 64);
  // x as unsigned is x + 2^64 where it is negative.
  const auto product = static_cast<Word128>(static_cast<std::uint64_t>(x)) * y_low;
  const auto wrapped = y_low & static_cast<std::uint64_t>(x >> 63);
  return {static_cast<std::uint64_t>(product),
          static_cast<Int128>(x) * y_high + static_cast<std::uint64_t>(product >> 64) - static_cast<Int128>(wrapped)};
}

/// The magnitude of a number other than zero, scaled to have its highest bit at the top: limb[0] is the most significant,
/// and the number is limb[0].limb[1]... * 2^exponent with a binary point behind the first bit.
struct Normalized {
  std::uint64_t limb[4] = {};
  int exponent = 0;

  explicit Normalized(const Int192& x) {
    const Int192 m = x.sign() < 0 ? -x : x;
    limb[0] = static_cast<std::uint64_t>(m.high >> 64);
    limb[1] = static_cast<std::uint64_t>(m.high);
    limb[2] = m.low;
    exponent = 191;
    normalize();
  }

  Normalized& operator*=(std::uint64_t factor) {  // factor != 0; the lowest limb is zero before
    std::uint64_t carry = 0;
    for (int k = 2; k >= 0; --k) {
      const auto t = static_cast<Word128>(limb[k]) * factor + carry;
      limb[k + 1] = static_cast<std::uint64_t>(t);
      carry = static_cast<std::uint64_t>(t >> 64);
    }
    limb[0] = carry;
    exponent += 64;
    normalize();
    return *this;
  }

  /// -1, 0, 1
  int compare(const Normalized& y) const {
    if (exponent != y.exponent) return exponent < y.exponent ? -1 : 1;
    for (int k = 0; k < 4; ++k)
      if (limb[k] != y.limb[k]) return limb[k] < y.limb[k] ? -1 : 1;
    return 0;
  }

 private:
  void normalize() {
    while (limb[0] == 0) {
      for (int k = 0; k < 3; ++k) limb[k] = limb[k + 1];
      limb[3] = 0;
      exponent -= 64;
    }
    const int shift = std::countl_zero(limb[0]);
    if (shift != 0) {
      for (int k = 0; k < 3; ++k) limb[k] = limb[k] << shift | limb[k + 1] >> (64 - shift);
      limb[3] <<= shift;
    }
    exponent -= shift;
  }
};

/// The first bits of the magnitude of a number other than zero, the rest cut off: high.low * 2^exponent with a binary
/// point behind the highest bit of `high`, which is set.
struct Leading {
  std::uint64_t high, low;
  int exponent;
};

inline Leading leading(const Int192& x) {
  const Normalized m(x);
  return {m.limb[0], m.limb[1], m.exponent};
}

}  // namespace plumbline
