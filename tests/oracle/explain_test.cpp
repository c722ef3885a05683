#include "oracle/explain.h"

#include <gmock/gmock.h>

namespace plumbline {
namespace {

using testing::HasSubstr;
const Triangle unit{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

TEST(Explain, PrintsDeterminantsAsIntegersTimesAPowerOfTwo) {
  const std::string text = explain(unit, Ray{{0.25, 0.25, 1}, {0, 0, -3}});
  EXPECT_THAT(text, HasSubstr("det        -3\n"));
  EXPECT_THAT(text, HasSubstr("w_ca       -3 * 2^-2   (the sign of det: inner side)"));
  EXPECT_THAT(text, HasSubstr("class      interior"));
  EXPECT_THAT(text, HasSubstr("t = T/det  1/3"));
  EXPECT_THAT(text, HasSubstr("0x1.5555555555555p-2"));
  EXPECT_THAT(text, HasSubstr("hit        yes"));
}

TEST(Explain, NamesTheFeatureAndTheRange) {
  EXPECT_THAT(explain(unit, Ray{{0.5, 0.5, 1}, {0, 0, -1}}), HasSubstr("meets edge bc"));
  EXPECT_THAT(explain(unit, Ray{{0, 1, 1}, {0, 0, -1}}), HasSubstr("meets vertex c"));
  EXPECT_THAT(explain(unit, Ray{{0, 1, 1}, {0, 0, -1}, 0, 0.5}), HasSubstr("t > t_max"));
  EXPECT_THAT(explain(unit, Ray{{0, 1, 1}, {0, 0, -1}, 1, 2}), HasSubstr("t = t_min"));
}

TEST(Explain, SaysWhatALineThatDoesNotCrossMeets) {
  EXPECT_THAT(explain(unit, Ray{{-1, 0.25, 0}, {1, 0, 0}}), HasSubstr("t from 1/1 to 7/4"));
  EXPECT_THAT(explain(unit, Ray{{-1, 2, 0}, {1, 0, 0}}), HasSubstr("meets no point"));
  EXPECT_THAT(explain(unit, Ray{{-1, 0.25, 1}, {1, 0, 0}}), HasSubstr("beside the plane"));
  EXPECT_THAT(explain({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, Ray{{1.5, 1.5, 0}, {0, 0, 1}}), HasSubstr("t from 3/2 to 3/2"));
  EXPECT_THAT(explain(unit, Ray{{0, 0, 1}, {0, 0, 0}}), HasSubstr("invalid: the direction is zero"));
}

TEST(Certificate, HoldsWhatTheTextSays) {
  const Certificate c = certificate(unit, Ray{{0.5, -0.25, 1}, {0, 0, -3}});
  EXPECT_EQ(c.truth.hit_class, HitClass::exterior);
  EXPECT_EQ(c.hit, false);
  EXPECT_EQ(c.det.exact, "-3");
  EXPECT_EQ(c.w_ab.exact, "3 * 2^-2");
  EXPECT_EQ(side(c.w_ab.sign, c.det.sign), "against the sign of det: outer side");
  EXPECT_EQ(side(c.w_bc.sign, c.det.sign), "the sign of det: inner side");
  EXPECT_EQ(c.t->exact, "1/3");
  EXPECT_EQ(c.t->binary32, 0x1.555556p-2f);
  EXPECT_EQ(c.range, "t_min < t < t_max");
}

TEST(Certificate, HasNoCoordinatesWhereNothingCrosses) {
  const Certificate parallel = certificate(unit, Ray{{0, 0, 1}, {1, 0, 0}});
  EXPECT_EQ(parallel.det.exact, "0");
  EXPECT_FALSE(parallel.t || parallel.u || parallel.v);
  EXPECT_EQ(parallel.hit, false);
  const Certificate open = certificate(unit, Ray{{-1, 0.25, 0}, {1, 0, 0}});
  EXPECT_EQ(open.hit, std::nullopt);
  EXPECT_EQ(certificate(unit, Ray{{0, 0, 1}, {0, 0, 0}}).where, "the direction is zero");
}

TEST(ExplainVerdict, GivesDutyAnswerAndSeverity) {
  const Ray near{{0.5, -0x1p-10, 1}, {0, 0, -1}};
  const Answer hit{.outcome = Outcome::hit, .has_t = true, .t = 1};
  const std::string text = explain_verdict(unit, near, hit, {});
  EXPECT_THAT(text, HasSubstr("must miss"));
  EXPECT_THAT(text, HasSubstr("false-hit"));
  EXPECT_THAT(text, HasSubstr("(0x1p-10)"));
  EXPECT_THAT(text, HasSubstr("nominal"));
  EXPECT_THAT(explain_verdict(unit, near, {.outcome = Outcome::miss}, {}), HasSubstr("correct"));
}

}  // namespace
}  // namespace plumbline
