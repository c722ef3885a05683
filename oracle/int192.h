// Signed integers of 192 bits, as much of them as determinants of 62-bit integers need: sums of products of a 64-bit with a
// 128-bit integer. Nothing overflows for results below 2^191. Private to the oracle.
#pragma once
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

}  // namespace plumbline
