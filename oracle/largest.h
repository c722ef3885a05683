// The largest and the least of some coordinates in magnitude, and the unit in the last place there. Looks at
// bits only: those of non-negative doubles are ordered as their values, infinity and NaN last. Private to the
// oracle.
#pragma once
#include <algorithm>

#include "case/case.h"
#include "case/float_bits.h"
#include "case/geometry.h"

namespace plumbline {

template <class... Vecs>
double largest_magnitude(const Vecs&... vecs) {
  std::uint64_t largest = 0;
  for (const Vec3* v : {&vecs...})
    for (const double k : {v->x, v->y, v->z})
      largest = std::max(largest, to_bits(k) & ~FloatFormat<double>::sign_bit);
  return from_bits<double>(largest);
}

/// Of those that are not zero; where all are, some NaN.
template <class... Vecs>
double least_magnitude(const Vecs&... vecs) {
  std::uint64_t below = ~FloatFormat<double>::sign_bit - 1;
  for (const Vec3* v : {&vecs...})
    for (const double k : {v->x, v->y, v->z})  // of zero, 1 less is more than anything
      below = std::min(below, (to_bits(k) & ~FloatFormat<double>::sign_bit) - 1);
  return from_bits<double>(below + 1);
}

inline double largest_coordinate(const Triangle& triangle, const Ray& ray) {
  return largest_magnitude(triangle.a, triangle.b, triangle.c, ray.origin);
}

/// That of x itself: one that is not binary32 is not rounded first.
inline int ulp_exponent_at(double x, Precision precision) {
  if (precision == Precision::binary64) return ulp_exponent(x);
  using F = FloatFormat<float>;
  const int leading =
      ulp_exponent(x) + FloatFormat<double>::fraction_bits;  // too small for subnormals, as for binary32
  return std::max(leading, F::min_exponent) - F::fraction_bits;
}

}  // namespace plumbline
