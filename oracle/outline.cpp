#include "oracle/outline.h"

#include <utility>

#include "case/float_bits.h"
#include "oracle/exact_case.h"
#include "oracle/invalid.h"
#include "oracle/round.h"

namespace plumbline {
namespace {

using namespace exact;

// The length of `v`/`denominator` in the direction of `axis`.
double along(const Vec& v, const Vec& axis, const Dyadic& denominator) {
  const Dyadic length = dot(v, axis);
  const double magnitude = rounded_sqrt<double>(Quotient(square(length), square(denominator) * square(axis)));
  return length.sign() * denominator.sign() < 0 ? -magnitude : magnitude;
}

// In the plane at right angles to `view`; the corners are those of the triangle less `point`/`denominator`.
Outline seen(const ExactCase& x, unsigned base, const Vec& view, const Vec& point, const Dyadic& denominator) {
  const std::array<const Vec*, 3> corners = {&x.a, &x.b, &x.c};
  const std::array<Vec, 3> edges = {x.e1, x.c - x.b, x.a - x.c};
  Vec up = cross(view, edges[base]), right = cross(up, view);
  if (dot(*corners[(base + 2) % 3] - *corners[base], up).sign() < 0) {
    up = Dyadic(-1, 0) * up;
    right = Dyadic(-1, 0) * right;
  }
  Outline outline;
  const Dyadic one(1, 0);
  for (unsigned k = 0; k < 3; ++k) {
    const Vec corner = denominator * *corners[k] - point;
    outline.corner[k] = {along(corner, right, denominator), along(corner, up, denominator)};
    outline.edge[k] = {along(edges[k], right, one), along(edges[k], up, one)};
  }
  return outline;
}

std::optional<ExactCase> crossing(const Triangle& triangle, const Query& query) {
  if (why_invalid(triangle, query.ray) != Invalid::none) return std::nullopt;
  ExactCase x(triangle, query);
  if (x.det.sign() == 0) return std::nullopt;
  return x;
}

}  // namespace

std::optional<Outline> seen_along_ray(const Triangle& triangle, const Query& query, unsigned base) {
  const auto x = crossing(triangle, query);
  if (!x) return std::nullopt;
  return seen(*x, base, x->direction, x->origin, Dyadic(1, 0));
}

std::optional<Outline> seen_flat(const Triangle& triangle, const Query& query, unsigned base) {
  const auto x = crossing(triangle, query);
  if (!x) return std::nullopt;
  return seen(*x, base, x->normal, x->det * x->origin + x->T * x->direction, x->det);
}

std::optional<double> height_above_plane(const Triangle& triangle, const Query& query, double t) {
  if (why_invalid(triangle, query.ray) != Invalid::none || !is_finite(t)) return std::nullopt;
  const ExactCase x(triangle, query);
  if (is_zero(x.normal)) return std::nullopt;
  return along(x.origin + Dyadic(t) * x.direction - x.a, x.normal, Dyadic(1, 0));
}

}  // namespace plumbline
