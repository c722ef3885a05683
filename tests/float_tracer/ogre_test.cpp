// The adapter to OGRE: its range, both sides, its widened edges, and what it refuses.
#include "float_tracer/adapters/ogre.h"

#include <gtest/gtest.h>

#include "tests/float_tracer/expect_outcomes.h"
#include "tests/float_tracer/shoot.h"

namespace plumbline {
namespace {

const Triangle flat{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
const Ray down{.origin = {1, 2, 8}, .direction = {0, 0, -2}};

Outcome outcome(const Triangle& triangle, const Ray& ray) { return shoot("ogre_f32", {{triangle}}, ray).outcome; }

TEST(Ogre, GivesTAndTheNearestTriangle) {
  const Triangle far{{0, 0, -4}, {4, 0, -4}, {0, 4, -4}};
  const Answer answer = shoot("ogre_f32", {{far, flat}}, down);
  ASSERT_EQ(answer.outcome, Outcome::hit);
  EXPECT_TRUE(answer.has_t && !answer.has_uv && !answer.has_segment);
  EXPECT_EQ(answer.triangle, 1u);
  EXPECT_EQ(answer.t, 4);
}

TEST(Ogre, SearchesFromTheOriginToInfinity) {
  Ray ray = down;
  ray.t_min = 5, ray.t_max = 6;  // not read
  EXPECT_EQ(outcome(flat, ray), Outcome::hit);
  EXPECT_EQ(outcome(flat, {.origin = {1, 1, 0}, .direction = {0, 0, -1}}), Outcome::hit);
  EXPECT_EQ(outcome(flat, {.origin = {1, 1, -0x1p-20}, .direction = {0, 0, -1}}), Outcome::miss);
}

TEST(Ogre, HitsFromBothSidesWithinAMillionthOfAnEdge) {
  for (const double side : {1.0, -1.0}) {
    const auto at = [&](double x, double y) {
      return outcome(flat, {.origin = {x, y, 8 * side}, .direction = {0, 0, -side}});
    };
    for (const auto& [x, y] : {std::pair(0, 0), {4, 0}, {0, 4}, {2, 0}, {2, 2}, {0, 2}})
      EXPECT_EQ(at(x, y), Outcome::hit) << x << " " << y;
    EXPECT_EQ(at(1, -0x1p-19), Outcome::hit);  // 1.9e-6 of 4
    EXPECT_EQ(at(1, -0x1p-17), Outcome::miss);
  }
}

TEST(Ogre, CallsSmallTrianglesAndShortDirectionsParallel) {
  const auto straight_on = [&](double edge, double direction) {
    return outcome({{0, 0, 0}, {edge, 0, 0}, {0, edge, 0}}, {.origin = {0, 0, 1}, .direction = {0, 0, -direction}});
  };
  EXPECT_EQ(straight_on(1, 0x1.000002p-23), Outcome::hit);
  EXPECT_EQ(straight_on(1, 0x1p-23), Outcome::miss);
  EXPECT_EQ(straight_on(0x1p-11, 1), Outcome::hit);
  EXPECT_EQ(straight_on(0x1p-12, 1), Outcome::miss);
}

TEST(Ogre, HitsWhereItsNumbersOverflow) {
  const double large = 0x1p+64;
  const Triangle huge{{0, 0, 0}, {large, 0, 0}, {0, large, large}};
  EXPECT_EQ(outcome(huge, {.origin = {-large, large, 0}, .direction = {0, -1, 1}}), Outcome::hit);  // beside
}

TEST(Ogre, FaultsOnWhatIsNotFinite) {
  expect_faults("ogre_f32", flat, down, {not_a_number, infinity, -infinity});
}

TEST(Ogre, MissesAnEmptyBag) { EXPECT_EQ(shoot("ogre_f32", {}, down).outcome, Outcome::miss); }

}  // namespace
}  // namespace plumbline
