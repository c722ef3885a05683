#include "float_tracer/adapters/segment.h"

#include <cmath>
#include <limits>

#include "case/finite.h"
#include "case/precision.h"

namespace plumbline {
namespace {

Vec3 along(const Vec3& from, const Vec3& direction, double t, Precision precision) {
  if (is_zero(t)) return from;
  return at_precision(Vec3{from.x + t * direction.x, from.y + t * direction.y, from.z + t * direction.z}, precision);
}

}  // namespace

double largest_component(const Vec3& v) {
  return std::fmax(std::fabs(v.x), std::fmax(std::fabs(v.y), std::fabs(v.z)));
}

double largest_coordinate(const Bag& bag) {
  double r = 0;
  for (const Triangle& t : bag.triangles)
    for (const Vec3& v : {t.a, t.b, t.c}) r = std::fmax(r, largest_component(v));
  return r;
}

double reach(const Vec3& origin, const Vec3& direction, double largest) {
  const double furthest = std::fmax(largest_component(origin), largest), step = largest_component(direction);
  if (!(step > 0) || !is_finite(step) || !is_finite(furthest)) return std::numeric_limits<double>::infinity();
  if (is_zero(furthest)) return 1;
  // With furthest = f 2^e and step = s 2^g, f and s from [1, 2): 2^(e - g) is too small by f / s at most.
  const int exponent = std::ilogb(furthest) - std::ilogb(step) + 2;
  const bool enough = std::scalbn(step, -std::ilogb(step)) >= std::scalbn(furthest, -std::ilogb(furthest));
  return std::scalbn(1.0, enough ? exponent : exponent + 1);
}

std::optional<Segment> segment_of(const Ray& ray, double largest, Precision precision) {
  const auto& [origin, direction, t_min, t_max] = ray;
  if (!is_finite(origin) || !is_finite(direction) || is_zero(largest_component(direction))) return std::nullopt;
  if (!(t_min < t_max)) return std::nullopt;
  const auto at = [&](double t) { return along(origin, direction, t, precision); };
  const auto beyond = [&](const Vec3& end, double sign) {
    return along(end, direction, sign * reach(end, direction, largest), precision);
  };
  Segment r;
  if (is_finite(t_min)) {
    r.from = at(t_min);
    r.to = is_finite(t_max) ? at(t_max) : beyond(r.from, 1);
  } else {
    r.to = is_finite(t_max) ? at(t_max) : beyond(origin, 1);
    r.from = beyond(r.to, -1);
  }
  if (!is_finite(r.from) || !is_finite(r.to) || r.from == r.to) return std::nullopt;
  const auto query = query_through(r.from, r.to, 0, 1);
  if (!query) return std::nullopt;
  r.query = *query;
  return r;
}

}  // namespace plumbline
