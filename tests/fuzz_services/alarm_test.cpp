#include "fuzz/alarm.h"

#include <gtest/gtest.h>

#include <limits>

#include "analysis/tracers.h"

namespace plumbline {
namespace {

Finding finding(double ulps) {
  Finding f;
  f.signature = {.kind = FindingKind::false_hit, .element = Element::bc};
  f.ulps = ulps;
  f.input.triangle = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  f.input.ray = {{0x1p-1, 0x1p-1, 1}, {0, 0, -1}};
  return f;
}

TEST(Baseline, IsExceededByANewClass) {
  Baseline baseline;
  EXPECT_TRUE(baseline.exceeded_by(finding(0)));
  baseline.add(finding(4));
  Finding other = finding(0x1p-60);
  EXPECT_FALSE(baseline.exceeded_by(other));
  other.signature.element = Element::ca;
  EXPECT_TRUE(baseline.exceeded_by(other));
  other = finding(0x1p-60);
  other.signature.kind = FindingKind::false_miss;
  EXPECT_TRUE(baseline.exceeded_by(other));
  other = finding(0x1p-60);
  other.signature.conditioning = Conditioning::sliver;
  EXPECT_TRUE(baseline.exceeded_by(other));
  baseline.add(other);
  other.signature.conditioning = Conditioning::grazing;  // ill-conditioned is one class
  other.signature.bucket = 3;
  other.signature.rejection = Rejection::t;
  EXPECT_FALSE(baseline.exceeded_by(other));
}

TEST(Baseline, IsExceededByTwiceTheWorst) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  Baseline baseline;
  for (const double known : {3.0, 4.0, 0.0}) baseline.add(finding(known));
  for (const double more : {0.0, 4.0, 0x1.fffffffffffffp+2})
    EXPECT_FALSE(baseline.exceeded_by(finding(more))) << more;
  for (const double more : {8.0, inf}) EXPECT_TRUE(baseline.exceeded_by(finding(more))) << more;
  baseline.add(finding(inf));
  EXPECT_FALSE(baseline.exceeded_by(finding(inf)));

  Baseline by_convention;  // without a severity
  by_convention.add(finding(0));
  EXPECT_FALSE(by_convention.exceeded_by(finding(0)));
  EXPECT_TRUE(by_convention.exceeded_by(finding(std::numeric_limits<double>::denorm_min())));
}

TEST(AlarmDeathTest, NamesTheClass) {
  const CampaignPlan plan{.tracer = &find_tracer("moller_trumbore_f64")};
  EXPECT_DEATH(raise_alarm(finding(4), plan),
               "^plumbline: Assertion `false_hit_bc_nominal' failed\nDEDUP_TOKEN: false_hit_bc_nominal\n"
               "# false-hit of moller_trumbore_f64\n(.*\n)+case false-hit-bc-nominal-c0\n");
}

}  // namespace
}  // namespace plumbline
