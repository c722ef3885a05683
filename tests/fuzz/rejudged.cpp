#include "tests/fuzz/rejudged.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "oracle/explain.h"
#include "tests/fuzz/searched.h"
#include "tests/judges/print.h"
#include "tests/judges/rational_judge.h"

namespace plumbline {
namespace {

using judges::Rational;

struct Rejudged {
  std::uint64_t executions = 0, disagreements = 0;
  std::uint64_t measured = 0;  ///< those with a severity above 0
};

bool crosses_by(const judges::Judged& judged) {
  const Truth& t = judged.truth;
  return t.hit_class <= HitClass::vertex && t.versus_t_min >= 0 && t.versus_t_max <= 0;
}

void judge_again(const Examination& e, const Contract& contract, Rejudged& sum) {
  ASSERT_TRUE(contract.edges == EdgeRule::closed && contract.t_min == EndRule::closed &&
              contract.t_max == EndRule::closed && contract.coplanar == TouchRule::miss &&
              contract.degenerate == TouchRule::miss && contract.culling == Culling::none &&
              contract.slack_absolute == 0 && contract.slack_relative == 0);
  ASSERT_FALSE(e.query.has_tail());
  const judges::Judged judged = judges::rational_meeting(e.triangle, e.query.ray);
  ASSERT_EQ(e.truth, judged.truth);
  const bool answered = e.answer.outcome == Outcome::hit, hit = crosses_by(judged);
  if (e.verdict == VerdictKind::correct) {  // found for its numbers
    ASSERT_EQ(answered, hit);
    return;
  }
  ASSERT_NE(answered, hit);
  ASSERT_EQ(e.verdict, answered ? VerdictKind::false_hit : VerdictKind::false_miss);
  if (!e.margins) {  // only what touches, has no area or no t in its range isn't measured
    const bool empty = !(e.query.ray.t_min <= e.query.ray.t_max);
    ASSERT_TRUE(judged.truth.hit_class == HitClass::degenerate || judged.touches || empty);
    return;
  }
  const Rational s2 = judges::squared_severity(e.triangle, e.query.ray, answered);
  const double s = e.margins->severity;
  if (s2 == 0) {
    ASSERT_EQ(s, 0);
    ASSERT_EQ(e.severity_ulps(), 0);
    return;
  }
  ++sum.measured;
  ASSERT_TRUE(s > 0 || s2 < Rational(0x1p-1074) * Rational(0x1p-1074));  // in ulps, too, it may underflow
  if (!(s > 0x1p-900 && s < 0x1p+900)) return;  // subnormal or infinite ones have no relative error
  const Rational ratio = s2 / (Rational(s) * Rational(s)), off = Rational(0x1p-39);
  ASSERT_TRUE(ratio > (1 - off) * (1 - off) && ratio < (1 + off) * (1 + off)) << s;
}

bool has_signature(const Features& features) {
  return std::ranges::any_of(std::span(features.cells).first(features.size),
                             [](Cell cell) { return (cell & signature_cell) != 0; });
}

// Searches until `wanted` disagreements were judged again.
void rejudge(const CampaignPlan& plan, std::uint64_t wanted, Rejudged& sum) {
  Campaign campaign(plan);
  Examiner examiner(*plan.tracer);
  std::uint64_t judged = 0;
  while (judged < wanted && campaign.executions() < 100 * wanted) {
    const FuzzInput input = campaign.next();
    campaign.test(input);
    if (!has_signature(campaign.last_features())) continue;
    ++judged;
    SCOPED_TRACE(testing::Message() << plan.tracer->info().name << " " << name(plan.space) << " "
                                    << name(plan.domain) << " seed " << plan.seed << " execution "
                                    << campaign.executions() << '\n'
                                    << explain(input.triangle, ray_of(input)));
    const Examination e = examiner.examine(input.triangle, ray_of(input));
    ASSERT_NO_FATAL_FAILURE(judge_again(e, plan.tracer->info().contract, sum));
  }
  sum.executions += campaign.executions();
  sum.disagreements += judged;
  EXPECT_EQ(judged, wanted);
}

}  // namespace

void rejudge(std::string_view tracer, std::uint64_t seed, std::uint64_t nominal, std::uint64_t full) {
  Rejudged sum;
  for (const Space space : {Space::ray, Space::target})
    for (const Domain domain : {Domain::nominal, Domain::full}) {
      CampaignPlan plan = plan_for(tracer, seed);
      plan.space = space;
      plan.domain = domain;
      ASSERT_NO_FATAL_FAILURE(rejudge(plan, domain == Domain::nominal ? nominal : full, sum));
    }
  std::printf("seed %llu: %llu disagreements of %llu executions, %llu with a severity above 0: all confirmed\n",
              static_cast<unsigned long long>(seed), static_cast<unsigned long long>(sum.disagreements),
              static_cast<unsigned long long>(sum.executions), static_cast<unsigned long long>(sum.measured));
  EXPECT_GT(sum.measured, sum.disagreements / 2);
}

}  // namespace plumbline
