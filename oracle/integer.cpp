#include "oracle/integer.h"

#include "oracle/decoded.h"
#include "oracle/integer_case.h"
#include "oracle/signs.h"

namespace plumbline {
namespace {

// sign(T - tau det). The two terms are compared by sign, exponent and significand; a significand is at most 192 + 53 bits.
int sign_of_difference(const IntegerCase& x, const IntegerDeterminants& k, double tau) {
  const Decoded t(tau);
  const int T = k.T.sign(), other = t.significand == 0 ? 0 : k.det.sign() * (t.negative ? -1 : 1);
  if (T != other || T == 0) return T != 0 ? T : -other;
  Normalized left(k.T), right(k.det);
  left.exponent += x.point_unit;
  right *= t.significand;
  right.exponent += t.exponent + x.direction_unit;
  return left.compare(right) * T;
}

signed char versus(const IntegerCase& x, const IntegerDeterminants& k, double tau, int det) {
  if (!is_finite(tau)) return is_negative(tau) ? 1 : -1;
  return static_cast<signed char>(sign_of_difference(x, k, tau) * det);
}

}  // namespace

std::optional<Truth> classify_integer(const Triangle& triangle, const Ray& ray) {
  const auto x = IntegerCase::make(triangle, ray);
  if (!x || is_nan(ray.t_min) || is_nan(ray.t_max)) return std::nullopt;
  const IntegerDeterminants k(*x);
  const int det = k.det.sign();
  Truth truth;
  truth.det_sign = static_cast<signed char>(det);
  if (det == 0) {
    truth.hit_class = k.normal.is_zero()   ? HitClass::degenerate
                      : k.T.sign() == 0 ? HitClass::coplanar
                                        : HitClass::parallel;
    return truth;
  }
  place(truth, k.w_ab.sign() * det, k.w_bc.sign() * det, k.w_ca.sign() * det);
  if (truth.hit_class == HitClass::exterior) return truth;
  truth.versus_t_min = versus(*x, k, ray.t_min, det);
  truth.versus_t_max = versus(*x, k, ray.t_max, det);
  return truth;
}

}  // namespace plumbline
