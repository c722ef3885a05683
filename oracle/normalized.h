// Magnitudes of integers of several words, scaled so that they can be compared. Private to the oracle.
#pragma once
#include <bit>
#include <cstdint>

#include "oracle/int192.h"
#include "oracle/wide_int.h"

namespace plumbline {

/// The magnitude of a number other than zero, scaled to have its highest bit at the top: limb[0] is the most
/// significant, and the number is limb[0].limb[1]... * 2^exponent with a binary point behind the first bit. The last
/// limb has room for one factor.
template <int limbs>
struct Normalized {
  std::uint64_t limb[limbs] = {};
  int exponent = 64 * (limbs - 1) - 1;

  explicit Normalized(const Int192& x)
    requires(limbs == 4)
  {
    const Int192 m = x.sign() < 0 ? -x : x;
    limb[0] = static_cast<std::uint64_t>(m.high >> 64);
    limb[1] = static_cast<std::uint64_t>(m.high);
    limb[2] = m.low;
    normalize();
  }
  explicit Normalized(const WideInt<limbs - 1>& x) {
    const WideInt<limbs - 1> m = x.is_negative() ? -x : x;
    for (int k = 0; k < limbs - 1; ++k) limb[k] = m.word[limbs - 2 - k];
    normalize();
  }

  Normalized& operator*=(std::uint64_t factor) {  // factor != 0; the lowest limb is zero before
    std::uint64_t carry = 0;
    for (int k = limbs - 2; k >= 0; --k) {
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
    for (int k = 0; k < limbs; ++k)
      if (limb[k] != y.limb[k]) return limb[k] < y.limb[k] ? -1 : 1;
    return 0;
  }

 private:
  void normalize() {
    while (limb[0] == 0) {
      for (int k = 0; k < limbs - 1; ++k) limb[k] = limb[k + 1];
      limb[limbs - 1] = 0;
      exponent -= 64;
    }
    const int shift = std::countl_zero(limb[0]);
    if (shift != 0) {
      for (int k = 0; k < limbs - 1; ++k) limb[k] = limb[k] << shift | limb[k + 1] >> (64 - shift);
      limb[limbs - 1] <<= shift;
    }
    exponent -= shift;
  }
};

/// Deduced from what is normalized.
Normalized(const Int192&) -> Normalized<4>;
template <int words>
Normalized(const WideInt<words>&) -> Normalized<words + 1>;

inline Leading leading(const Int192& x) {
  const Normalized<4> m(x);
  return {m.limb[0], m.limb[1], m.exponent};
}

}  // namespace plumbline
