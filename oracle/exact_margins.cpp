#include "oracle/exact_margins.h"

#include <cmath>

#include "oracle/classify.h"
#include "oracle/exact_severity.h"
#include "oracle/largest.h"
#include "oracle/round.h"

namespace plumbline {

using namespace exact;

std::optional<Margins> exact_margins(const Triangle& triangle, const Query& query, Precision precision) {
  const Truth truth = classify(triangle, query);
  if (truth.hit_class == HitClass::invalid) return std::nullopt;
  const ExactCase x(triangle, query);
  const bool hit = crosses(truth);
  const auto s2 = squared_severity(x, query.ray, !hit);
  if (!s2) return std::nullopt;
  const double largest = largest_coordinate(triangle, query.ray);
  const Dyadic det2 = square(x.det), normal2 = square(x.normal), longest2 = squared_longest_edge(x);
  const int ulp = ulp_exponent_at(largest, precision);
  const Dyadic ulp2(1, 2 * ulp);
  const auto root = [](const Dyadic& p, const Dyadic& q) { return rounded_sqrt<double>(Quotient(p, q)); };
  Margins m{.truth = truth,
            .hit = hit,
            .severity = rounded_sqrt<double>(*s2),
            .ulp = std::ldexp(1.0, ulp),
            .severity_ulps = root(s2->numerator, s2->denominator * ulp2),
            .sine = root(det2, square(x.direction) * normal2),
            .altitude = root(normal2, square(longest2)),
            .size = root(longest2, square(Dyadic(largest)))};
  const int det = truth.det_sign;
  if (det == 0) return m;
  const auto sign = [det](const Dyadic& w) { return static_cast<signed char>(w.sign() * det); };
  m.ab = sign(x.w_ab), m.bc = sign(x.w_bc), m.ca = sign(x.w_ca);
  m.t = rounded<double>(x.t()), m.u = rounded<double>(x.u()), m.v = rounded<double>(x.v());
  m.w = rounded<double>(Quotient(x.w_bc, x.det));
  m.t_scale = root(det2, normal2);
  m.u_scale = root(det2, square(cross(x.e2, x.direction)));
  m.v_scale = root(det2, square(cross(x.e1, x.direction)));
  m.w_scale = root(det2, square(cross(x.c - x.b, x.direction)));
  return m;
}

}  // namespace plumbline
