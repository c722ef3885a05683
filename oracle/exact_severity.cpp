#include "oracle/exact_severity.h"

#include <algorithm>

#include "oracle/least_translation.h"

namespace plumbline::exact {
namespace {

// What is measured is the square.
struct ExactNumbers {
  using Vec = exact::Vec;
  using Normal = exact::Vec;
  using Height = Dyadic;
  using Measure = Quotient;
  static Normal cross(const Vec& x, const Vec& y) { return exact::cross(x, y); }
  static bool is_zero(const Normal& x) { return exact::is_zero(x); }
  static int sign_of_dot(const Vec& x, const Vec& y) { return dot(x, y).sign(); }
  static Measure length(const Vec& x) { return Quotient(square(x)); }
  template <class Length>
  static Measure ratio(const Length& x, const Vec& y) {
    return {square(x), square(y)};
  }
};

Quotient squared_translation(const ExactCase& x, const Interval& range, bool truth) {
  const Vec &d = x.direction, to_a = x.a - x.origin, e3 = x.c - x.b, back = x.a - x.c;
  const Sight<ExactNumbers> sight{.direction = d,
                                  .to = {to_a, x.b - x.origin, x.c - x.origin},
                                  .edge = {x.e1, e3, back},
                                  .normal = x.normal,
                                  .across = {cross(x.e1, d), cross(e3, d), cross(back, d)},
                                  .w = {x.w_ab, x.w_bc, x.w_ca}};
  const auto end_at = [&](const std::optional<Quotient>& tau) -> std::optional<RayEnd<ExactNumbers>> {
    if (!tau) return std::nullopt;
    const Vec way = tau->numerator * d;
    return RayEnd<ExactNumbers>{.to = {sight.to[0] - way, sight.to[1] - way, sight.to[2] - way},
                                .height = x.T - tau->numerator * x.det};
  };
  const auto low = end_at(range.low), high = end_at(range.high);
  const auto *low_end = low ? &*low : nullptr, *high_end = high ? &*high : nullptr;
  return truth ? depth(sight, low_end, high_end) : distance(sight, low_end, high_end);
}

bool meets(const ExactCase& x, const Ray& ray, const Interval& searched) {
  const int det = x.det.sign();
  if (det == 0) return contact_in_range(x, ray).has_value();
  const bool in_triangle = x.w_ab.sign() * det >= 0 && x.w_bc.sign() * det >= 0 && x.w_ca.sign() * det >= 0;
  return in_triangle && contains(searched, x.t());
}

}  // namespace

std::optional<Quotient> squared_severity(const ExactCase& x, const Ray& ray, bool answered_hit) {
  const auto searched = range(ray);
  if (is_zero(x.normal) || !searched) return std::nullopt;
  const bool truth = meets(x, ray, *searched);
  if (truth == answered_hit || (truth && x.det.sign() == 0)) return std::nullopt;
  return squared_translation(x, *searched, truth);
}

Dyadic squared_longest_edge(const ExactCase& x) {
  return std::max({square(x.e1), square(x.e2), square(x.c - x.b)});
}

}  // namespace plumbline::exact
