// The adapter to ODE: what it really asks, what it refuses, and what ODE makes of the edges of its contract.
#include "float_tracer/adapters/ode.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/float_tracer/expect_contract.h"
#include "tests/float_tracer/shoot.h"

namespace plumbline {
namespace {

const Triangle flat{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
const Ray down{.origin = {1, 2, 8}, .direction = {0, 0, -2}};

Outcome outcome(const Triangle& triangle, const Ray& ray) {
  return shoot("ode_f64", {.triangles = {triangle}}, ray).outcome;
}

Query asked(const Ray& ray) { return tracer_named("ode_f64").prepare({.triangles = {flat}})->asked(ray); }

TEST(Ode, Contract) {
  expect_contract("ode_f64", {.edges = EdgeRule::unspecified,
                              .t_min = EndRule::unspecified,
                              .t_max = EndRule::unspecified,
                              .coplanar = TouchRule::unspecified,
                              .degenerate = TouchRule::unspecified});
  EXPECT_TRUE(tracer_named("ode_f64").info().package.starts_with("libode-dev 0."));
  EXPECT_TRUE(tracer_named("ode_f64").info().own_queries);
  EXPECT_EQ(tracer_named("ode_f64").info().isolation, Isolation::process);
}

TEST(Ode, GivesTheDistanceAndTheNearestTriangle) {
  const Triangle far{{0, 0, -4}, {4, 0, -4}, {0, 4, -4}};
  for (const auto& [triangles, index] :
       {std::pair(std::vector{far, flat}, 1u), std::pair(std::vector{flat, far}, 0u)}) {
    const Answer answer = shoot("ode_f64", {.triangles = triangles}, down);
    ASSERT_EQ(answer.outcome, Outcome::hit);
    EXPECT_TRUE(answer.has_t && !answer.has_uv && !answer.has_segment);
    EXPECT_EQ(answer.triangle, index);
    EXPECT_NEAR(answer.t, 8, 0x1p-18);
  }
}

TEST(Ode, AsksWithANormalizedDirectionAndALength) {
  const Query query = asked({.origin = {1, 2, 8}, .direction = {2, -3, 6}, .t_min = 0.5, .t_max = 3});
  EXPECT_FALSE(query.has_tail());
  EXPECT_EQ(query.ray.origin, (Vec3{1, 2, 8}));
  EXPECT_NEAR(query.ray.direction.x, 2 / 7.0, 0x1p-52);
  EXPECT_NEAR(query.ray.direction.y, -3 / 7.0, 0x1p-52);
  EXPECT_NEAR(query.ray.direction.z, 6 / 7.0, 0x1p-52);
  EXPECT_EQ(query.ray.t_min, 3.5);
  EXPECT_EQ(query.ray.t_max, 21);
  EXPECT_EQ(asked(down).ray.t_max, 32);  // the reach: four times 8
}

TEST(Ode, HitsTheMiddleFromBothSidesAndMissesOutside) {
  for (const double side : {1.0, -1.0}) {
    EXPECT_EQ(outcome(flat, {.origin = {1, 2, side}, .direction = {0, 0, -side}}), Outcome::hit);
    EXPECT_EQ(outcome(flat, {.origin = {2, -0x1p-10, side}, .direction = {0, 0, -side}}), Outcome::miss);
  }
}

TEST(Ode, ReadsTheRange) {
  Ray ray = down;
  for (const auto& [t_min, t_max, expected] :
       {std::tuple(0.0, 3.5, Outcome::miss), std::tuple(4.5, infinity, Outcome::miss),
        std::tuple(3.5, 4.5, Outcome::hit), std::tuple(5.0, 3.0, Outcome::miss), std::tuple(0.0, 0.0, Outcome::fault),
        std::tuple(0.0, -1.0, Outcome::fault), std::tuple(-1.0, 9.0, Outcome::fault),
        std::tuple(not_a_number, 9.0, Outcome::fault), std::tuple(0.0, not_a_number, Outcome::fault)}) {
    ray.t_min = t_min, ray.t_max = t_max;
    EXPECT_EQ(outcome(flat, ray), expected) << t_min << ' ' << t_max;
  }
  EXPECT_EQ(outcome(flat, {.origin = {1, 2, -8}, .direction = {0, 0, -2}}), Outcome::miss);  // behind
}

// A weight or distance of -0 counts as negative, and which side gives -0 hangs on the winding.
TEST(Ode, TakesMinusZeroForNegative) {
  const Outcome front = outcome(flat, {.origin = {1, 2, 0}, .direction = {0, 0, -2}});
  const Outcome back = outcome(flat, {.origin = {1, 2, 0}, .direction = {0, 0, 2}});
  EXPECT_NE(front, back);
}

TEST(Ode, FaultsOnWhatItCantTake) {
  for (const double bad : {not_a_number, infinity, -infinity, 0x1p+128}) {
    for (std::size_t i = 0; i < 9; ++i) {
      Triangle spoilt = flat;
      *coordinates(spoilt)[i] = bad;
      EXPECT_EQ(outcome(spoilt, down), Outcome::fault) << "triangle coordinate " << i << " = " << bad;
    }
    for (std::size_t i = 0; i < (bad == 0x1p+128 ? 3 : 6); ++i) {
      Ray spoilt = down;
      *coordinates(spoilt)[i] = bad;
      EXPECT_EQ(outcome(flat, spoilt), Outcome::fault) << "ray coordinate " << i << " = " << bad;
    }
  }
  for (const double length : {0.0, 0x1p-1074, 0x1p-1023})
    EXPECT_EQ(outcome(flat, {.origin = {1, 2, 8}, .direction = {0, 0, -length}}), Outcome::fault) << length;
  for (const double length : {0x1p-1022, 0x1p+1000})
    EXPECT_EQ(outcome(flat, {.origin = {1, 2, 8}, .direction = {0, 0, -length}}), Outcome::hit) << length;
}

TEST(Ode, MissesAnEmptyBag) { EXPECT_EQ(shoot("ode_f64", {}, down).outcome, Outcome::miss); }

}  // namespace
}  // namespace plumbline
