// A ray as the segment that libraries ask for which take two points.
//
// It runs from origin + t_min * direction to origin + t_max * direction, each operation rounded to Real. Where a
// bound is infinite, the power of two K stands for it, the least with K * (largest component of the direction) >= 4 *
// (largest magnitude of a coordinate of the bag or the origin): so far out the ray has left the bag behind for sure.
// K is a power of two so that only the addition rounds. The query is the line through the two points exactly, t from
// 0 to 1.
#pragma once
#include <cmath>
#include <optional>

#include "case/float_bits.h"
#include "case/query.h"
#include "float_tracer/adapters/prepared_triangles.h"

namespace plumbline {

struct SegmentProbe {
  Vec3 from, to;  ///< numbers of Real
  Query query;
};

/// The exponent of K. No component is NaN, and the direction is not zero.
inline int exponent_beyond(const Ray& ray, double largest) {
  int near = 0, far = 0;
  const double step = std::frexp(largest_of(ray.direction), &near);
  const double reach = std::frexp(std::fmax(largest, largest_of(ray.origin)), &far);
  if (is_zero(reach)) return 0;
  return far - near + 2 + (reach > step ? 1 : 0);
}

/// No value where the ray has no two points: a coordinate or bound that is NaN, an infinite coordinate, a direction
/// of zero, bounds that leave no length between them, a point that overflows. `largest` is that of the bag, and
/// finite.
template <class Real>
std::optional<SegmentProbe> segment_probe(const Ray& ray, double largest) {
  if (!is_finite(ray.origin) || !is_finite(ray.direction) || is_zero(largest_of(ray.direction))) return std::nullopt;
  if (!(ray.t_min < ray.t_max)) return std::nullopt;
  const int beyond = exponent_beyond(ray, largest);
  const auto coordinate = [&](double origin, double direction, double t) -> double {
    const Real o = static_cast<Real>(origin);
    if (is_zero(t)) return o;
    if (is_finite(t)) return o + static_cast<Real>(t) * static_cast<Real>(direction);
    const Real away = static_cast<Real>(std::ldexp(direction, beyond));
    return t > 0 ? o + away : o - away;
  };
  const auto point = [&](double t) {
    return Vec3{coordinate(ray.origin.x, ray.direction.x, t), coordinate(ray.origin.y, ray.direction.y, t),
                coordinate(ray.origin.z, ray.direction.z, t)};
  };
  SegmentProbe probe{.from = point(ray.t_min), .to = point(ray.t_max), .query = {}};
  if (!is_finite(probe.from) || !is_finite(probe.to) || probe.from == probe.to) return std::nullopt;
  const auto query = query_through(probe.from, probe.to, 0, 1);
  if (!query) return std::nullopt;
  probe.query = *query;
  return probe;
}

}  // namespace plumbline
