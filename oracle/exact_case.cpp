#include "oracle/exact_case.h"

#include <algorithm>
#include <array>

#include "case/float_bits.h"

namespace plumbline::exact {
namespace {

const Quotient& lesser(const Quotient& x, const Quotient& y) { return y < x ? y : x; }
const Quotient& greater(const Quotient& x, const Quotient& y) { return x < y ? y : x; }

std::optional<Interval> intersection(const Interval& x, const Interval& y) {
  Interval r = x;
  if (y.low) r.low = r.low ? greater(*r.low, *y.low) : *y.low;
  if (y.high) r.high = r.high ? lesser(*r.high, *y.high) : *y.high;
  if (r.low && r.high && *r.high < *r.low) return std::nullopt;
  return r;
}

// A line in the triangle's plane: it is inside where it is on the inner side of each of the three edges.
std::optional<Interval> coplanar_contact(const ExactCase& x) {
  std::optional<Interval> inside = Interval{};
  const std::array<const Vec*, 4> corner = {&x.a, &x.b, &x.c, &x.a};
  for (int k = 0; k < 3 && inside; ++k) {
    const Vec& p = *corner[k];
    const Vec edge = *corner[k + 1] - p;
    // N . (edge x (O + tD - P)) = height + t * slope >= 0
    const Dyadic height = dot(x.normal, cross(edge, x.origin - p));
    const Dyadic slope = dot(x.normal, cross(edge, x.direction));
    if (slope.sign() > 0)
      inside = intersection(*inside, {.low = Quotient(-height, slope), .high = {}});
    else if (slope.sign() < 0)
      inside = intersection(*inside, {.low = {}, .high = Quotient(-height, slope)});
    else if (height.sign() < 0)
      inside.reset();
  }
  return inside;
}

// The triangle is the segment between the two of its collinear vertices that are farthest apart.
std::optional<Interval> degenerate_contact(const ExactCase& x) {
  const std::array<std::pair<const Vec*, const Vec*>, 3> pairs = {{{&x.a, &x.b}, {&x.b, &x.c}, {&x.c, &x.a}}};
  const auto [p, q] = *std::max_element(pairs.begin(), pairs.end(), [](const auto& l, const auto& r) {
    return square(*l.second - *l.first) < square(*r.second - *r.first);
  });
  const Vec to_p = *p - x.origin, segment = *q - *p, normal = cross(x.direction, segment);
  const Dyadic length2 = square(x.direction);
  const auto at = [&](const Vec& from_origin) { return Quotient(dot(from_origin, x.direction), length2); };
  if (is_zero(normal)) {  // a point, or a segment along the line
    if (!is_zero(cross(to_p, x.direction))) return std::nullopt;
    const Quotient tp = at(to_p), tq = at(*q - x.origin);
    return Interval{.low = lesser(tp, tq), .high = greater(tp, tq)};
  }
  if (dot(to_p, normal).sign() != 0) return std::nullopt;  // skew lines
  const Dyadic normal2 = square(normal);
  const Dyadic s = dot(cross(to_p, x.direction), normal);  // position along the segment, times normal2
  if (s.sign() < 0 || s > normal2) return std::nullopt;
  const Quotient t(dot(cross(to_p, segment), normal), normal2);
  return Interval{.low = t, .high = t};
}

}  // namespace

ExactCase::ExactCase(const Triangle& triangle, const Query& query)
    : origin(to_exact(query.ray.origin)),
      direction(to_exact(query.ray.direction) + to_exact(query.direction_tail)),
      a(to_exact(triangle.a)),
      b(to_exact(triangle.b)),
      c(to_exact(triangle.c)),
      e1(b - a),
      e2(c - a),
      normal(cross(e1, e2)) {
  const Vec to_a = a - origin, h = cross(direction, to_a);
  det = dot(direction, normal);
  T = dot(to_a, normal);
  w_ab = dot(e1, h);
  w_ca = -dot(e2, h);
  w_bc = det - w_ca - w_ab;
}

std::optional<Interval> range(const Ray& ray) {
  Interval r;
  if (is_finite(ray.t_min))
    r.low = Quotient(Dyadic(ray.t_min));
  else if (!is_negative(ray.t_min))
    return std::nullopt;
  if (is_finite(ray.t_max))
    r.high = Quotient(Dyadic(ray.t_max));
  else if (is_negative(ray.t_max))
    return std::nullopt;
  if (r.low && r.high && *r.high < *r.low) return std::nullopt;
  return r;
}

bool contains(const Interval& interval, const Quotient& t) {
  return !(interval.low && t < *interval.low) && !(interval.high && t > *interval.high);
}

std::optional<Interval> contact(const ExactCase& x) {
  if (is_zero(x.normal)) return degenerate_contact(x);
  if (x.T.sign() != 0) return std::nullopt;  // parallel
  return coplanar_contact(x);
}

std::optional<Interval> contact_in_range(const ExactCase& x, const Ray& ray) {
  const auto touched = contact(x), searched = range(ray);
  if (!touched || !searched) return std::nullopt;
  return intersection(*touched, *searched);
}

}  // namespace plumbline::exact
