#include "oracle/hit_errors.h"

#include <limits>

#include "case/precision.h"
#include "oracle/exact_case.h"
#include "oracle/invalid.h"
#include "oracle/largest.h"
#include "oracle/program_point.h"
#include "oracle/round.h"

namespace plumbline {
namespace {

using namespace exact;

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();

template <class Real>
int unit_of(const Quotient& x) {
  if (x.numerator.sign() == 0) return FloatFormat<Real>::min_exponent;
  const Real nearest = rounded<Real>(x);
  return ulp_exponent(is_finite(nearest) ? nearest : std::numeric_limits<Real>::max());
}

void tell(const Quotient& x, double said, Precision precision, double& ulps, double& off) {
  ulps = off = inf;
  if (!is_finite(said)) return;
  const int unit = precision == Precision::binary32 ? unit_of<float>(x) : unit_of<double>(x);
  const Dyadic error = abs(Dyadic(said) * x.denominator - x.numerator);
  off = rounded<double>({error, x.denominator});
  ulps = rounded<double>({error, x.denominator * Dyadic(1, unit)});
}

}  // namespace

std::optional<HitErrors> hit_errors(const Triangle& triangle, const Query& query, const HitNumbers& said,
                                    Precision precision) {
  if (why_invalid(triangle, query.ray) != Invalid::none) return std::nullopt;
  const ExactCase x(triangle, query);
  if (x.det.sign() == 0) return std::nullopt;
  const int ulp = ulp_exponent_at(largest_coordinate(triangle, query.ray), precision);
  const Dyadic det2 = square(x.det), normal2 = square(x.normal), ulp2(1, 2 * ulp);
  const auto length = [&ulp2](const Dyadic& p2, const Dyadic& q2) {
    return rounded_sqrt<double>(Quotient(p2, q2 * ulp2));
  };
  HitErrors e{.t = nan, .u = nan, .v = nan, .t_off = nan, .u_off = nan, .v_off = nan, .point = nan, .residual = nan,
              .start = nan};
  if (said.uv) {
    const auto [u, v] = *said.uv;
    tell(x.u(), u, precision, e.u, e.u_off);
    tell(x.v(), v, precision, e.v, e.v_off);
    e.point = inf;
    if (is_finite(u) && is_finite(v)) {
      const Vec off = (Dyadic(u) * x.det - x.w_ca) * x.e1 + (Dyadic(v) * x.det - x.w_ab) * x.e2;
      e.point = length(square(off), det2);
    }
  }
  if (said.t) {
    tell(x.t(), *said.t, precision, e.t, e.t_off);
    e.residual = e.start = inf;
    if (is_finite(*said.t)) e.residual = length(square(Dyadic(*said.t) * x.det - x.T), normal2);
    const Vec3 p = point_at(query.ray, *said.t, precision);
    if (is_finite(p.x) && is_finite(p.y) && is_finite(p.z))
      e.start = length(square(dot(x.normal, to_exact(p) - x.a)), normal2);
  }
  return e;
}

}  // namespace plumbline
