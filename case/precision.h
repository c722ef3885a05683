// Rounds a case to the precision that a tracer reads. What comes out is what was really asked, so the truth is asked
// for that. And the steps between its numbers.
#pragma once
#include <cstdint>

#include "case/case.h"
#include "case/float_bits.h"

namespace plumbline {

/// Each coordinate and bound to nearest, ties to even; binary64 changes nothing. A value beyond binary32's range
/// becomes infinite.
double at_precision(double x, Precision precision);
Vec3 at_precision(const Vec3& v, Precision precision);
Triangle at_precision(const Triangle& triangle, Precision precision);
Ray at_precision(const Ray& ray, Precision precision);
Bag at_precision(Bag bag, Precision precision);

/// Bits of a significand, the first one with them.
constexpr int digits(Precision precision) { return precision == Precision::binary32 ? 24 : 53; }

/// The number of that precision n units in the last place above x, which is one.
constexpr double step_ulps(double x, std::int64_t n, Precision precision) {
  return precision == Precision::binary32 ? double{step_ulps(static_cast<float>(x), static_cast<std::int32_t>(n))}
                                          : step_ulps(x, n);
}

}  // namespace plumbline
