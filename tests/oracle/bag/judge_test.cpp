#include "oracle/bag/judge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "case/bag_families.h"
#include "oracle/bag/scene.h"
#include "oracle/judge.h"

namespace plumbline {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double root_of_an_eighth = 0x1.6a09e667f3bcdp-2;

// The unit square, cut along x + y = 1; its front is above. A second one lies below it.
const std::vector<Triangle> square = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{1, 1, 0}, {0, 1, 0}, {1, 0, 0}}};
const std::vector<Triangle> two_squares = {
    square[0], square[1], {{0, 0, -1}, {1, 0, -1}, {0, 1, -1}}, {{1, 1, -1}, {0, 1, -1}, {1, 0, -1}}};
// Four triangles around its middle.
const std::vector<Triangle> fan = {{{0.5, 0.5, 0}, {0, 0, 0}, {1, 0, 0}},
                                   {{0.5, 0.5, 0}, {1, 0, 0}, {1, 1, 0}},
                                   {{0.5, 0.5, 0}, {1, 1, 0}, {0, 1, 0}},
                                   {{0.5, 0.5, 0}, {0, 1, 0}, {0, 0, 0}}};
// Its faces go counter-clockwise seen from outside.
const std::vector<Triangle> tetrahedron = {{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}},
                                           {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}},
                                           {{0, 0, 0}, {0, 0, 1}, {0, 1, 0}},
                                           {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

Ray down(double x, double y, double step = 1) { return {.origin = {x, y, 1}, .direction = {0, 0, -step}}; }

Contract with(EdgeRule rule) {
  Contract c;
  c.edges = rule;
  return c;
}

Answer hit(std::uint32_t triangle, double t = 1) {
  return {.outcome = Outcome::hit, .has_t = true, .triangle = triangle, .t = t};
}
std::vector<Answer> hits(std::initializer_list<std::uint32_t> triangles) {
  std::vector<Answer> list;
  for (const std::uint32_t triangle : triangles) list.push_back(hit(triangle));
  return list;
}

struct Asked {
  Asked(const std::vector<Triangle>& triangles, const Ray& ray, const Contract& c = {})
      : bag(triangles), query(searched_ray(ray, c)), truth(bag_truth(bag, query)), contract(c) {}
  BagQuestion question() const { return {bag, query, truth, contract}; }
  BagJudgement nearest(const Answer& answer) const { return judge_nearest(question(), answer); }
  BagJudgement all(std::initializer_list<std::uint32_t> triangles) const {
    return judge_hits(question(), hits(triangles));
  }
  BagJudgement parity(std::initializer_list<std::uint32_t> triangles) const {
    return judge_parity(question(), hits(triangles));
  }

  std::vector<Triangle> bag;
  Query query;
  BagTruth truth;
  Contract contract;
};

void expect(const BagJudgement& judgement, BagVerdict verdict, double length, double ulps, int line) {
  EXPECT_EQ(name(judgement.verdict), name(verdict)) << "line " << line;
  EXPECT_EQ(judgement.length, length) << "line " << line;
  EXPECT_EQ(judgement.ulps, ulps) << "line " << line;
}
#define EXPECT_VERDICT(judgement, kind) EXPECT_EQ(name((judgement).verdict), name(BagVerdict::kind))
#define EXPECT_JUDGEMENT(judgement, kind, length, ulps) expect(judgement, BagVerdict::kind, length, ulps, __LINE__)

TEST(BagJudge, InsideOfATriangle) {
  const Asked q(square, down(0.25, 0.25));
  EXPECT_JUDGEMENT(q.nearest(hit(0)), correct, 0, 0);
  EXPECT_JUDGEMENT(q.nearest({}), leak, 0x1p-2, 0x1p+50);
  EXPECT_JUDGEMENT(q.nearest(hit(1)), wrong_nearest, root_of_an_eighth, std::ldexp(root_of_an_eighth, 52));
  EXPECT_JUDGEMENT(q.all({0}), correct, 0, 0);
  EXPECT_JUDGEMENT(q.all({}), leak, 0x1p-2, 0x1p+50);
  EXPECT_JUDGEMENT(q.all({0, 1}), double_hit, root_of_an_eighth, std::ldexp(root_of_an_eighth, 52));
  EXPECT_JUDGEMENT(q.all({1}), wrong_nearest, root_of_an_eighth, std::ldexp(root_of_an_eighth, 52));
}

TEST(BagJudge, UlpsAreOfTheContractsPrecision) {
  Contract narrow;
  narrow.precision = Precision::binary32;
  EXPECT_JUDGEMENT(Asked(square, down(0.25, 0.25), narrow).nearest({}), leak, 0x1p-2, 0x1p+21);
}

TEST(BagJudge, WhereNothingIs) {
  const Asked q(square, down(2, 0));
  EXPECT_JUDGEMENT(q.nearest({}), correct, 0, 0);
  EXPECT_JUDGEMENT(q.nearest(hit(0)), false_hit, 1, 0x1p+51);
  EXPECT_JUDGEMENT(q.all({}), correct, 0, 0);
  EXPECT_JUDGEMENT(q.all({0}), false_hit, 1, 0x1p+51);
  EXPECT_JUDGEMENT(q.all({0, 1}), false_hit, 1, 0x1p+51);
}

TEST(BagJudge, AHitWithoutTNamesNoTriangle) {
  const Answer something{.outcome = Outcome::hit, .triangle = 1};
  EXPECT_VERDICT(Asked(square, down(0.25, 0.25)).nearest(something), correct);
  EXPECT_VERDICT(Asked(square, down(0.5, 0.5), with(EdgeRule::unspecified)).nearest(something), unspecified);
  EXPECT_JUDGEMENT(Asked(square, down(2, 0)).nearest(something), false_hit, 1, 0x1p+51);
  EXPECT_JUDGEMENT(Asked(square, down(0, 3)).nearest(something), false_hit, 2, 0x1p+52);
}

TEST(BagJudge, OnASharedEdge) {
  const Ray on_edge = down(0.5, 0.5);
  const Asked closed(square, on_edge);
  EXPECT_JUDGEMENT(closed.nearest({}), leak, 0, 0);
  EXPECT_VERDICT(closed.nearest(hit(0)), correct);
  EXPECT_VERDICT(closed.nearest(hit(1)), correct);
  EXPECT_JUDGEMENT(closed.all({}), leak, 0, 0);
  for (const auto& some : {hits({0}), hits({1}), hits({0, 1})})
    EXPECT_VERDICT(judge_hits(closed.question(), some), correct);

  const Asked open(square, on_edge, with(EdgeRule::open));
  EXPECT_VERDICT(open.nearest({}), correct);
  EXPECT_JUDGEMENT(open.nearest(hit(0)), false_hit, 0, 0);
  EXPECT_VERDICT(open.all({}), correct);
  EXPECT_VERDICT(open.all({1}), false_hit);

  const Asked any(square, on_edge, with(EdgeRule::unspecified));
  EXPECT_VERDICT(any.nearest({}), unspecified);
  EXPECT_VERDICT(any.nearest(hit(1)), unspecified);
  EXPECT_VERDICT(any.all({}), unspecified);
  EXPECT_VERDICT(any.all({0, 1}), unspecified);

  const Asked one(square, on_edge, with(EdgeRule::one_owner));
  EXPECT_JUDGEMENT(one.nearest({}), leak, 0, 0);
  EXPECT_VERDICT(one.nearest(hit(0)), correct);
  EXPECT_VERDICT(one.all({0}), correct);
  EXPECT_VERDICT(one.all({1}), correct);
  EXPECT_JUDGEMENT(one.all({0, 1}), double_hit, 0, 0);
  EXPECT_JUDGEMENT(one.all({}), leak, 0, 0);
}

TEST(BagJudge, OneOwnerAroundAVertex) {
  const Asked one(fan, down(0.5, 0.5), with(EdgeRule::one_owner));
  for (std::uint32_t i = 0; i < 4; ++i) EXPECT_VERDICT(one.all({i}), correct);
  EXPECT_VERDICT(one.all({0, 2}), double_hit);
  EXPECT_VERDICT(one.all({}), leak);
}

// The rim of a bag, and a fold that the ray touches and doesn't go through: one triangle or none or both may be hit.
TEST(BagJudge, OneOwnerIsSilentWhereTheRayNeedNotGoThrough) {
  const Asked rim(square, down(0.5, 0), with(EdgeRule::one_owner));
  EXPECT_VERDICT(rim.nearest({}), unspecified);
  EXPECT_VERDICT(rim.all({0}), unspecified);
  const std::vector<Triangle> fold = {square[0], {{0, 0, -1}, {0, 1, 0}, {1, 0, 0}}};
  const Asked touched(fold, down(0.5, 0.5), with(EdgeRule::one_owner));
  EXPECT_VERDICT(touched.all({}), unspecified);
  EXPECT_VERDICT(touched.all({0, 1}), unspecified);
  std::vector<Triangle> open_fan = fan;
  open_fan.pop_back();
  EXPECT_VERDICT(Asked(open_fan, down(0.5, 0.5), with(EdgeRule::one_owner)).all({}), unspecified);
}

TEST(BagJudge, SlackExcusesHitsAlone) {
  Contract wide;
  wide.slack_absolute = 0.5;
  const Asked q(square, down(0.25, 0.25), wide);
  EXPECT_VERDICT(q.all({0, 1}), correct);
  EXPECT_VERDICT(q.nearest(hit(1)), correct) << "both are at the same t";
  EXPECT_VERDICT(q.nearest({}), leak);
  EXPECT_VERDICT(Asked(square, down(2, 0), wide).nearest(hit(0)), false_hit);
}

TEST(BagJudge, TheSecondNearest) {
  const Asked q(two_squares, down(0.25, 0.25, 2));
  EXPECT_VERDICT(q.nearest(hit(0)), correct);
  EXPECT_JUDGEMENT(q.nearest(hit(2)), wrong_nearest, 1, 0x1p+52);  // t differs by half a direction of length 2
  EXPECT_VERDICT(q.all({0, 2}), correct);
  EXPECT_JUDGEMENT(q.all({2}), leak, 0x1p-2, 0x1p+50);  // of the upper one
  EXPECT_JUDGEMENT(q.all({0}), leak, 0x1p-2, 0x1p+50);  // of the lower one
}

// A nearer triangle that may be missed doesn't take the place of one that must be hit, nor is it wrong to report it.
TEST(BagJudge, WhatMayBeHitInFrontOfWhatMust) {
  std::vector<Triangle> bag = two_squares;
  bag[2].c = {-1, 1, -1};
  bag[3] = {{1, 1, -1}, {-1, 1, -1}, {1, 0, -1}};
  const Asked q(bag, down(0.5, 0.5), with(EdgeRule::unspecified));
  ASSERT_EQ(q.truth.hits.size(), 3u);
  const std::uint32_t lower = q.truth.hits[2].triangle;
  EXPECT_VERDICT(q.nearest(hit(lower)), correct);
  EXPECT_VERDICT(q.nearest(hit(0)), unspecified);
  EXPECT_VERDICT(q.nearest({}), leak);
}

TEST(BagJudge, CulledSidesAreNotThere) {
  Contract c;
  c.culling = Culling::front;
  const Asked q(square, down(0.25, 0.25), c);
  EXPECT_VERDICT(q.nearest({}), correct);
  EXPECT_JUDGEMENT(q.nearest(hit(0)), false_hit, 0, 0);
}

TEST(BagJudge, CoplanarContactIsAsTheContractSays) {
  const Ray along{.origin = {-1, 0.25, 0}, .direction = {1, 0, 0}};
  Contract c;
  c.coplanar = TouchRule::miss;
  EXPECT_VERDICT(Asked(square, along, c).nearest({}), correct);
  EXPECT_VERDICT(Asked(square, along, c).nearest(hit(0)), false_hit);
  c.coplanar = TouchRule::unspecified;
  EXPECT_VERDICT(Asked(square, along, c).nearest({}), unspecified);
  EXPECT_VERDICT(Asked(square, along, c).all({1}), unspecified);
  c.coplanar = TouchRule::hit;
  EXPECT_VERDICT(Asked(square, along, c).nearest({}), leak);
  EXPECT_VERDICT(Asked(square, along, c).nearest(hit(0)), correct);
  EXPECT_VERDICT(Asked(square, along, c).all({0}), leak);
  EXPECT_VERDICT(Asked(square, along, c).all({0, 1}), correct);
}

TEST(BagJudge, OrderOfHits) {
  const Asked q(two_squares, down(0.25, 0.25));
  const auto order = [&](double upper, double lower) {
    return judge_order(q.question(), std::vector{hit(2, lower), hit(0, upper)});
  };
  EXPECT_JUDGEMENT(order(1, 2), correct, 0, 0);
  EXPECT_JUDGEMENT(order(1.5, 1.5), correct, 0, 0);
  EXPECT_JUDGEMENT(order(2, 1), wrong_order, 1, 0x1p+52);
}

TEST(BagJudge, ParityOfAClosedBag) {
  const Asked through(tetrahedron, down(0.25, 0.25));
  ASSERT_EQ(through.truth.crossings(), 2u);
  EXPECT_VERDICT(through.parity({0, 3}), correct);
  EXPECT_VERDICT(through.parity({}), correct) << "even; what is lost is for judge_hits";
  EXPECT_JUDGEMENT(through.parity({3}), wrong_parity, 0x1p-2, 0x1p+50);
  EXPECT_VERDICT(through.parity({0, 1, 3}), wrong_parity);
  Ray from_inside = down(0.25, 0.25);
  from_inside.origin.z = 0.25;
  const Asked out(tetrahedron, from_inside);
  EXPECT_VERDICT(out.parity({0}), correct);
  EXPECT_VERDICT(out.parity({}), wrong_parity);

  const Ray at_edge{.origin = {0.25, 0.25, -1}, .direction = {0.25, 0.25, 1}};  // leaves through (1/2, 1/2, 0)
  ASSERT_EQ(Asked(tetrahedron, at_edge).truth.hits.size(), 2u);
  EXPECT_VERDICT(Asked(tetrahedron, at_edge).parity({0}), unspecified) << "closed edges are hit by one or two";
}

TEST(BagJudge, ParityWithOneOwner) {
  // In by the edge from (0,0,0) to (1,0,0), out inside of the slanted face.
  const Ray in{.origin = {0.25, -1, -1}, .direction = {0, 1, 1}};
  const Asked one(tetrahedron, in, with(EdgeRule::one_owner));
  ASSERT_EQ(one.truth.hits.size(), 3u);
  EXPECT_VERDICT(one.parity({0, 3}), correct);
  EXPECT_VERDICT(one.parity({0, 1, 3}), wrong_parity);
  EXPECT_VERDICT(Asked(tetrahedron, in).parity({0, 1, 3}), unspecified);
}

TEST(BagJudge, ParityIsSilent) {
  Contract c;
  c.slack_absolute = 0.125;
  EXPECT_VERDICT(Asked(tetrahedron, down(0.25, 0.25), c).parity({3}), unspecified);
  c = {};
  c.culling = Culling::back;
  EXPECT_VERDICT(Asked(tetrahedron, down(0.25, 0.25), c).parity({3}), unspecified);
  Ray on_face = down(0.25, 0.25);
  on_face.origin.z = 0;
  EXPECT_VERDICT(Asked(tetrahedron, on_face).parity({}), unspecified);
}

TEST(BagJudge, Segments) {
  const Asked q(tetrahedron, down(0.25, 0.25, 2));
  const auto judged = [&](std::vector<RaySegment> answered, std::vector<RaySegment> exact, double leeway) {
    return judge_segments(q.question(), answered, exact, leeway);
  };
  EXPECT_JUDGEMENT(judged({{1, 2}}, {{1, 2}}, 0), correct, 0, 0);
  EXPECT_JUDGEMENT(judged({{1, 2}}, {{1, 2.5}}, 0.5), wrong_thickness, 1, 0x1p+52);
  EXPECT_JUDGEMENT(judged({{1, 2}}, {{1, 2.5}}, 1), correct, 0, 0);
  EXPECT_JUDGEMENT(judged({}, {{1, 2}}, 0), wrong_thickness, 2, 0x1p+53);
  EXPECT_JUDGEMENT(judged({{1, 2}, {2, 3}}, {{1, 3}}, 0), correct, 0, 0);
  EXPECT_JUDGEMENT(judged({{1, 1}}, {}, 0), correct, 0, 0);
  EXPECT_JUDGEMENT(judged({{0, 1}}, {{1, 2}}, 0), wrong_thickness, 2, 0x1p+53);
  EXPECT_JUDGEMENT(judged({{0, 1}, {2, 2.25}}, {{0, 1}}, 0.25), wrong_thickness, 0x1p-1, 0x1p+51);
  EXPECT_JUDGEMENT(judged({{0, infinity}}, {{0, infinity}}, 0), correct, 0, 0);
  EXPECT_JUDGEMENT(judged({{0, infinity}}, {{0, 1}}, 1e9), wrong_thickness, infinity, infinity);
  EXPECT_JUDGEMENT(judged({{std::nan(""), 1}}, {{0, 1}}, 1e9), wrong_thickness, infinity, infinity);
}

TEST(BagJudge, WhatCullingLost) {
  const BagTruth truth = Asked(two_squares, down(0.25, 0.25)).truth;
  EXPECT_TRUE(lost_by_culling({BagVerdict::leak}, truth, {}, hits({2})));
  EXPECT_FALSE(lost_by_culling({BagVerdict::leak}, truth, {}, hits({1})));
  EXPECT_FALSE(lost_by_culling({BagVerdict::leak}, truth, {}, {}));
  EXPECT_FALSE(lost_by_culling({BagVerdict::correct}, truth, hit(0), hits({0})));
  const auto nearest = [&](double alone) {
    return lost_by_culling({BagVerdict::wrong_nearest}, truth, hit(2, 2), std::vector{hit(0, alone), hit(2, 2)});
  };
  EXPECT_TRUE(nearest(1));
  EXPECT_FALSE(nearest(2)) << "by its own numbers the other is as near";
  EXPECT_FALSE(lost_by_culling({BagVerdict::wrong_nearest}, truth, hit(2, 2), hits({2})));
}

TEST(BagJudge, FaultsAndNonsense) {
  const Asked q(square, down(0.25, 0.25));
  EXPECT_VERDICT(q.nearest({.outcome = Outcome::fault}), fault);
  EXPECT_VERDICT(q.nearest(hit(2)), fault);
  EXPECT_VERDICT(q.all({0, 7}), fault);
  EXPECT_VERDICT(Asked(square, down(std::nan(""), 0)).nearest({}), unspecified);
  EXPECT_VERDICT(Asked({}, down(0, 0)).nearest({}), correct);
}

// Rays through a shared edge or vertex are hits exactly, of all families and ways to aim; the truth itself is never
// judged wrong.
TEST(BagJudge, TruthIsRight) {
  for (std::size_t f = 0; f < bag_family_names.size(); ++f)
    for (const BagTarget target : {BagTarget::edge, BagTarget::vertex, BagTarget::face})
      for (const BagOrigin origin : {BagOrigin::outside, BagOrigin::inside, BagOrigin::grazing})
        for (const int bits : {8, 24, 53})
          for (std::uint64_t index = 0; index < 8; ++index) {
            const auto family = static_cast<BagFamily>(f);
            const BagAim aim{.target = target, .origin = origin, .precision = Precision::binary64, .bits = bits};
            const AimedBag bag = draw(family, aim, 4, 1, family == BagFamily::lattice ? index * 13001 : index);
            const Scene scene(bag.triangles);
            for (const Ray& ray : bag.rays) {
              SCOPED_TRACE(testing::Message() << name(family) << ' ' << static_cast<int>(target) << ' '
                                              << static_cast<int>(origin) << ' ' << bits << ' ' << index);
              const Query query = ray;
              const BagTruth truth = scene.truth(query);
              const bool met =
                  std::ranges::any_of(truth.hits, [](const BagHit& h) { return h.t == 1; }) ||
                  std::ranges::any_of(truth.stretches, [](const Stretch& s) { return s.low <= 1 && 1 <= s.high; });
              EXPECT_TRUE(met) << "it goes through what it is aimed at";
              for (const EdgeRule rule : {EdgeRule::closed, EdgeRule::one_owner, EdgeRule::open}) {
                const Contract contract = with(rule);
                const BagQuestion question{bag.triangles, query, truth, contract};
                std::vector<Answer> answers;
                for (const BagHit& h : truth.hits)
                  if (rule == EdgeRule::closed || h.truth.hit_class == HitClass::interior ||
                      (rule == EdgeRule::one_owner && h.owner))
                    answers.push_back(hit(h.triangle, h.t));
                const BagVerdict all = judge_hits(question, answers).verdict;
                EXPECT_TRUE(all == BagVerdict::correct || all == BagVerdict::unspecified) << name(all);
                const BagVerdict first = judge_nearest(question, answers.empty() ? Answer{} : answers.front()).verdict;
                EXPECT_TRUE(first == BagVerdict::correct || first == BagVerdict::unspecified) << name(first);
                EXPECT_VERDICT(judge_order(question, answers), correct);
                const BagVerdict parity = bag.closed ? judge_parity(question, answers).verdict : BagVerdict::correct;
                EXPECT_TRUE(parity == BagVerdict::correct || parity == BagVerdict::unspecified) << name(parity);
              }
            }
          }
}

// What a contract forbids is wrong though it is the nearest.
TEST(JudgeNearest, AHitThatTheContractForbids) {
  const std::vector<Triangle> both_ways = {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 0, 0}, {0, 4, 0}, {4, 0, 0}}};
  Contract culls;
  culls.culling = Culling::back;
  const Asked two(both_ways, down(1, 1), culls);
  EXPECT_EQ(two.nearest(hit(0)).verdict, BagVerdict::correct);
  EXPECT_EQ(two.nearest(hit(1)).verdict, BagVerdict::wrong_nearest);
  EXPECT_FALSE(two.nearest(hit(1)).behind);
  const std::vector<Triangle> corner = {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{1, 1, 0}, {5, 1, 0}, {1, 5, 0}}};
  const Asked open(corner, down(1, 1), with(EdgeRule::open));
  EXPECT_EQ(open.nearest(hit(0)).verdict, BagVerdict::correct);
  EXPECT_EQ(open.nearest(hit(1)).verdict, BagVerdict::wrong_nearest);
}

