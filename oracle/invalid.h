// Which cases have no geometry. Private to the oracle.
#pragma once
#include "case/float_bits.h"
#include "case/geometry.h"
#include "oracle/truth.h"

namespace plumbline {

/// Looks at bits only. A NaN bound of the t range counts, an infinite one does not.
inline Invalid why_invalid(const Triangle& triangle, const Ray& ray) {
  const auto finite = [](const Vec3& v) { return is_finite(v.x) && is_finite(v.y) && is_finite(v.z); };
  const Vec3& d = ray.direction;
  if (!finite(triangle.a) || !finite(triangle.b) || !finite(triangle.c)) return Invalid::triangle_not_finite;
  if (!finite(ray.origin)) return Invalid::origin_not_finite;
  if (!finite(d)) return Invalid::direction_not_finite;
  if (is_zero(d.x) && is_zero(d.y) && is_zero(d.z)) return Invalid::zero_direction;
  if (is_nan(ray.t_min) || is_nan(ray.t_max)) return Invalid::range_nan;
  return Invalid::none;
}

}  // namespace plumbline
