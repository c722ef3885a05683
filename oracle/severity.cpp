#include "oracle/severity.h"

#include "oracle/exact_severity.h"
#include "oracle/invalid.h"
#include "oracle/largest.h"
#include "oracle/round.h"

namespace plumbline {
namespace {

using namespace exact;

Condition condition(const ExactCase& x, double largest) {
  const Dyadic normal2 = square(x.normal), longest2 = squared_longest_edge(x);
  const Dyadic limit2(1, -20);  // (2^-10)^2
  return {.grazing = square(x.det) < limit2 * square(x.direction) * normal2,
          .sliver = normal2 < limit2 * square(longest2),
          .far = longest2 < limit2 * square(Dyadic(largest))};
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
  if (is_zero(x.normal) || !range(query.ray)) return false;
  const auto s2 = squared_severity(x, query.ray, true);
  if (!s2) return true;  // it meets the triangle
  // With L the longest edge: S <= abs + rel L  <=>  excess := S^2 - abs^2 - rel^2 L^2 <= 2 abs rel L; all of it is
  // multiplied by the denominator of S^2, and squared where excess > 0.
  const Dyadic absolute2 = square(Dyadic(slack_absolute)), relative2 = square(Dyadic(slack_relative));
  const Dyadic longest2 = squared_longest_edge(x), &q = s2->denominator;
  const Dyadic excess = s2->numerator - q * (absolute2 + relative2 * longest2);
  if (excess.sign() <= 0) return true;
  return square(excess) <= Dyadic(4, 0) * square(q) * absolute2 * relative2 * longest2;
}

}  // namespace plumbline
