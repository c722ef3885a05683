// The adapter to Bullet: which segment it asks, what it refuses, and what Bullet makes of the edges of its contract.
#include "float_tracer/adapters/bullet.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/float_tracer/expect_contract.h"
#include "tests/float_tracer/shoot.h"

namespace plumbline {
namespace {

const Triangle flat{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
const Ray down{.origin = {1, 2, 8}, .direction = {0, 0, -2}};

Outcome outcome(const Triangle& triangle, const Ray& ray) {
  return shoot("bullet_f32", {.triangles = {triangle}}, ray).outcome;
}

Query asked(const Ray& ray) { return tracer_named("bullet_f32").prepare({.triangles = {flat}})->asked(ray); }

TEST(Bullet, Contract) {
  expect_contract("bullet_f32", {.precision = Precision::binary32,
                                 .t_min = EndRule::unspecified,
                                 .t_max = EndRule::unspecified,
                                 .coplanar = TouchRule::unspecified,
                                 .degenerate = TouchRule::unspecified,
                                 .slack_relative = 2e-4});
  EXPECT_EQ(tracer_named("bullet_f32").info().package.substr(0, 17), "libbullet-dev 3.2");
  EXPECT_TRUE(tracer_named("bullet_f32").info().own_queries);
}

TEST(Bullet, GivesTOfTheSegmentAndTheNearestTriangle) {
  const Triangle far{{0, 0, -4}, {4, 0, -4}, {0, 4, -4}};
  for (const auto& [triangles, index] :
       {std::pair(std::vector{far, flat}, 1u), std::pair(std::vector{flat, far}, 0u)}) {
    const Answer answer = shoot("bullet_f32", {.triangles = triangles}, down);
    ASSERT_EQ(answer.outcome, Outcome::hit);
    EXPECT_TRUE(answer.has_t && !answer.has_uv && !answer.has_segment);
    EXPECT_EQ(answer.triangle, index);
    EXPECT_EQ(answer.t, 0.25);  // 8 of 32
  }
}

// 2^k * 2 >= 4 * 8 for k = 4.
TEST(Bullet, AsksForASegmentThatGoesPastTheBag) {
  EXPECT_EQ(asked(down), (Query(Ray{{1, 2, 8}, {0, 0, -32}, 0, 1})));
  Ray ray = down;
  ray.t_min = 1, ray.t_max = 5;
  EXPECT_EQ(asked(ray), (Query(Ray{{1, 2, 6}, {0, 0, -8}, 0, 1})));
}

// The end point is rounded to float, and what the rounding does to the direction is told to the last bit.
TEST(Bullet, TellsTheRoundedEndExactly) {
  const double x = 0x1.000002p+0, dx = 0x1.000002p-30;
  const Query query = asked({.origin = {x, 2, 8}, .direction = {dx, 0x1p-100, -2}});
  EXPECT_EQ(query.ray.origin, (Vec3{x, 2, 8}));
  EXPECT_EQ(query.ray.direction.x + query.direction_tail.x, static_cast<float>(x + 16 * dx) - x);
  EXPECT_EQ(query.ray.direction.y, 0);
  const Query tail = asked({.origin = {0x1p-60, 2, 8}, .direction = {1, 0, -2}});
  EXPECT_EQ(tail.ray.direction.x, 16);
  EXPECT_EQ(tail.direction_tail.x, -0x1p-60);
}

TEST(Bullet, HitsEdgesAndVerticesFromBothSides) {
  for (const double side : {1.0, -1.0})
    for (const auto& [x, y] : {std::pair(2, 0), {2, 2}, {0, 2}, {0, 0}, {4, 0}, {0, 4}})
      EXPECT_EQ(outcome(flat, {.origin = {x * 1.0, y * 1.0, side}, .direction = {0, 0, -side}}), Outcome::hit)
          << x << ' ' << y << ' ' << side;
}

// 1e-4 of the altitude, which here is 4.
TEST(Bullet, WidensTheTriangleByItsTolerance) {
  const auto beside = [](double y) { return outcome(flat, {.origin = {2, y, 1}, .direction = {0, 0, -1}}); };
  EXPECT_EQ(beside(-3.9e-4f), Outcome::hit);
  EXPECT_EQ(beside(-4.1e-4f), Outcome::miss);
}

TEST(Bullet, ReadsTheRange) {
  Ray ray = down;
  for (const auto& [t_min, t_max, expected] :
       {std::tuple(0.0, 3.5, Outcome::miss), std::tuple(4.5, infinity, Outcome::miss),
        std::tuple(3.0, 5.0, Outcome::hit), std::tuple(-infinity, infinity, Outcome::hit),
        std::tuple(-infinity, 5.0, Outcome::hit), std::tuple(-infinity, 3.5, Outcome::miss),
        std::tuple(4.0, 4.0, Outcome::fault), std::tuple(5.0, 3.0, Outcome::fault),
        std::tuple(infinity, infinity, Outcome::fault), std::tuple(not_a_number, 9.0, Outcome::fault),
        std::tuple(0.0, not_a_number, Outcome::fault)}) {
    ray.t_min = t_min, ray.t_max = t_max;
    EXPECT_EQ(outcome(flat, ray), expected) << t_min << ' ' << t_max;
  }
  ray = {.origin = {1, 2, -8}, .direction = {0, 0, -2}};
  EXPECT_EQ(outcome(flat, ray), Outcome::miss);  // behind
  ray.t_min = -infinity;
  EXPECT_EQ(outcome(flat, ray), Outcome::hit);
}

TEST(Bullet, MissesWhereAnEndLiesOnThePlane) {
  EXPECT_EQ(outcome(flat, {.origin = {1, 2, 0}, .direction = {0, 0, -2}}), Outcome::miss);
  EXPECT_EQ(outcome(flat, {.origin = {1, 2, 8}, .direction = {0, 0, -2}, .t_max = 4}), Outcome::miss);
}

TEST(Bullet, FaultsOnWhatHasNoSegment) {
  for (const double bad : {not_a_number, infinity, -infinity})
    for (std::size_t i = 0; i < 6; ++i) {
      Ray spoilt = down;
      *coordinates(spoilt)[i] = bad;
      EXPECT_EQ(outcome(flat, spoilt), Outcome::fault) << "ray coordinate " << i << " = " << bad;
    }
  EXPECT_EQ(outcome(flat, {.origin = {1, 2, 8}, .direction = {0, 0, 0}}), Outcome::fault);
  EXPECT_EQ(outcome(flat, {.origin = {1, 2, 0x1p+127}, .direction = {0, 0, -1}}), Outcome::fault);
}

TEST(Bullet, MissesAnEmptyBag) { EXPECT_EQ(shoot("bullet_f32", {}, down).outcome, Outcome::miss); }

}  // namespace
}  // namespace plumbline
