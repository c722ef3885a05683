// The adapter to GLM: what it passes on, and what GLM makes of the edges of its contract.
#include "float_tracer/adapters/glm.h"

#include <gtest/gtest.h>

#include "tests/float_tracer/expect_contract.h"
#include "tests/float_tracer/shoot.h"

namespace plumbline {
namespace {

const Triangle flat{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
const Ray down{.origin = {1, 2, 8}, .direction = {0, 0, -2}};

class Glm : public testing::TestWithParam<std::string> {
 protected:
  bool single() const { return GetParam() == "glm_f32"; }
  Outcome outcome(const Triangle& triangle, const Ray& ray) {
    return shoot(GetParam(), {.triangles = {triangle}}, ray).outcome;
  }
};
INSTANTIATE_TEST_SUITE_P(All, Glm, testing::Values("glm_f32", "glm_f64"), parameter_name);

TEST_P(Glm, Contract) {
  expect_contract(GetParam(), {.precision = single() ? Precision::binary32 : Precision::binary64,
                               .t_min = EndRule::unspecified,
                               .t_max = EndRule::unspecified});
  EXPECT_TRUE(tracer_named(GetParam()).info().package.starts_with("libglm-dev 0.9.9"));
  EXPECT_FALSE(tracer_named(GetParam()).info().own_queries);
}

TEST_P(Glm, GivesTUVAndTheNearestTriangle) {
  const Triangle far{{0, 0, -4}, {4, 0, -4}, {0, 4, -4}};
  for (const auto& [triangles, index] :
       {std::pair(std::vector{far, flat}, 1u), std::pair(std::vector{flat, far}, 0u)}) {
    const Answer answer = shoot(GetParam(), {.triangles = triangles}, down);
    ASSERT_EQ(answer.outcome, Outcome::hit);
    EXPECT_TRUE(answer.has_t && answer.has_uv && !answer.has_segment);
    EXPECT_EQ(answer.triangle, index);
    EXPECT_EQ(answer.t, 4);
    EXPECT_EQ(answer.u, 0.25);
    EXPECT_EQ(answer.v, 0.5);
  }
}

TEST_P(Glm, HitsEdgesAndVerticesFromBothSides) {
  for (const double side : {1.0, -1.0})
    for (const auto& [x, y] : {std::pair(2, 0), {2, 2}, {0, 2}, {0, 0}, {4, 0}, {0, 4}})
      EXPECT_EQ(outcome(flat, {.origin = {x * 1.0, y * 1.0, side}, .direction = {0, 0, -side}}), Outcome::hit)
          << x << ' ' << y << ' ' << side;
  EXPECT_EQ(outcome(flat, {.origin = {2, -0x1p-20, 1}, .direction = {0, 0, -1}}), Outcome::miss);
}

// GLM itself says true; its caller has to look at the distance.
TEST_P(Glm, MissesBehindTheOriginUnlessTheRangeGoesThere) {
  Ray ray{.origin = {1, 2, -8}, .direction = {0, 0, -2}};
  EXPECT_EQ(outcome(flat, ray), Outcome::miss);
  ray.t_min = -infinity;
  EXPECT_EQ(outcome(flat, ray), Outcome::hit);
}

TEST_P(Glm, ReadsTheRange) {
  Ray ray = down;
  for (const auto& [t_min, t_max, expected] :
       {std::tuple(0.0, 3.5, Outcome::miss), std::tuple(4.5, infinity, Outcome::miss),
        std::tuple(4.0, 4.0, Outcome::hit), std::tuple(5.0, 3.0, Outcome::miss),
        std::tuple(not_a_number, 9.0, Outcome::miss), std::tuple(0.0, not_a_number, Outcome::miss)}) {
    ray.t_min = t_min, ray.t_max = t_max;
    EXPECT_EQ(outcome(flat, ray), expected) << t_min << ' ' << t_max;
  }
  EXPECT_EQ(outcome(flat, {.origin = {1, 2, 0}, .direction = {0, 0, -2}}), Outcome::hit);  // t = 0
}

// The greatest det that is refused is the machine epsilon.
TEST_P(Glm, TakesADeterminantUpToEpsilonForParallel) {
  const double epsilon = single() ? 0x1p-23 : 0x1p-52;
  const auto with_det = [](double det) { return Triangle{{0, 0, 0}, {1, 0, 0}, {0, det, 0}}; };
  const auto through = [](double det) { return Ray{.origin = {0.25, det / 4, 1}, .direction = {0, 0, -1}}; };
  EXPECT_EQ(outcome(with_det(epsilon), through(epsilon)), Outcome::miss);
  EXPECT_EQ(outcome(with_det(2 * epsilon), through(2 * epsilon)), Outcome::hit);
}

TEST_P(Glm, MissesAnEmptyBag) { EXPECT_EQ(shoot(GetParam(), {}, down).outcome, Outcome::miss); }

}  // namespace
}  // namespace plumbline
