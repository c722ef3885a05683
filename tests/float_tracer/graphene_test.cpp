// The adapter to graphene: what it really asks, what it refuses, and what graphene makes of the edges of its
// contract.
#include "float_tracer/adapters/graphene.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/float_tracer/expect_contract.h"
#include "tests/float_tracer/shoot.h"

namespace plumbline {
namespace {

const Triangle flat{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
const Ray down{.origin = {1, 2, 8}, .direction = {0, 0, -2}};

Outcome outcome(const Triangle& triangle, const Ray& ray) {
  return shoot("graphene_f32", {.triangles = {triangle}}, ray).outcome;
}

Query asked(const Ray& ray) { return tracer_named("graphene_f32").prepare({.triangles = {flat}})->asked(ray); }

TEST(Graphene, Contract) {
  expect_contract("graphene_f32", {.precision = Precision::binary32,
                                   .edges = EdgeRule::unspecified,
                                   .t_min = EndRule::unspecified,
                                   .t_max = EndRule::unspecified,
                                   .degenerate = TouchRule::unspecified});
  EXPECT_TRUE(tracer_named("graphene_f32").info().package.starts_with("libgraphene-1.0-dev 1."));
  EXPECT_TRUE(tracer_named("graphene_f32").info().own_queries);
}

TEST(Graphene, GivesTheDistanceAndTheNearestTriangle) {
  const Triangle far{{0, 0, -4}, {4, 0, -4}, {0, 4, -4}};
  for (const auto& [triangles, index] :
       {std::pair(std::vector{far, flat}, 1u), std::pair(std::vector{flat, far}, 0u)}) {
    const Answer answer = shoot("graphene_f32", {.triangles = triangles}, down);
    ASSERT_EQ(answer.outcome, Outcome::hit);
    EXPECT_TRUE(answer.has_t && !answer.has_uv && !answer.has_segment);
    EXPECT_EQ(answer.triangle, index);
    EXPECT_NEAR(answer.t, 8, 0x1p-18);
  }
}

// Its reciprocal square root is an estimate of the processor's, improved once: not unit length to the last bit.
TEST(Graphene, AsksWithANormalizedDirection) {
  const Ray ray{.origin = {1, 2, 8}, .direction = {2, -3, 6}, .t_min = 0.5, .t_max = 3};
  const Query query = asked(ray);
  EXPECT_FALSE(query.has_tail());
  EXPECT_EQ(query.ray.origin, ray.origin);
  EXPECT_EQ(query.ray.t_min, 3.5);
  EXPECT_EQ(query.ray.t_max, 21);
  for (const auto& [given, unit] :
       {std::pair(ray.direction.x, query.ray.direction.x), std::pair(ray.direction.y, query.ray.direction.y),
        std::pair(ray.direction.z, query.ray.direction.z)}) {
    EXPECT_NEAR(unit, given / 7, 0x1p-21);
    EXPECT_EQ(unit, static_cast<float>(unit));
  }
  EXPECT_EQ(asked(down).ray.t_max, infinity);
}

TEST(Graphene, HitsTheMiddleFromBothSidesAndMissesOutside) {
  for (const double side : {1.0, -1.0}) {
    EXPECT_EQ(outcome(flat, {.origin = {1, 2, side}, .direction = {0, 0, -side}}), Outcome::hit);
    EXPECT_EQ(outcome(flat, {.origin = {2, -0x1p-20, side}, .direction = {0, 0, -side}}), Outcome::miss);
  }
}

TEST(Graphene, ReadsTheRange) {
  Ray ray = down;
  for (const auto& [t_min, t_max, expected] :
       {std::tuple(0.0, 3.5, Outcome::miss), std::tuple(4.5, infinity, Outcome::miss),
        std::tuple(3.5, 4.5, Outcome::hit), std::tuple(5.0, 3.0, Outcome::miss), std::tuple(-1.0, 9.0, Outcome::fault),
        std::tuple(not_a_number, 9.0, Outcome::fault), std::tuple(0.0, not_a_number, Outcome::miss)}) {
    ray.t_min = t_min, ray.t_max = t_max;
    EXPECT_EQ(outcome(flat, ray), expected) << t_min << ' ' << t_max;
  }
  EXPECT_EQ(outcome(flat, {.origin = {1, 2, -8}, .direction = {0, 0, -2}}), Outcome::miss);  // behind
  EXPECT_EQ(outcome(flat, {.origin = {1, 2, 0}, .direction = {0, 0, -2}}), Outcome::hit);    // t = 0
}

TEST(Graphene, FaultsOnDirectionsThatItCantNormalize) {
  const auto along = [](double length) { return outcome(flat, {.origin = {1, 2, 8}, .direction = {0, 0, -length}}); };
  EXPECT_EQ(along(0), Outcome::fault);
  EXPECT_EQ(along(0x1p-24), Outcome::fault);
  EXPECT_EQ(along(0x1p-22), Outcome::hit);
  EXPECT_EQ(along(0x1p+60), Outcome::hit);
  EXPECT_EQ(along(0x1p+64), Outcome::fault);
  EXPECT_EQ(along(infinity), Outcome::fault);
  EXPECT_EQ(along(not_a_number), Outcome::fault);
}

// With a direction of unit length, det is twice the area as seen along the ray.
TEST(Graphene, TakesADeterminantBelowEpsilonForParallel) {
  const auto with_det = [](double det) {
    return outcome({{0, 0, 0}, {1, 0, 0}, {0, det, 0}}, {.origin = {0.25, det / 4, 1}, .direction = {0, 0, -1}});
  };
  EXPECT_EQ(with_det(0x1p-24), Outcome::miss);
  EXPECT_EQ(with_det(0x1p-22), Outcome::hit);
}

TEST(Graphene, MissesAnEmptyBag) { EXPECT_EQ(shoot("graphene_f32", {}, down).outcome, Outcome::miss); }

}  // namespace
}  // namespace plumbline
