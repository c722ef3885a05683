// One case asked and judged: what is measured of the answer, in which units, and what isn't.
#include "analysis/examine.h"

#include <gtest/gtest.h>

#include <limits>

#include "analysis/tracers.h"
#include "tests/analysis/fixed_tracer.h"

namespace plumbline {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
// The largest coordinate is 8, whose ulp is 2^-49 (binary64), 2^-20 (binary32).
const Triangle flat{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
Ray down(double x, double y) { return {.origin = {x, y, 0x1p+3}, .direction = {0, 0, -0x1p+1}}; }

Examination examine(const FixedAnswer& fixed, const Triangle& triangle, const Ray& ray,
                    const Contract& contract = {}, Measure measure = Measure::all) {
  const FixedTracer tracer(fixed, contract);
  return Examiner(tracer, measure).examine(triangle, ray);
}

TEST(Examine, ARightAnswer) {
  const Examination e = examine({hit_at(0x1p+2, 0x1p-2, 0x1p-1)}, flat, down(1, 2));
  EXPECT_EQ(e.triangle, flat);
  EXPECT_EQ(e.query, Query(down(1, 2)));
  EXPECT_EQ(e.answer.t, 0x1p+2);
  EXPECT_EQ(e.truth.hit_class, HitClass::interior);
  EXPECT_EQ(e.verdict, VerdictKind::correct);
  EXPECT_FALSE(e.wrong());
  EXPECT_EQ(e.severity_ulps(), 0);
  EXPECT_EQ(e.displacement, 0);
  EXPECT_EQ(e.residual, 0);
  EXPECT_TRUE(e.nominal());
  EXPECT_FALSE(e.out_of_range || e.died);
}

TEST(Examine, SeverityIsInUlpsOfTheLargestCoordinate) {
  const Examination hit = examine({a_hit}, flat, down(1, -0x1p-12));
  EXPECT_EQ(hit.verdict, VerdictKind::false_hit);
  EXPECT_DOUBLE_EQ(hit.severity_ulps(), 0x1p+37);
  const Examination miss = examine({a_miss}, flat, down(1, 0x1p-12));
  EXPECT_EQ(miss.verdict, VerdictKind::false_miss);
  EXPECT_DOUBLE_EQ(miss.severity_ulps(), 0x1p+37);
  const Contract binary32{.precision = Precision::binary32};
  EXPECT_DOUBLE_EQ(examine({a_hit}, flat, down(1, -0x1p-12), binary32).severity_ulps(), 0x1p+8);
  EXPECT_DOUBLE_EQ(examine({a_miss}, flat, down(1, 0x1p-12), binary32).severity_ulps(), 0x1p+8);
}

TEST(Examine, WhatIsWrongByConventionHasNoSeverity) {
  const Examination on_edge = examine({a_miss}, flat, down(2, 0));
  EXPECT_TRUE(on_edge.wrong());
  EXPECT_EQ(on_edge.severity_ulps(), 0);
  const Examination open = examine({a_hit}, flat, down(2, 0), {.edges = EdgeRule::open});
  EXPECT_TRUE(open.wrong());
  EXPECT_EQ(open.severity_ulps(), 0);
  const Examination culled = examine({a_hit}, flat, down(1, 1), {.culling = Culling::front});
  EXPECT_EQ(culled.verdict, VerdictKind::false_hit);
  EXPECT_EQ(culled.severity_ulps(), 0);
  Ray to_the_plane = down(1, 1);
  to_the_plane.t_max = 0x1p+2;
  EXPECT_TRUE(examine({a_miss}, flat, to_the_plane).wrong());
  EXPECT_EQ(examine({a_miss}, flat, to_the_plane).severity_ulps(), 0);
}

TEST(Examine, ContractsThatAreSilentAreNeverWrong) {
  const Examination e = examine({a_miss}, flat, down(2, 0), {.edges = EdgeRule::unspecified});
  EXPECT_EQ(e.verdict, VerdictKind::unspecified);
  EXPECT_FALSE(e.wrong());
  EXPECT_EQ(e.severity_ulps(), 0);
  EXPECT_EQ(examine({{.outcome = Outcome::fault}}, flat, down(1, 1)).verdict, VerdictKind::fault);
}

// u too large by 2^-10 is as good as a ray that is 2^-8 further along ab; v likewise along ac. In ulps of 2^-49.
TEST(Examine, DisplacementIsThatOfUAndV) {
  const auto displacement = [](double u, double v) {
    return examine({hit_at(0x1p+2, u, v)}, flat, down(1, 2)).displacement;
  };
  EXPECT_DOUBLE_EQ(displacement(0x1p-2 + 0x1p-10, 0x1p-1), 0x1p+41);
  EXPECT_DOUBLE_EQ(displacement(0x1p-2 - 0x1p-10, 0x1p-1), 0x1p+41);
  EXPECT_DOUBLE_EQ(displacement(0x1p-2, 0x1p-1 + 0x1p-11), 0x1p+40);
  EXPECT_DOUBLE_EQ(displacement(0x1p-2 + 0x1p-10, 0x1p-1 + 0x1p-11), 0x1p+41);
  for (const double bad : {inf, -inf, nan}) {
    EXPECT_EQ(displacement(bad, 0x1p-1), inf);
    EXPECT_EQ(displacement(0x1p-2, bad), inf);
  }
  EXPECT_EQ(examine({hit_at(0x1p+2)}, flat, down(1, 2)).displacement, 0);
  EXPECT_EQ(examine({a_miss}, flat, down(1, 2)).displacement, 0);
}

// t too large by 2^-10 lies 2^-9 off the plane: the direction has length 2.
TEST(Examine, ResidualIsThatOfT) {
  const auto residual = [](double t) { return examine({hit_at(t)}, flat, down(1, 2)).residual; };
  EXPECT_DOUBLE_EQ(residual(0x1p+2 + 0x1p-10), 0x1p+40);
  EXPECT_DOUBLE_EQ(residual(0x1p+2 - 0x1p-10), 0x1p+40);
  for (const double bad : {inf, -inf, nan}) EXPECT_EQ(residual(bad), inf);
  EXPECT_EQ(examine({a_hit}, flat, down(1, 2)).residual, 0);
}

TEST(Examine, NoNumbersWhereTheTruthHasNone) {
  const Ray beside{.origin = {1, 1, 8}, .direction = {1, 0, 0}};
  const Examination parallel = examine({hit_at(nan, nan, nan)}, flat, beside);
  EXPECT_EQ(parallel.truth.hit_class, HitClass::parallel);
  EXPECT_EQ(parallel.verdict, VerdictKind::false_hit);
  EXPECT_GT(parallel.severity_ulps(), 0);
  EXPECT_EQ(parallel.displacement, 0);
  EXPECT_EQ(parallel.residual, 0);
  const Examination degenerate = examine({hit_at(nan, nan, nan)}, {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, down(1, 1));
  EXPECT_FALSE(degenerate.margins.has_value());
  EXPECT_EQ(degenerate.severity_ulps(), 0);
  EXPECT_FALSE(degenerate.nominal());
  const Examination invalid = examine({a_hit}, flat, down(nan, 1));
  EXPECT_EQ(invalid.truth.hit_class, HitClass::invalid);
  EXPECT_FALSE(invalid.margins.has_value());
  EXPECT_FALSE(invalid.wrong());
}

TEST(Examine, RejectionIsAskedOfFalseMissesAlone) {
  EXPECT_EQ(examine({a_miss, Rejection::bc}, flat, down(1, 1)).rejection, Rejection::bc);
  EXPECT_EQ(examine({a_miss, Rejection::bc}, flat, down(-1, 1)).rejection, Rejection::none);
  EXPECT_EQ(examine({a_hit, Rejection::bc}, flat, down(-1, 1)).rejection, Rejection::none);
}

TEST(Examine, OutOfRangeIsTheTracers) {
  for (const int raised : {FE_OVERFLOW, FE_UNDERFLOW}) {
    const Examination e = examine({.answer = a_hit, .raised = raised}, flat, down(1, 1));
    EXPECT_TRUE(e.out_of_range);
    EXPECT_FALSE(e.nominal());
  }
  EXPECT_FALSE(
      examine({.answer = a_hit, .raised = FE_INEXACT | FE_DIVBYZERO | FE_INVALID}, flat, down(1, 1)).out_of_range);
  // What was raised before, or by the oracle's numbers, isn't.
  std::feraiseexcept(FE_OVERFLOW | FE_UNDERFLOW);
  const FixedTracer tracer({a_miss});
  Examiner examiner(tracer);
  EXPECT_FALSE(examiner.examine(flat, down(9, 9)).out_of_range);
  const Triangle huge{{0x1p+1000, 0, 0}, {0, 0x1p+1000, 0}, {0, 0, 0x1p+1000}};
  const Ray tiny{.origin = {0, 0, 0}, .direction = {-0x1p-1000, 0x1p-1060, 0x1p-1074}};
  for (int i = 0; i < 2; ++i) EXPECT_FALSE(examiner.examine(huge, tiny).out_of_range);
}

TEST(Examine, TheSearchedRangeIsTheContracts) {
  const Ray short_of_it{.origin = {1, 1, 8}, .direction = {0, 0, -2}, .t_min = 0, .t_max = 1};
  const Ray behind{.origin = {1, 1, 8}, .direction = {0, 0, 2}, .t_min = 1, .t_max = 2};
  EXPECT_EQ(examine({a_hit}, flat, short_of_it, {.range = RangeRule::given}).verdict, VerdictKind::false_hit);
  EXPECT_EQ(examine({a_hit}, flat, short_of_it, {.range = RangeRule::ray}).verdict, VerdictKind::correct);
  EXPECT_EQ(examine({a_hit}, flat, behind, {.range = RangeRule::ray}).verdict, VerdictKind::false_hit);
  const Examination line = examine({a_hit}, flat, behind, {.range = RangeRule::line});
  EXPECT_EQ(line.verdict, VerdictKind::correct);
  EXPECT_EQ(line.query.ray.t_min, -inf);
  EXPECT_EQ(line.query.ray.t_max, inf);
}

// The ray goes through the corner c; what the tracer is really asked passes it by 2^-60 of its length.
TEST(Examine, TheTruthIsThatOfWhatWasAsked) {
  const Ray to_corner{.origin = {0, 0, 8}, .direction = {0, 4, -8}};
  const auto asked = [](const Ray& ray) {
    Query query(ray);
    query.direction_tail = {-0x1p-60, 0, 0};
    return query;
  };
  const Examination e = examine({.answer = a_hit, .asked = asked}, flat, to_corner);
  EXPECT_TRUE(e.query.has_tail());
  EXPECT_EQ(e.truth.hit_class, HitClass::exterior);
  EXPECT_EQ(e.verdict, VerdictKind::false_hit);
  EXPECT_GT(e.severity_ulps(), 0);
  EXPECT_EQ(examine({a_hit}, flat, to_corner).verdict, VerdictKind::correct);
}

TEST(Examine, MarginsOfWrongAnswersAlone) {
  EXPECT_FALSE(examine({a_hit}, flat, down(1, 1), {}, Measure::wrong_answers).margins.has_value());
  const Examination wrong = examine({a_miss}, flat, down(1, 1), {}, Measure::wrong_answers);
  ASSERT_TRUE(wrong.margins.has_value());
  EXPECT_EQ(wrong.severity_ulps(), examine({a_miss}, flat, down(1, 1)).severity_ulps());
  EXPECT_EQ(wrong.truth, examine({a_miss}, flat, down(1, 1)).truth);
}

TEST(Examine, DeathsAreOfTheCaseAndAddUp) {
  const Conduct died{.disturbed = false, .deaths = {{"SIGABRT", 1}}};
  const FixedTracer tracer({.answer = {.outcome = Outcome::fault}, .conduct = died});
  Examiner examiner(tracer);
  EXPECT_TRUE(examiner.examine(flat, down(1, 1)).died);
  EXPECT_TRUE(examiner.examine(flat, down(1, 2)).died);
  EXPECT_EQ(examiner.conduct().deaths, (std::map<std::string, std::uint64_t>{{"SIGABRT", 2}}));
  EXPECT_FALSE(examine({{.outcome = Outcome::fault}}, flat, down(1, 1)).died);
}

// A real kernel: its false miss and the test that failed, the bag its own each time.
TEST(Examine, ARealKernel) {
  Examiner examiner(*tracer_named("moller_trumbore_f64"));
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(examiner.examine(flat, down(1, 1)).verdict, VerdictKind::correct);
    EXPECT_EQ(examiner.examine({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, down(1, 1)).verdict, VerdictKind::correct);
  }
  const Triangle huge{{-0x1p+600, -0x1p+600, 0}, {0x1p+600, 0, 0}, {0, 0x1p+600, 0}};
  const Examination e = examiner.examine(huge, down(0, 0));
  EXPECT_TRUE(e.out_of_range);
  EXPECT_EQ(e.verdict, VerdictKind::false_miss);
  EXPECT_NE(e.rejection, Rejection::none);
}

TEST(Examine, TheTracerIsToldWhatTheTriangleIs) {
  struct HitsPlates final : Tracer {
    HitsPlates() : Tracer({.name = "plates", .summary = "", .source = "", .contract = {}}) {}
    std::unique_ptr<PreparedBag> prepare(const Bag& bag) const override {
      return (bag.mode == BagMode::plate && bag.thickness == 0.5 ? hits : misses).prepare(bag);
    }
    FixedTracer hits{{a_hit}}, misses{{a_miss}};
  };
  const HitsPlates tracer;
  Examiner of_plates(tracer, Measure::all, {.triangles = {}, .mode = BagMode::plate, .thickness = 0.5});
  Examiner of_surfaces(tracer);
  EXPECT_EQ(of_plates.examine(flat, down(1, 2)).verdict, VerdictKind::correct);
  EXPECT_EQ(of_surfaces.examine(flat, down(1, 2)).verdict, VerdictKind::false_miss);
}

}  // namespace
}  // namespace plumbline
