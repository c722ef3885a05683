// The adapter to cglm: what it passes on, and what cglm makes of the edges of its contract.
#include "float_tracer/adapters/cglm.h"

#include <gtest/gtest.h>

#include "tests/float_tracer/expect_contract.h"
#include "tests/float_tracer/shoot.h"

namespace plumbline {
namespace {

const Triangle flat{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
const Ray down{.origin = {1, 2, 8}, .direction = {0, 0, -2}};

Outcome outcome(const Triangle& triangle, const Ray& ray) {
  return shoot("cglm_f32", {.triangles = {triangle}}, ray).outcome;
}

TEST(Cglm, Contract) {
  expect_contract("cglm_f32",
                  {.precision = Precision::binary32, .t_min = EndRule::unspecified, .t_max = EndRule::unspecified});
  EXPECT_TRUE(tracer_named("cglm_f32").info().package.starts_with("libcglm-dev 0."));
  EXPECT_FALSE(tracer_named("cglm_f32").info().own_queries);
}

TEST(Cglm, GivesTAndTheNearestTriangle) {
  const Triangle far{{0, 0, -4}, {4, 0, -4}, {0, 4, -4}};
  for (const auto& [triangles, index] :
       {std::pair(std::vector{far, flat}, 1u), std::pair(std::vector{flat, far}, 0u)}) {
    const Answer answer = shoot("cglm_f32", {.triangles = triangles}, down);
    ASSERT_EQ(answer.outcome, Outcome::hit);
    EXPECT_TRUE(answer.has_t && !answer.has_uv && !answer.has_segment);
    EXPECT_EQ(answer.triangle, index);
    EXPECT_EQ(answer.t, 4);
  }
}

TEST(Cglm, HitsEdgesAndVerticesFromBothSides) {
  for (const double side : {1.0, -1.0})
    for (const auto& [x, y] : {std::pair(2, 0), {2, 2}, {0, 2}, {0, 0}, {4, 0}, {0, 4}})
      EXPECT_EQ(outcome(flat, {.origin = {x * 1.0, y * 1.0, side}, .direction = {0, 0, -side}}), Outcome::hit)
          << x << ' ' << y << ' ' << side;
  EXPECT_EQ(outcome(flat, {.origin = {2, -0x1p-20, 1}, .direction = {0, 0, -1}}), Outcome::miss);
}

TEST(Cglm, ReadsTheRange) {
  Ray ray = down;
  for (const auto& [t_min, t_max, expected] :
       {std::tuple(0.0, 3.5, Outcome::miss), std::tuple(4.5, infinity, Outcome::miss),
        std::tuple(4.0, 4.0, Outcome::hit), std::tuple(5.0, 3.0, Outcome::miss), std::tuple(-1.0, 9.0, Outcome::fault),
        std::tuple(not_a_number, 9.0, Outcome::fault), std::tuple(0.0, not_a_number, Outcome::miss)}) {
    ray.t_min = t_min, ray.t_max = t_max;
    EXPECT_EQ(outcome(flat, ray), expected) << t_min << ' ' << t_max;
  }
  EXPECT_EQ(outcome(flat, {.origin = {1, 2, -8}, .direction = {0, 0, -2}}), Outcome::miss);  // behind
}

// t counts in lengths of the direction, and the epsilon does not.
TEST(Cglm, MissesWhatIsNearerThanItsEpsilon) {
  EXPECT_EQ(outcome(flat, {.origin = {1, 2, 0}, .direction = {0, 0, -1}}), Outcome::miss);  // t = 0
  EXPECT_EQ(outcome(flat, {.origin = {1, 2, 1}, .direction = {0, 0, -0x1p+20}}), Outcome::miss);
  EXPECT_EQ(outcome(flat, {.origin = {1, 2, 1}, .direction = {0, 0, -0x1p+19}}), Outcome::hit);
}

TEST(Cglm, TakesADeterminantBelowItsEpsilonForParallel) {
  const auto with_det = [](double det) {
    return outcome({{0, 0, 0}, {1, 0, 0}, {0, det, 0}}, {.origin = {0.25, det / 4, 1}, .direction = {0, 0, -1}});
  };
  EXPECT_EQ(with_det(0x1p-20), Outcome::miss);
  EXPECT_EQ(with_det(0x1p-19), Outcome::hit);
}

TEST(Cglm, MissesAnEmptyBag) { EXPECT_EQ(shoot("cglm_f32", {}, down).outcome, Outcome::miss); }

}  // namespace
}  // namespace plumbline
