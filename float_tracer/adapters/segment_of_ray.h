// The segment that stands for a ray where a library takes two end points: rounded as its users would round it, and so
// with a query of its own.
//
// Its ends are origin + t_min * direction and origin + t_max * direction, each product and each sum rounded to
// binary64. An infinite bound is replaced by +-2^k with the integer k so that 2^k * (largest |component| of the
// direction) lies between 4 and 16 times the largest |coordinate| of origin and bag: within the bag no point of the
// ray is further from the origin than twice that, so the segment surely passes the bag, rounded or not.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "case/case.h"
#include "case/finite.h"
#include "case/query.h"

namespace plumbline {

inline double largest_component(const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

/// The largest |coordinate| of a bag; no value if one is not finite.
inline std::optional<double> reach(const Bag& bag) {
  double largest = 0;
  for (const Triangle& t : bag.triangles)
    for (const Vec3& v : {t.a, t.b, t.c}) {
      if (!is_finite(v)) return std::nullopt;
      largest = std::max(largest, largest_component(v));
    }
  return largest;
}

/// No t is in it: a miss whatever is met, and no segment has such a range.
inline bool has_empty_range(const Ray& ray) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  return ray.t_min > ray.t_max || ray.t_min == infinite || ray.t_max == -infinite;
}

struct SegmentOfRay {
  Vec3 from, to;
  Query query;  ///< the line through the ends: t is 0 at `from`, 1 at `to`
};

/// `bag_reach` is reach of the bag. No value where no segment stands for the ray: a coordinate that is not finite, no
/// direction, a bound that is NaN, ends that coincide, an end or a difference of the ends that overflows.
inline std::optional<SegmentOfRay> segment_of(const Ray& ray, double bag_reach) {
  const double step = largest_component(ray.direction);
  if (!is_finite(ray.origin) || !is_finite(ray.direction) || is_zero(step)) return std::nullopt;
  if (is_nan(ray.t_min) || is_nan(ray.t_max)) return std::nullopt;
  const double extent = std::max(bag_reach, largest_component(ray.origin));
  const int passes = is_zero(extent) ? 0 : std::ilogb(extent) - std::ilogb(step) + 3;
  const auto at = [&](double t) -> Vec3 {
    const auto along = [&](double origin, double direction) {
      return origin + (is_finite(t) ? t * direction : std::copysign(1, t) * std::ldexp(direction, passes));
    };
    return {along(ray.origin.x, ray.direction.x), along(ray.origin.y, ray.direction.y),
            along(ray.origin.z, ray.direction.z)};
  };
  const Vec3 from = is_zero(ray.t_min) ? ray.origin : at(ray.t_min), to = at(ray.t_max);
  if (!is_finite(from) || !is_finite(to) || from == to) return std::nullopt;
  const auto query = query_through(from, to, 0, 1);
  return query ? std::optional<SegmentOfRay>({from, to, *query}) : std::nullopt;
}

}  // namespace plumbline
