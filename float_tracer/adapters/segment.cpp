#include "float_tracer/adapters/segment.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "case/finite.h"
#include "case/precision.h"

namespace plumbline {
namespace {

double largest(const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

Vec3 along(const Vec3& from, const Vec3& direction, double t, Precision precision) {
  if (is_zero(t)) return from;
  return at_precision(Vec3{from.x + t * direction.x, from.y + t * direction.y, from.z + t * direction.z}, precision);
}

}  // namespace

double largest_coordinate(const Bag& bag) {
  double r = 0;
  for (const Triangle& t : bag.triangles) r = std::max({r, largest(t.a), largest(t.b), largest(t.c)});
  return r;
}

double reach(const Vec3& origin, const Vec3& direction, double largest_of_bag) {
  const double furthest = std::max(largest(origin), largest_of_bag), step = largest(direction);
  if (!(step > 0) || !is_finite(step) || !is_finite(furthest)) return std::numeric_limits<double>::infinity();
  if (is_zero(furthest)) return 1;
  // With furthest = f 2^e and step = s 2^g, f and s from [1, 2): 2^(e - g) is too small by f / s at most.
  const int exponent = std::ilogb(furthest) - std::ilogb(step) + 2;
  const bool enough = std::scalbn(step, -std::ilogb(step)) >= std::scalbn(furthest, -std::ilogb(furthest));
  return std::scalbn(1.0, enough ? exponent : exponent + 1);
}

std::optional<Segment> segment_of(const Ray& ray, double largest_of_bag, Precision precision) {
  if (!(ray.t_min < ray.t_max)) return std::nullopt;
  const auto end = [&](const Vec3& from, double sign) {
    return along(from, ray.direction, sign * reach(from, ray.direction, largest_of_bag), precision);
  };
  Segment r;
  if (is_finite(ray.t_min)) {
    r.from = along(ray.origin, ray.direction, ray.t_min, precision);
    r.to = is_finite(ray.t_max) ? along(ray.origin, ray.direction, ray.t_max, precision) : end(r.from, 1);
  } else {
    r.to = is_finite(ray.t_max) ? along(ray.origin, ray.direction, ray.t_max, precision) : end(ray.origin, 1);
    r.from = end(r.to, -1);
  }
  if (!is_finite(r.from) || !is_finite(r.to)) return std::nullopt;
  return r;
}

Query asked_by(const std::optional<Segment>& segment, const Ray& ray) {
  if (!segment) return ray;
  return query_through(segment->from, segment->to, 0, 1).value_or(ray);
}

}  // namespace plumbline
