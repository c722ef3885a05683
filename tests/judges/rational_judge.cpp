#include "tests/judges/rational_judge.h"

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "case/float_bits.h"

namespace plumbline::judges {
namespace {

using Vec = std::array<Rational, 3>;

Vec exact(const Vec3& v) { return {Rational(v.x), Rational(v.y), Rational(v.z)}; }
Vec sub(const Vec& x, const Vec& y) { return {x[0] - y[0], x[1] - y[1], x[2] - y[2]}; }
Vec at(const Vec& o, const Vec& d, const Rational& t) { return {o[0] + t * d[0], o[1] + t * d[1], o[2] + t * d[2]}; }
Rational dot(const Vec& x, const Vec& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }
Vec cross(const Vec& x, const Vec& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}
bool zero(const Vec& x) { return x[0] == 0 && x[1] == 0 && x[2] == 0; }
int sign(const Rational& x) { return x.sign(); }

bool finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

bool within(const Ray& ray, const Rational& t) {
  if (ray.t_min == INFINITY || ray.t_max == -INFINITY) return false;
  return !(std::isfinite(ray.t_min) && t < Rational(ray.t_min)) && !(std::isfinite(ray.t_max) && t > Rational(ray.t_max));
}

bool on_segment(const Vec& p, const Vec& q, const Vec& x) {
  return zero(cross(sub(q, p), sub(x, p))) && sign(dot(sub(x, p), sub(x, q))) <= 0;
}

// Closed triangle, with area or without; x lies in its plane where it has one.
bool in_triangle(const std::array<Vec, 3>& p, const Vec& n, const Vec& x) {
  if (zero(n)) return on_segment(p[0], p[1], x) || on_segment(p[1], p[2], x) || on_segment(p[2], p[0], x);
  for (int k = 0; k < 3; ++k)
    if (sign(dot(n, cross(sub(p[(k + 1) % 3], p[k]), sub(x, p[k])))) < 0) return false;
  return dot(n, sub(x, p[0])) == 0;
}

// Contact begins and ends where the line passes a vertex, crosses an edge line, or the range ends.
bool touches(const std::array<Vec, 3>& p, const Vec& n, const Vec& o, const Vec& d, const Ray& ray) {
  std::vector<Rational> candidates;
  for (const double end : {ray.t_min, ray.t_max})
    if (std::isfinite(end)) candidates.emplace_back(end);
  for (int k = 0; k < 3; ++k) {
    candidates.push_back(dot(sub(p[k], o), d) / dot(d, d));
    const Vec edge = sub(p[(k + 1) % 3], p[k]), c = cross(d, edge);
    if (!zero(c)) candidates.push_back(dot(cross(sub(p[k], o), edge), c) / dot(c, c));
  }
  for (const Rational& t : candidates)
    if (within(ray, t) && in_triangle(p, n, at(o, d, t))) return true;
  return false;
}

signed char compare(const Rational& t, double bound) {
  if (std::isinf(bound)) return bound > 0 ? -1 : 1;
  return static_cast<signed char>(t < Rational(bound) ? -1 : t > Rational(bound));
}

void place(RationalMeeting& m, const Rational& u, const Rational& v) {
  const Rational w = 1 - u - v;
  m.u = u;
  m.v = v;
  if (u < 0 || v < 0 || w < 0) {
    m.truth.hit_class = HitClass::exterior;
  } else if (u == 1 || v == 1 || w == 1) {
    m.truth.hit_class = HitClass::vertex;
    m.truth.feature = u == 1 ? Feature::b : v == 1 ? Feature::c : Feature::a;
  } else if (u == 0 || v == 0 || w == 0) {
    m.truth.hit_class = HitClass::edge;
    m.truth.feature = u == 0 ? Feature::ca : v == 0 ? Feature::ab : Feature::bc;
  } else {
    m.truth.hit_class = HitClass::interior;
  }
}

}  // namespace

RationalMeeting rational_meeting(const Triangle& triangle, const Ray& ray) {
  RationalMeeting m;
  if (!finite(triangle.a) || !finite(triangle.b) || !finite(triangle.c))
    m.truth.invalid = Invalid::triangle_not_finite;
  else if (!finite(ray.origin))
    m.truth.invalid = Invalid::origin_not_finite;
  else if (!finite(ray.direction))
    m.truth.invalid = Invalid::direction_not_finite;
  else if (ray.direction == Vec3{})
    m.truth.invalid = Invalid::zero_direction;
  else if (std::isnan(ray.t_min) || std::isnan(ray.t_max))
    m.truth.invalid = Invalid::range_nan;
  if (m.truth.invalid != Invalid::none) return m;

  const std::array<Vec, 3> p = {exact(triangle.a), exact(triangle.b), exact(triangle.c)};
  const Vec o = exact(ray.origin), d = exact(ray.direction);
  const Vec n = cross(sub(p[1], p[0]), sub(p[2], p[0]));
  const Rational denominator = dot(n, d);
  m.truth.det_sign = static_cast<signed char>(sign(denominator));
  if (denominator == 0) {
    m.truth.hit_class = zero(n)                          ? HitClass::degenerate
                        : dot(n, sub(o, p[0])) == 0 ? HitClass::coplanar
                                                         : HitClass::parallel;
    m.touches = m.truth.hit_class != HitClass::parallel && touches(p, n, o, d, ray);
    return m;
  }
  m.t = dot(n, sub(p[0], o)) / denominator;
  // Dropping an axis along which the normal is not zero keeps barycentric coordinates.
  const int drop = n[0] != 0 ? 0 : n[1] != 0 ? 1 : 2, i = (drop + 1) % 3, j = (drop + 2) % 3;
  const Vec x = sub(at(o, d, m.t), p[0]), e1 = sub(p[1], p[0]), e2 = sub(p[2], p[0]);
  const Rational area = e1[i] * e2[j] - e1[j] * e2[i];
  place(m, (x[i] * e2[j] - x[j] * e2[i]) / area, (e1[i] * x[j] - e1[j] * x[i]) / area);
  if (m.truth.hit_class == HitClass::exterior) return m;
  m.truth.versus_t_min = compare(m.t, ray.t_min);
  m.truth.versus_t_max = compare(m.t, ray.t_max);
  return m;
}

template <class Real>
bool is_rounded(const Rational& x, Real r) {
  if (is_nan(r)) return false;
  if (x == 0) return is_zero(r);
  if (is_zero(r) ? (sign(x) < 0) != is_negative(r) : sign(x) != (r > 0 ? 1 : -1)) return false;
  const Rational magnitude = abs(x);
  const Real m = std::fabs(r);
  const bool even = (to_bits(m) & 1) == 0;
  const Real largest = std::numeric_limits<Real>::max();
  // The midpoint above the largest number is where the next one would lie, were the exponent unbounded.
  const Rational past_largest = Rational(largest) + (Rational(largest) - Rational(step_ulps(largest, -1))) / 2;
  if (!is_finite(m)) return magnitude >= past_largest;
  const Rational above = m == largest ? past_largest : (Rational(m) + Rational(step_ulps(m, 1))) / 2;
  if (magnitude > above || (magnitude == above && !even)) return false;
  if (is_zero(m)) return true;
  const Rational below = (Rational(m) + Rational(step_ulps(m, -1))) / 2;
  return magnitude > below || (magnitude == below && even);
}

template bool is_rounded<float>(const Rational&, float);
template bool is_rounded<double>(const Rational&, double);

bool is_rounded_sqrt(const Rational& x2, double r) {
  if (!is_finite(r) || is_negative(r)) return false;
  if (is_zero(r)) return x2 == 0 || x2 <= Rational(from_bits<double>(1)) * Rational(from_bits<double>(1)) / 4;
  const Rational above = (Rational(r) + Rational(step_ulps(r, 1))) / 2;
  const Rational below = (Rational(r) + Rational(step_ulps(r, -1))) / 2;
  const bool even = (to_bits(r) & 1) == 0;
  const Rational above2 = above * above, below2 = below * below;
  return (x2 < above2 || (x2 == above2 && even)) && (x2 > below2 || (x2 == below2 && even));
}

namespace {

// The squared distance of two segments or rays p + s*e, s in [s0, s1] or unbounded: the least over the ends of one
// against the other and, where the lines are not parallel, over the foot points of the common perpendicular.
struct Span {
  Vec p, e;
  std::optional<Rational> low, high;
  Rational clamp(Rational s) const {
    if (low && s < *low) s = *low;
    if (high && s > *high) s = *high;
    return s;
  }
};

Rational squared_distance(const Vec& x, const Span& span) {
  const Vec foot = at(span.p, span.e, span.clamp(dot(sub(x, span.p), span.e) / dot(span.e, span.e)));
  const Vec d = sub(x, foot);
  return dot(d, d);
}

Rational squared_distance(const Span& x, const Span& y) {
  std::optional<Rational> least;
  const auto offer = [&](const Rational& r) { if (!least || r < *least) least = r; };
  for (const auto& end : {x.low, x.high}) if (end) offer(squared_distance(at(x.p, x.e, *end), y));
  for (const auto& end : {y.low, y.high}) if (end) offer(squared_distance(at(y.p, y.e, *end), x));
  // Solve the 2x2 normal equations of |x.p + s x.e - y.p - r y.e|^2.
  const Vec w = sub(x.p, y.p);
  const Rational a = dot(x.e, x.e), b = dot(x.e, y.e), c = dot(y.e, y.e), d = dot(x.e, w), f = dot(y.e, w);
  const Rational determinant = a * c - b * b;
  if (determinant != 0) {
    const Rational s = (b * f - c * d) / determinant, r = (a * f - b * d) / determinant;
    if (x.clamp(s) == s && y.clamp(r) == r) {
      const Vec gap = sub(at(x.p, x.e, s), at(y.p, y.e, r));
      offer(dot(gap, gap));
    }
  }
  return *least;
}

}  // namespace

Rational squared_severity(const Triangle& triangle, const Ray& ray, bool answered_hit) {
  const std::array<Vec, 3> p = {exact(triangle.a), exact(triangle.b), exact(triangle.c)};
  const Vec n = cross(sub(p[1], p[0]), sub(p[2], p[0]));
  Span span{exact(ray.origin), exact(ray.direction), {}, {}};
  if (std::isfinite(ray.t_min)) span.low = Rational(ray.t_min);
  if (std::isfinite(ray.t_max)) span.high = Rational(ray.t_max);
  std::optional<Rational> least;
  const auto offer = [&](const Rational& r) { if (!least || r < *least) least = r; };
  for (const auto& end : {span.low, span.high}) {
    if (!end) continue;
    const Vec x = at(span.p, span.e, *end);
    const Rational height = dot(n, sub(x, p[0]));
    const Rational k = height / dot(n, n);
    const Vec foot = sub(x, Vec{k * n[0], k * n[1], k * n[2]});
    if (!answered_hit || in_triangle(p, n, foot)) offer(height * height / dot(n, n));
  }
  for (int k = 0; k < 3; ++k) {
    Span edge{p[k], sub(p[(k + 1) % 3], p[k]), {}, {}};
    if (answered_hit) {
      edge.low = Rational(0);
      edge.high = Rational(1);
      offer(squared_distance(span, edge));
    } else {
      // Two lines that are not parallel: the projection of any connecting vector on their common normal.
      const Vec common = cross(span.e, edge.e);
      const Rational gap = dot(sub(edge.p, span.p), common);
      offer(gap * gap / dot(common, common));
    }
  }
  return *least;
}

}  // namespace plumbline::judges