// A triangle in the ray's plane, in front of a wall or behind it.
TEST(JudgeNearest, ATouchThatMustBeHit) {
  const std::vector<Triangle> before = {{{-5, -1, 0}, {-3, -1, 0}, {-4, 2, 0}}, {{2, -1, -1}, {2, 2, -1}, {2, 0, 3}}};
  const std::vector<Triangle> after = {{{5, -1, 0}, {7, -1, 0}, {6, 2, 0}}, before[1]};
  const Ray along{.origin = {-10, 0, 0}, .direction = {1, 0, 0}};
  Contract c;
  c.coplanar = TouchRule::hit;
  EXPECT_EQ(Asked(before, along, c).nearest(hit(0, 6)).verdict, BagVerdict::correct);
  const BagJudgement passed = Asked(before, along, c).nearest(hit(1, 12));
  EXPECT_EQ(passed.verdict, BagVerdict::wrong_nearest);
  EXPECT_TRUE(passed.behind);
  EXPECT_EQ(Asked(before, along, c).nearest({}).verdict, BagVerdict::leak);
  EXPECT_EQ(Asked(after, along, c).nearest(hit(1, 12)).verdict, BagVerdict::correct);
  for (const TouchRule rule : {TouchRule::hit, TouchRule::unspecified}) {
    c.coplanar = rule;
    const BagJudgement late = Asked(after, along, c).nearest(hit(0, 15));
    EXPECT_EQ(late.verdict, BagVerdict::wrong_nearest);
    EXPECT_TRUE(late.behind);
  }
  c.coplanar = TouchRule::unspecified;
  EXPECT_EQ(Asked(before, along, c).nearest(hit(0, 6)).verdict, BagVerdict::unspecified);
  EXPECT_EQ(Asked(before, along, c).nearest(hit(1, 12)).verdict, BagVerdict::correct);
}

