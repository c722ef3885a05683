// Signed integers of a few 64-bit words in two's complement, on the stack: what determinants of 125-bit
// integers need. A product has the words of both factors, so it never overflows; sums have the words of their
// terms, and wrap around: whoever adds knows that the result fits. Private to the oracle.
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "case/float_bits.h"
#include "oracle/int192.h"

namespace plumbline {

template <int words>
struct WideInt {
  std::uint64_t word[words] = {};  ///< the least significant first

  WideInt() = default;
  explicit WideInt(Int128 x) requires(words == 2)
      : word{static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(x >> 64)} {}

  bool is_negative() const { return static_cast<std::int64_t>(word[words - 1]) < 0; }
  int sign() const {  // without a branch: signs are what can't be predicted
    std::uint64_t any = 0;
    for (const std::uint64_t w : word) any |= w;
    return (any != 0 ? 1 : 0) - 2 * (is_negative() ? 1 : 0);
  }
};

template <int words>
WideInt<words> operator+(const WideInt<words>& x, const WideInt<words>& y) {
  WideInt<words> r;
  Word128 carry = 0;
  for (int k = 0; k < words; ++k) {
    carry += static_cast<Word128>(x.word[k]) + y.word[k];
    r.word[k] = static_cast<std::uint64_t>(carry);
    carry >>= 64;
  }
  return r;
}

template <int words>
WideInt<words> operator-(const WideInt<words>& x, const WideInt<words>& y) {
  WideInt<words> r;
  std::uint64_t borrow = 0;
  for (int k = 0; k < words; ++k) {
    const Word128 difference = static_cast<Word128>(x.word[k]) - y.word[k] - borrow;
    r.word[k] = static_cast<std::uint64_t>(difference);
    borrow = static_cast<std::uint64_t>(difference >> 64) & 1;
  }
  return r;
}

template <int words>
WideInt<words> operator-(const WideInt<words>& x) {
  return WideInt<words>{} - x;
}

/// sum += x * y
template <int m, int n>
[[gnu::always_inline]] inline void add_product(WideInt<m + n>& sum, const WideInt<m>& x, const WideInt<n>& y) {
  for (int i = 0; i < m; ++i) {
    Word128 carry = 0;
    for (int j = 0; j < n; ++j) {
      carry += static_cast<Word128>(x.word[i]) * y.word[j] + sum.word[i + j];
      sum.word[i + j] = static_cast<std::uint64_t>(carry);
      carry >>= 64;
    }
    for (int k = i + n; k < m + n; ++k) {
      carry += sum.word[k];
      sum.word[k] = static_cast<std::uint64_t>(carry);
      carry >>= 64;
    }
  }
  // Read without a sign, a negative x is x + 2^(64 m): y comes off where it was counted above. Alike y.
  const std::uint64_t x_negative = x.is_negative() ? ~std::uint64_t{0} : 0;
  const std::uint64_t y_negative = y.is_negative() ? ~std::uint64_t{0} : 0;
  const auto subtract = [&sum](int from, const auto& words, int count, std::uint64_t mask) {
    std::uint64_t borrow = 0;
    for (int k = 0; k < count; ++k) {
      const Word128 difference = static_cast<Word128>(sum.word[from + k]) - (words[k] & mask) - borrow;
      sum.word[from + k] = static_cast<std::uint64_t>(difference);
      borrow = static_cast<std::uint64_t>(difference >> 64) & 1;
    }
  };
  subtract(m, y.word, n, x_negative);
  subtract(n, x.word, m, y_negative);
}

template <int m, int n>
WideInt<m + n> operator*(const WideInt<m>& x, const WideInt<n>& y) {
  WideInt<m + n> r;
  add_product(r, x, y);
  return r;
}

/// The first bits of the magnitude of a number other than zero, the rest cut off: high.low * 2^exponent with a binary
/// point behind the highest bit of `high`, which is set.
struct Leading {
  std::uint64_t high, low;
  int exponent;
};

template <int words>
Leading leading(const WideInt<words>& x) {
  const WideInt<words> m = x.is_negative() ? -x : x;
  int top = words - 1;
  while (m.word[top] == 0) --top;
  const auto at = [&](int k) { return k >= 0 ? m.word[k] : 0; };
  const std::uint64_t a = at(top), b = at(top - 1), c = at(top - 2);
  const int up = std::countl_zero(a);
  const auto joined = [up](std::uint64_t high, std::uint64_t low) {
    return high << up | low >> 1 >> (63 - up);
  };
  return {joined(a, b), joined(b, c), 64 * top + 63 - up};
}

/// x, its 53 first bits alone: towards zero, in any rounding mode. |x| < 2^1023.
template <int words>
double truncated(const WideInt<words>& x) {
  if (x.sign() == 0) return 0;
  const Leading l = leading(x);
  using F = FloatFormat<double>;
  const std::uint64_t fraction = l.high >> 11 & F::fraction_mask;
  const auto biased = static_cast<std::uint64_t>(l.exponent + F::max_exponent);
  return from_bits<double>((x.is_negative() ? F::sign_bit : 0) | biased << F::fraction_bits | fraction);
}

// Vectors of them.
template <int words>
using WideVec = std::array<WideInt<words>, 3>;

template <int words>
WideVec<words> operator-(const WideVec<words>& p, const WideVec<words>& q) {
  return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}

template <int words>
WideVec<words> operator+(const WideVec<words>& p, const WideVec<words>& q) {
  return {p[0] + q[0], p[1] + q[1], p[2] + q[2]};
}

template <int m, int n>
WideInt<m + n> dot(const WideVec<m>& p, const WideVec<n>& q) {
  WideInt<m + n> sum;
  add_product(sum, p[0], q[0]);
  add_product(sum, p[1], q[1]);
  add_product(sum, p[2], q[2]);
  return sum;
}

template <int m, int n>
WideVec<m + n> cross(const WideVec<m>& p, const WideVec<n>& q) {
  return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}

template <int words>
bool is_zero(const WideVec<words>& v) {
  return v[0].sign() == 0 && v[1].sign() == 0 && v[2].sign() == 0;
}

}  // namespace plumbline
