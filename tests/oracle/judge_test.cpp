#include "oracle/judge.h"

#include <gtest/gtest.h>

#include "oracle/classify.h"

namespace plumbline {
namespace {

const Triangle unit{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
const Ray inside{{0.25, 0.25, 1}, {0, 0, -1}}, on_edge{{0.5, 0, 1}, {0, 0, -1}}, outside{{2, 2, 1}, {0, 0, -1}},
    in_plane{{-1, 0.25, 0}, {1, 0, 0}};

VerdictKind verdict(const Ray& ray, Outcome outcome, const Contract& contract = {}) {
  const Answer answer{.outcome = outcome};
  return judge(unit, ray, classify(unit, searched_ray(ray, contract)), answer, contract);
}

TEST(Judge, ComparesAnswerWithTruth) {
  EXPECT_EQ(verdict(inside, Outcome::hit), VerdictKind::correct);
  EXPECT_EQ(verdict(inside, Outcome::miss), VerdictKind::false_miss);
  EXPECT_EQ(verdict(outside, Outcome::hit), VerdictKind::false_hit);
  EXPECT_EQ(verdict(outside, Outcome::miss), VerdictKind::correct);
  EXPECT_EQ(verdict(inside, Outcome::fault), VerdictKind::fault);
}

TEST(Judge, EdgeRule) {
  EXPECT_EQ(verdict(on_edge, Outcome::miss, {.edges = EdgeRule::closed}), VerdictKind::false_miss);
  EXPECT_EQ(verdict(on_edge, Outcome::hit, {.edges = EdgeRule::open}), VerdictKind::false_hit);
  for (const auto rule : {EdgeRule::one_owner, EdgeRule::unspecified})
    for (const auto outcome : {Outcome::hit, Outcome::miss})
      EXPECT_EQ(verdict(on_edge, outcome, {.edges = rule}), VerdictKind::unspecified);
}

TEST(Judge, EndsOfTheRange) {
  Ray ends = inside;
  ends.t_max = 1;
  EXPECT_EQ(verdict(ends, Outcome::miss), VerdictKind::false_miss);
  EXPECT_EQ(verdict(ends, Outcome::hit, {.t_max = EndRule::open}), VerdictKind::false_hit);
  EXPECT_EQ(verdict(ends, Outcome::hit, {.t_max = EndRule::unspecified}), VerdictKind::unspecified);
  EXPECT_EQ(verdict(ends, Outcome::hit, {.t_min = EndRule::open}), VerdictKind::correct);
  ends.t_max = 0.5;
  EXPECT_EQ(verdict(ends, Outcome::hit), VerdictKind::false_hit);
}

TEST(Judge, ATracerThatDoesNotReadTheRange) {
  Ray short_ray = inside, behind = inside;
  short_ray.t_max = 0.5;
  behind.origin.z = -1;
  EXPECT_EQ(verdict(short_ray, Outcome::hit, {.range = RangeRule::ray}), VerdictKind::correct);
  EXPECT_EQ(verdict(behind, Outcome::hit, {.range = RangeRule::ray}), VerdictKind::false_hit);
  EXPECT_EQ(verdict(behind, Outcome::miss, {.range = RangeRule::line}), VerdictKind::false_miss);
}

TEST(Judge, OpenWinsOverUnspecified) {
  Ray ends = on_edge;
  ends.t_max = 1;
  EXPECT_EQ(verdict(ends, Outcome::hit, {.edges = EdgeRule::unspecified, .t_max = EndRule::open}), VerdictKind::false_hit);
}

TEST(Judge, CoplanarContactByTheContract) {
  EXPECT_EQ(verdict(in_plane, Outcome::hit, {.coplanar = TouchRule::miss}), VerdictKind::false_hit);
  EXPECT_EQ(verdict(in_plane, Outcome::miss, {.coplanar = TouchRule::hit}), VerdictKind::false_miss);
  EXPECT_EQ(verdict(in_plane, Outcome::hit, {.coplanar = TouchRule::unspecified}), VerdictKind::unspecified);
  Ray beside = in_plane;
  beside.origin.y = 2;
  EXPECT_EQ(verdict(beside, Outcome::hit, {.coplanar = TouchRule::hit}), VerdictKind::false_hit);
}

TEST(Judge, Culling) {
  const Ray from_below{{0.25, 0.25, -1}, {0, 0, 1}};
  EXPECT_EQ(verdict(from_below, Outcome::miss, {.culling = Culling::back}), VerdictKind::correct);
  EXPECT_EQ(verdict(from_below, Outcome::hit, {.culling = Culling::back}), VerdictKind::false_hit);
  EXPECT_EQ(verdict(inside, Outcome::miss, {.culling = Culling::back}), VerdictKind::false_miss);
  EXPECT_EQ(verdict(inside, Outcome::miss, {.culling = Culling::front}), VerdictKind::correct);
  EXPECT_EQ(verdict(from_below, Outcome::hit, {.culling = Culling::back, .slack_absolute = 8}), VerdictKind::false_hit);
}

TEST(Judge, SlackExcusesAHitAndNoFurther) {
  const Ray near{{0.5, -0x1p-10, 1}, {0, 0, -1}};
  EXPECT_EQ(verdict(near, Outcome::hit), VerdictKind::false_hit);
  EXPECT_EQ(verdict(near, Outcome::hit, {.slack_absolute = 0x1p-10}), VerdictKind::correct);
  EXPECT_EQ(verdict(near, Outcome::hit, {.slack_absolute = 0x1.fffffffffffffp-11}), VerdictKind::false_hit);
  EXPECT_EQ(verdict(near, Outcome::hit, {.slack_relative = 0x1p-10}), VerdictKind::correct);
  EXPECT_EQ(verdict(near, Outcome::miss, {.slack_absolute = 1}), VerdictKind::correct);
  EXPECT_EQ(verdict(inside, Outcome::miss, {.slack_absolute = 1}), VerdictKind::false_miss);
}

TEST(Judge, SlackExcusesWhatIsNearerToo) {
  // Exactly on an open edge, at an open end, in the plane: no farther away than rays that slack excuses.
  Ray at_end = inside;
  at_end.t_max = 1;
  EXPECT_EQ(verdict(on_edge, Outcome::hit, {.edges = EdgeRule::open, .slack_absolute = 0x1p-10}), VerdictKind::correct);
  EXPECT_EQ(verdict(at_end, Outcome::hit, {.t_max = EndRule::open, .slack_absolute = 0x1p-10}), VerdictKind::correct);
  EXPECT_EQ(verdict(in_plane, Outcome::hit, {.slack_absolute = 0x1p-10}), VerdictKind::correct);
  EXPECT_EQ(verdict(on_edge, Outcome::hit, {.edges = EdgeRule::open}), VerdictKind::false_hit);
}

TEST(Judge, SlackHoldsForTheSearchedRange) {
  // The ray's own range ends before the plane, but the tracer doesn't read it: what is judged is [0, inf).
  const Ray near{{0.5, -0x1p-10, 1}, {0, 0, -1}, 0, 0.5};
  EXPECT_EQ(verdict(near, Outcome::hit, {.range = RangeRule::ray, .slack_absolute = 0x1p-10}), VerdictKind::correct);
  EXPECT_EQ(verdict(near, Outcome::hit, {.range = RangeRule::given, .slack_absolute = 0x1p-10}), VerdictKind::false_hit);
}

TEST(Judge, InvalidInputIsNobodysError) {
  const Ray zero{{0, 0, 1}, {0, 0, 0}};
  EXPECT_EQ(verdict(zero, Outcome::hit), VerdictKind::unspecified);
  EXPECT_EQ(verdict(zero, Outcome::miss), VerdictKind::unspecified);
}

}  // namespace
}  // namespace plumbline