// Where an edge may be hit or not, what is due lies behind it.
TEST(JudgeNearest, SaysWhatWasDue) {
  const std::vector<Triangle> bag = {
      {{0, 0, 1}, {4, 0, 1}, {0, 4, 1}}, {{-9, -9, 0}, {9, -9, 0}, {0, 9, 0}}, {{-9, -9, -1}, {9, -9, -1}, {0, 9, -1}}};
  const Asked asked(bag, Ray{.origin = {1, 0, 2}, .direction = {0, 0, -1}}, with(EdgeRule::unspecified));
  const BagJudgement leak = asked.nearest({});
  EXPECT_EQ(leak.verdict, BagVerdict::leak);
  EXPECT_EQ(leak.due, HitClass::interior);
  EXPECT_EQ(leak.due_rank, 1u);
  EXPECT_EQ(asked.nearest(hit(0, 1)).verdict, BagVerdict::unspecified);
  const BagJudgement third = asked.nearest(hit(2, 3));
  EXPECT_EQ(third.verdict, BagVerdict::wrong_nearest);
  EXPECT_TRUE(third.behind);
  EXPECT_TRUE(lost_by_culling(third, asked.truth, hit(2, 3), std::vector{hit(1, 2)}));
  EXPECT_FALSE(lost_by_culling(third, asked.truth, hit(2, 3), std::vector{hit(0, 1)}));
  // A culled triangle in front is no hit, and not behind anything.
  Contract culls;
  culls.culling = Culling::back;
  const std::vector<Triangle> away = {{{-9, -9, 1}, {0, 9, 1}, {9, -9, 1}}, bag[1]};
  const BagJudgement front = Asked(away, down(0, 0), culls).nearest(hit(0, 0));
  EXPECT_EQ(front.verdict, BagVerdict::wrong_nearest);
  EXPECT_FALSE(front.behind);
}

TEST(JudgeHits, ATriangleTwiceIsADoubleHit) {
  EXPECT_EQ(Asked(square, down(0.25, 0.25)).all({0, 0}).verdict, BagVerdict::double_hit);
  EXPECT_EQ(Asked(square, down(0.25, 0.25)).all({0}).verdict, BagVerdict::correct);
}

}  // namespace
}  // namespace plumbline
