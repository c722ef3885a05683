#include "oracle/severity.h"

#include <algorithm>
#include <array>

#include "case/float_bits.h"
#include "oracle/exact_case.h"
#include "oracle/invalid.h"
#include "oracle/round.h"

namespace plumbline {
namespace {

using namespace exact;

const Dyadic one(1, 0);

// The least of some squared distances.
class Least {
 public:
  void offer(const Dyadic& numerator, const Dyadic& denominator) {
    const Quotient q(numerator, denominator);
    if (!least_ || q < *least_) least_ = q;
  }
  const std::optional<Quotient>& get() const { return least_; }

 private:
  std::optional<Quotient> least_;
};

std::array<std::array<const Vec*, 2>, 3> edges(const ExactCase& x) {
  return {{{&x.a, &x.b}, {&x.b, &x.c}, {&x.c, &x.a}}};
}

// Truth hit: how far to the nearest exit, over an edge line or past an end of the range.
Quotient squared_depth(const ExactCase& x, const Interval& range) {
  Least least;
  const Vec& d = x.direction;
  least.offer(square(x.w_ab), square(cross(x.e1, d)));
  least.offer(square(x.w_bc), square(cross(x.c - x.b, d)));
  least.offer(square(x.w_ca), square(cross(x.e2, d)));
  for (const auto& end : {range.low, range.high})
    if (end) least.offer(square(x.T - end->numerator * x.det), square(x.normal));
  return *least.get();
}

void offer_point_to_triangle(Least& least, const ExactCase& x, const Vec& point) {
  bool over_interior = true;
  for (const auto& [p, q] : edges(x)) {
    const Vec edge = *q - *p, from_p = point - *p;
    least.offer(square(from_p), one);  // to the vertex P
    const Dyadic along = dot(from_p, edge), length2 = square(edge);
    if (along.sign() >= 0 && along <= length2) least.offer(square(cross(from_p, edge)), length2);
    over_interior = over_interior && dot(x.normal, cross(edge, from_p)).sign() >= 0;
  }
  if (over_interior) least.offer(square(dot(point - x.a, x.normal)), square(x.normal));
}

// Truth miss: the distance between the ray and the closed triangle, which do not meet. It is attained between two
// features that do not cross: an end of the ray and the triangle, the ray and a vertex, or the ray and an edge. Every
// candidate offered is the distance of a pair of points that are really there, so the least is exact.
Quotient squared_distance(const ExactCase& x, const Interval& range) {
  Least least;
  const Vec& d = x.direction;
  const Dyadic d2 = square(d);
  for (const auto& end : {range.low, range.high})
    if (end) offer_point_to_triangle(least, x, x.origin + end->numerator * d);
  for (const auto& [p, q] : edges(x)) {
    const Vec to_p = *p - x.origin, edge = *q - *p;
    if (contains(range, Quotient(dot(to_p, d), d2))) least.offer(square(cross(to_p, d)), d2);
    const Vec normal = cross(d, edge);
    if (is_zero(normal)) continue;  // parallel lines: attained at a vertex or an end as well
    const Dyadic normal2 = square(normal), along = dot(cross(to_p, d), normal);
    if (along.sign() < 0 || along > normal2) continue;
    if (contains(range, Quotient(dot(cross(to_p, edge), normal), normal2)))
      least.offer(square(dot(to_p, normal)), normal2);
  }
  return *least.get();
}

bool meets(const ExactCase& x, const Ray& ray, const Interval& searched) {
  const int det = x.det.sign();
  if (det == 0) return contact_in_range(x, ray).has_value();
  const bool in_triangle = x.w_ab.sign() * det >= 0 && x.w_bc.sign() * det >= 0 && x.w_ca.sign() * det >= 0;
  return in_triangle && contains(searched, x.t());
}

// S^2 of a wrong answer, or nothing where the answer is not wrong or no severity is defined.
std::optional<Quotient> squared_severity(const ExactCase& x, const Ray& ray, bool answered_hit) {
  const auto searched = range(ray);
  if (is_zero(x.normal) || !searched) return std::nullopt;
  const bool truth = meets(x, ray, *searched);
  if (truth == answered_hit || (truth && x.det.sign() == 0)) return std::nullopt;
  return truth ? squared_depth(x, *searched) : squared_distance(x, *searched);
}

Dyadic squared_longest_edge(const ExactCase& x) {
  return std::max({square(x.e1), square(x.e2), square(x.c - x.b)});
}

double largest_coordinate(const Triangle& triangle, const Ray& ray) {
  std::uint64_t largest = 0;  // the bits of non-negative doubles are ordered as their values
  for (const Vec3& p : {triangle.a, triangle.b, triangle.c, ray.origin})
    for (const double k : {p.x, p.y, p.z}) largest = std::max(largest, to_bits(k) & ~FloatFormat<double>::sign_bit);
  return from_bits<double>(largest);
}

Condition condition(const ExactCase& x, double largest) {
  const Dyadic normal2 = square(x.normal), longest2 = squared_longest_edge(x);
  const Dyadic limit2(1, -20);  // (2^-10)^2
  return {.grazing = square(x.det) < limit2 * square(x.direction) * normal2,
          .sliver = normal2 < limit2 * square(longest2),
          .far = longest2 < limit2 * square(Dyadic(largest))};
}

// From the bits of the double, so that a value that is not binary32 is not rounded first.
long ulp_exponent_at(double x, Precision precision) {
  if (precision == Precision::binary64) return ulp_exponent(x);
  using F = FloatFormat<float>;
  const int leading = ulp_exponent(x) + FloatFormat<double>::fraction_bits;  // too small for subnormals, as for binary32
  return std::max(leading, F::min_exponent) - F::fraction_bits;
}

}  // namespace

std::optional<Severity> severity(const Triangle& triangle, const Query& query, bool answered_hit, Precision precision) {
  if (why_invalid(triangle, query.ray) != Invalid::none) return std::nullopt;
  const ExactCase x(triangle, query);
  const auto s2 = squared_severity(x, query.ray, answered_hit);
  if (!s2) return std::nullopt;
  const double largest = largest_coordinate(triangle, query.ray);
  const Dyadic ulp2(1, 2 * ulp_exponent_at(largest, precision));
  return Severity{.length = rounded_sqrt<double>(*s2),
                  .ulps = rounded_sqrt<double>(Quotient(s2->numerator, s2->denominator * ulp2)),
                  .condition = condition(x, largest)};
}

bool within_slack(const Triangle& triangle, const Query& query, double slack_absolute, double slack_relative) {
  if (why_invalid(triangle, query.ray) != Invalid::none) return false;
  const ExactCase x(triangle, query);
  const auto searched = range(query.ray);
  if (is_zero(x.normal) || !searched) return false;
  if (meets(x, query.ray, *searched)) return true;
  const Quotient s2 = squared_distance(x, *searched);
  // With L the longest edge: S <= abs + rel L  <=>  excess := S^2 - abs^2 - rel^2 L^2 <= 2 abs rel L; all of it is
  // multiplied by the denominator of S^2, and squared where excess > 0.
  const Dyadic absolute2 = square(Dyadic(slack_absolute)), relative2 = square(Dyadic(slack_relative));
  const Dyadic longest2 = squared_longest_edge(x), &q = s2.denominator;
  const Dyadic excess = s2.numerator - q * (absolute2 + relative2 * longest2);
  if (excess.sign() <= 0) return true;
  return square(excess) <= Dyadic(4, 0) * square(q) * absolute2 * relative2 * longest2;
}

}  // namespace plumbline
