#include "oracle/bag/hit_order.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "oracle/exact_case.h"

namespace plumbline {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Vec3 minus(const Vec3& p, const Vec3& q) { return {p.x - q.x, p.y - q.y, p.z - q.z}; }
Vec3 cross(const Vec3& p, const Vec3& q) {
  return {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
}
double dot(const Vec3& p, const Vec3& q) { return p.x * q.x + p.y * q.y + p.z * q.z; }
double norm(const Vec3& v) { return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}); }

// The ends of the closed edge, or the vertex twice, on which a triangle is crossed; interior: none.
using Ends = std::pair<const Vec3*, const Vec3*>;
Ends ends(const Crossed& x) {
  const auto& [a, b, c] = x.triangle;
  switch (x.truth.feature) {
    case Feature::none:
      break;
    case Feature::ab:
      return {&a, &b};
    case Feature::bc:
      return {&b, &c};
    case Feature::ca:
      return {&c, &a};
    case Feature::a:
      return {&a, &a};
    case Feature::b:
      return {&b, &b};
    case Feature::c:
      return {&c, &c};
  }
  return {nullptr, nullptr};
}

// A line that isn't in the planes meets the edge that two triangles share, or their vertex, in one point.
bool at_shared_feature(const Crossed& x, const Crossed& y) {
  const auto [p, q] = ends(x);
  const auto [r, s] = ends(y);
  if (!p || !r) return false;
  return (*p == *r && *q == *s) || (*p == *s && *q == *r);
}

[[gnu::noinline, gnu::cold]] std::strong_ordering compare_exactly(const Triangle& x, const Triangle& y,
                                                                  const Query& query) {
  return exact::ExactCase(x, query).t() <=> exact::ExactCase(y, query).t();
}

}  // namespace

// With the filter's bounds (batch_kernel.h: u = 2^-53, mD, ma, me the largest components of D, of the computed a, and
// of the computed e1 and e2, each between 2^-300 and 2^300): |T~ - T| <= eT = 2^-46 ma me^2, |det~ - det| <= ed = 2^-46
// mD me^2. A tail of D is at most u |D| and adds 6 u mD me^2 to det's 42 u, less than the bound's 128 u. So
//   |t - T~/det~| = |(T - T~) det~ - T~ (det - det~)| / |det det~| <= (eT + |T~/det~| ed) / (|det~| - ed).
// Where |det~| >= 2 ed and 2^-900 < |t~| < 2^900, no operation below over- or underflows (eT, ed > 2^-947), each of at
// most six rounds by a relative 2^-53, and t~ = T~/det~ (1 + u): 1 + 2^-4 and 2^-52 |t~| more than cover that.
RoughT rough_t(const Triangle& triangle, const Query& query) {
  constexpr double low = 0x1p-300, high = 0x1p+300, k46 = 0x1p-46;
  const Vec3 &d = query.ray.direction, a = minus(triangle.a, query.ray.origin), e1 = minus(triangle.b, triangle.a),
             e2 = minus(triangle.c, triangle.a), n = cross(e1, e2);
  const double m_d = norm(d), m_a = norm(a), m_e = std::max(norm(e1), norm(e2));
  const double det = dot(d, n), T = dot(a, n), t = T / det;
  const double det_error = k46 * m_e * m_d * m_e, T_error = k46 * m_e * m_a * m_e;
  const bool known = std::min({m_d, m_a, m_e}) > low && std::max({m_d, m_a, m_e}) < high &&
                     std::fabs(det) >= 2 * det_error && std::fabs(t) > 0x1p-900 && std::fabs(t) < 0x1p+900;
  if (!known) return {0, infinity};
  const double error = (T_error + std::fabs(t) * det_error) / (std::fabs(det) - det_error);
  return {t, 1.0625 * error + 0x1p-52 * std::fabs(t)};
}

std::strong_ordering compare_t(const Crossed& x, const Crossed& y, const Query& query) {
  if (at_shared_feature(x, y)) return std::strong_ordering::equal;
  const RoughT p = rough_t(x.triangle, query), q = rough_t(y.triangle, query);
  const double apart = q.centre - p.centre, reach = 1.0625 * (p.radius + q.radius);  // 1.0625: for three roundings
  if (apart > reach) return std::strong_ordering::less;
  if (-apart > reach) return std::strong_ordering::greater;
  return compare_exactly(x.triangle, y.triangle, query);
}

}  // namespace plumbline
