#include "oracle/integer.h"

#include "oracle/decoded.h"
#include "oracle/integer_case.h"

namespace plumbline {
namespace {

// sign(T - tau det). The two terms are compared by sign, exponent and significand; a significand is at most 192 + 53 bits.
int sign_of_difference(const IntegerCase& x, const Int192& T, const Int192& det, double tau) {
  const Decoded t(tau);
  const int left_sign = T.sign(), right_sign = t.significand == 0 ? 0 : det.sign() * (t.negative ? -1 : 1);
  if (left_sign != right_sign || left_sign == 0) return left_sign != 0 ? left_sign : -right_sign;
  Normalized left(T), right(det);
  left.exponent += x.point_unit;
  right *= t.significand;
  right.exponent += t.exponent + x.direction_unit;
  return left.compare(right) * left_sign;
}

Truth without_crossing(const IntegerCase& x, const IntegerCross& normal) {
  Truth truth;
  truth.hit_class = normal.is_zero()                ? HitClass::degenerate
                    : dot(x.a, normal).sign() == 0 ? HitClass::coplanar
                                                   : HitClass::parallel;
  return truth;
}

// The signs of t - t_min and t - t_max.
void place_in_range(Truth& truth, const IntegerCase& x, const Ray& ray, const KnownSigns& known) {
  truth.versus_t_min = known.past_min;
  truth.versus_t_max = known.past_max;
  if (known.past_min != KnownSigns::unknown && known.past_max != KnownSigns::unknown) return;
  const IntegerCross normal(x.e1, x.e2);
  const Int192 T = dot(x.a, normal), det = dot(x.direction, normal);
  const auto versus = [&](double tau) {
    if (!is_finite(tau)) return static_cast<signed char>(is_negative(tau) ? 1 : -1);
    return static_cast<signed char>(sign_of_difference(x, T, det, tau) * truth.det_sign);
  };
  if (known.past_min == KnownSigns::unknown) truth.versus_t_min = versus(ray.t_min);
  if (known.past_max == KnownSigns::unknown) truth.versus_t_max = versus(ray.t_max);
}

}  // namespace

std::optional<Truth> classify_integer(const Triangle& triangle, const Ray& ray, const KnownSigns& known) {
  constexpr signed char unknown = KnownSigns::unknown;
  const auto x = IntegerCase::make(triangle, ray);
  if (!x || is_nan(ray.t_min) || is_nan(ray.t_max)) return std::nullopt;
  int det = known.det;
  if (det == unknown) {
    const IntegerCross normal(x->e1, x->e2);
    det = dot(x->direction, normal).sign();
    if (det == 0) return without_crossing(*x, normal);
  }
  int ab = known.ab, bc = known.bc, ca = known.ca;
  if (ab == unknown || ca == unknown) {
    const IntegerCross h(x->direction, x->a);
    if (ab == unknown) ab = dot(x->e1, h).sign() * det;
    if (ca == unknown) ca = -dot(x->e2, h).sign() * det;
  }
  // w_BC = D . (b x c) with b = a + e1, c = a + e2, so (e2 - e1) . (D x b).
  if (bc == unknown) bc = dot(x->e2 - x->e1, IntegerCross(x->direction, x->a + x->e1)).sign() * det;
  Truth truth;
  truth.det_sign = static_cast<signed char>(det);
  place(truth, ab, bc, ca);
  if (truth.hit_class != HitClass::exterior) place_in_range(truth, *x, ray, known);
  return truth;
}

}  // namespace plumbline
