#include "oracle/integer.h"

#include "oracle/decoded.h"
#include "oracle/integer_case.h"
#include "oracle/normalized.h"
#include "oracle/wide_case.h"

namespace plumbline {
namespace {

IntegerCross cross(const IntegerVec& p, const IntegerVec& q) { return {p, q}; }
bool is_zero(const IntegerCross& v) { return v.is_zero(); }

// A wide case as the other: A-O, B-A, C-A.
struct WideDifferences {
  WideVec<2> a, e1, e2, direction;
  int point_unit, direction_unit;
  explicit WideDifferences(const WideCase& x)
      : a(x.a - x.origin),
        e1(x.b - x.a),
        e2(x.c - x.a),
        direction(x.direction),
        point_unit(x.point_unit),
        direction_unit(x.direction_unit) {}
};

// sign(T - tau det). The two terms are compared by sign, exponent and significand; tau has 53 bits.
template <class Case, class Integer>
int sign_of_difference(const Case& x, const Integer& T, const Integer& det, double tau) {
  const Decoded t(tau);
  const int left_sign = T.sign(), right_sign = t.significand == 0 ? 0 : det.sign() * (t.negative ? -1 : 1);
  if (left_sign != right_sign || left_sign == 0) return left_sign != 0 ? left_sign : -right_sign;
  Normalized left(T), right(det);
  left.exponent += x.point_unit;
  right *= t.significand;
  right.exponent += t.exponent + x.direction_unit;
  return left.compare(right) * left_sign;
}

template <class Case, class Cross>
Truth without_crossing(const Case& x, const Cross& normal) {
  Truth truth;
  truth.hit_class = is_zero(normal)                 ? HitClass::degenerate
                    : dot(x.a, normal).sign() == 0 ? HitClass::coplanar
                                                   : HitClass::parallel;
  return truth;
}

// The signs of t - t_min and t - t_max.
template <class Case>
void place_in_range(Truth& truth, const Case& x, const Ray& ray, const KnownSigns& known) {
  truth.versus_t_min = known.past_min;
  truth.versus_t_max = known.past_max;
  if (known.past_min != KnownSigns::unknown && known.past_max != KnownSigns::unknown) return;
  const auto normal = cross(x.e1, x.e2);
  const auto T = dot(x.a, normal), det = dot(x.direction, normal);
  const auto versus = [&](double tau) {
    if (!is_finite(tau)) return static_cast<signed char>(is_negative(tau) ? 1 : -1);
    return static_cast<signed char>(sign_of_difference(x, T, det, tau) * truth.det_sign);
  };
  if (known.past_min == KnownSigns::unknown) truth.versus_t_min = versus(ray.t_min);
  if (known.past_max == KnownSigns::unknown) truth.versus_t_max = versus(ray.t_max);
}

// The direction is not zero, the bounds are not NaN.
template <class Case>
Truth decide(const Case& x, const Ray& ray, const KnownSigns& known) {
  constexpr signed char unknown = KnownSigns::unknown;
  int det = known.det;
  if (det == unknown) {
    const auto normal = cross(x.e1, x.e2);
    det = dot(x.direction, normal).sign();
    if (det == 0) return without_crossing(x, normal);
  }
  int ab = known.ab, bc = known.bc, ca = known.ca;
  if (ab == unknown || ca == unknown) {
    const auto h = cross(x.direction, x.a);
    if (ab == unknown) ab = dot(x.e1, h).sign() * det;
    if (ca == unknown) ca = -dot(x.e2, h).sign() * det;
  }
  // w_BC = D . (b x c) with b = a + e1, c = a + e2, so (e2 - e1) . (D x b).
  if (bc == unknown) bc = dot(x.e2 - x.e1, cross(x.direction, x.a + x.e1)).sign() * det;
  Truth truth;
  truth.det_sign = static_cast<signed char>(det);
  place(truth, ab, bc, ca);
  if (truth.hit_class != HitClass::exterior) place_in_range(truth, x, ray, known);
  return truth;
}

}  // namespace

std::optional<Truth> classify_integer(const Triangle& triangle, const Ray& ray, const KnownSigns& known) {
  const auto x = IntegerCase::make(triangle, ray);
  if (!x || is_nan(ray.t_min) || is_nan(ray.t_max)) return std::nullopt;
  return decide(*x, ray, known);
}

std::optional<Truth> classify_wide(const Triangle& triangle, const Ray& ray, const KnownSigns& known) {
  const auto x = WideCase::make(triangle, ray);
  if (!x) return std::nullopt;
  return decide(WideDifferences(*x), ray, known);
}

}  // namespace plumbline
