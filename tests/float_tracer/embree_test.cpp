// The adapter to Embree: what it passes on, what it refuses, what it leaves alone.
#include "float_tracer/adapters/embree.h"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#ifdef __x86_64__
#include <xmmintrin.h>
#endif

#include "case/precision.h"
#include "case/targets.h"
#include "tests/float_tracer/expect_outcomes.h"
#include "tests/float_tracer/shoot.h"

namespace plumbline {
namespace {

const Triangle flat{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
const Ray down{.origin = {1, 2, 8}, .direction = {0, 0, -2}};

class Embree : public testing::TestWithParam<std::string> {
 protected:
  Outcome outcome(const Triangle& triangle, const Ray& ray) {
    return shoot(GetParam(), {.triangles = {triangle}}, ray).outcome;
  }
};
std::vector<std::string> embrees() {
  std::vector<std::string> names;
  for (const auto& tracer : listed_tracers())
    if (tracer->info().name.starts_with("embree_")) names.push_back(tracer->info().name);
  return names;
}
INSTANTIATE_TEST_SUITE_P(All, Embree, testing::ValuesIn(embrees()), parameter_name);

TEST_P(Embree, GivesTUVAndTheTriangle) {
  const Triangle far{{0, 0, -4}, {4, 0, -4}, {0, 4, -4}};
  const Answer answer = shoot(GetParam(), {.triangles = {far, flat}}, down);
  ASSERT_EQ(answer.outcome, Outcome::hit);
  if (GetParam().ends_with("_occluded")) {
    EXPECT_TRUE(!answer.has_t && !answer.has_uv && !answer.has_segment);
    return;
  }
  EXPECT_TRUE(answer.has_t && answer.has_uv && !answer.has_segment);
  EXPECT_EQ(answer.triangle, 1u);
  EXPECT_NEAR(answer.t, 4, 0x1p-20);
  EXPECT_NEAR(answer.u, 0.25, 0x1p-20);
  EXPECT_NEAR(answer.v, 0.5, 0x1p-20);
}

TEST(EmbreeList, HoldsWhatEveryProcessorOfThisKindHas) {
  std::vector<std::string> always;
  for (const std::string name : {"embree_default", "embree_robust"})
    for (const char* suffix : {"", "_w4", "_w8", "_w16", "_occluded"}) always.push_back(name + suffix);
#ifdef __x86_64__
  always.insert(always.end(), {"embree_default_sse2", "embree_robust_sse2"});
#endif
  EXPECT_THAT(always, testing::IsSubsetOf(embrees()));
}

// Hits, misses and rays beyond the limits by turns, so that any lane is each once, in spans that fill no last packet.
TEST_P(Embree, AnswersEachRayOfASpanInItsPlace) {
  const auto prepared = tracer_named(GetParam()).prepare({.triangles = {flat}});
  const std::array kinds = {down, Ray{.origin = {9, 2, 8}, .direction = {0, 0, -2}},
                            Ray{.origin = {not_a_number, 2, 8}, .direction = {0, 0, -2}}};
  constexpr std::array outcomes = {Outcome::hit, Outcome::miss, Outcome::fault};
  for (std::size_t size = 0; size < 40; ++size) {
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < size; ++i) rays.push_back(kinds[i % 3]);
    std::vector<Answer> answers(size, Answer{.outcome = Outcome::fault, .has_t = true, .t = 77});
    prepared->trace(rays, answers);
    for (std::size_t i = 0; i < size; ++i) {
      EXPECT_EQ(answers[i].outcome, outcomes[i % 3]) << i << " of " << size;
      if (answers[i].has_t) {
        EXPECT_NEAR(answers[i].t, 4, 0x1p-20);
      }
    }
  }
}

// Whether the flag gets there. How often the two differ depends on the instruction set.
TEST(EmbreeRobust, IsAnotherTracerOnRaysThroughEdgesAndVertices) {
  int different = 0;
  for (const double x : {0.0, 1.5})
    for (const double y : {0.0, 1.5})
      for (const double z : {0.0, 1.5}) {
        const Triangle triangle =
            at_precision({{x, y, z}, {1.5 - x, y, 1.5 - z}, {x, 1.5 - y, 1.5 - z}}, Precision::binary32);
        std::vector<Ray> rays(aims({}).size());
        aim_rays(triangle, {}, rays);
        for (const Ray& ray : rays) {
          const Ray single = at_precision(ray, Precision::binary32);
          different += shoot("embree_default", {.triangles = {triangle}}, single).outcome !=
                       shoot("embree_robust", {.triangles = {triangle}}, single).outcome;
        }
      }
  EXPECT_GT(different, 0);
}

TEST_P(Embree, ReadsTheRange) {
  Ray ray = down;
  ray.t_max = 3;
  EXPECT_EQ(outcome(flat, ray), Outcome::miss);
  ray.t_min = 5, ray.t_max = infinity;
  EXPECT_EQ(outcome(flat, ray), Outcome::miss);
  ray.t_min = 3, ray.t_max = 5;
  EXPECT_EQ(outcome(flat, ray), Outcome::hit);
  ray.t_min = 5, ray.t_max = 3;
  EXPECT_EQ(outcome(flat, ray), Outcome::miss);
  ray.t_min = ray.t_max = infinity;
  EXPECT_EQ(outcome(flat, ray), Outcome::miss);
}

TEST_P(Embree, MissesAnEmptyBag) { EXPECT_EQ(shoot(GetParam(), {}, down).outcome, Outcome::miss); }

TEST_P(Embree, FaultsOnEveryCoordinateBeyondTheLimits) {
  const double limit = 1.844e18f;
  expect_faults(GetParam(), flat, down, {not_a_number, infinity, -infinity, limit, -limit, 0x1p+100});
}

TEST_P(Embree, FaultsOnBoundsBeyondTheLimits) {
  for (const double bad : {not_a_number, -infinity, -1.0, -0x1p-149}) {
    Ray ray = down;
    ray.t_min = bad;
    EXPECT_EQ(outcome(flat, ray), Outcome::fault) << "t_min " << bad;
    ray.t_min = 0, ray.t_max = bad;
    EXPECT_EQ(outcome(flat, ray), Outcome::fault) << "t_max " << bad;
  }
}

TEST_P(Embree, TakesTheLargestCoordinates) {
  const double large = std::nextafter(1.844e18f, 0.0f);
  const Triangle huge{{-large, -large, 0}, {large, -large, 0}, {0, large, 0}};
  EXPECT_NE(outcome(huge, {.origin = {0, 0, large}, .direction = {0, 0, -large}}), Outcome::fault);
}

TEST_P(Embree, OneBadTriangleFaultsTheBag) {
  EXPECT_EQ(shoot(GetParam(), {.triangles = {flat, {{infinity, 0, 0}, {1, 0, 0}, {0, 1, 0}}}}, down).outcome,
            Outcome::fault);
}

#ifdef __x86_64__
// Embree advises its users to flush subnormals to zero; the adapter must not do so behind the back of the oracle.
TEST_P(Embree, LeavesTheFloatingPointControlWordAlone) {
  constexpr unsigned control = 0xffc0;  // all but the sticky exception flags
  const unsigned before = _mm_getcsr() & control;
  shoot(GetParam(), {.triangles = std::vector<Triangle>(5000, flat)}, down);
  EXPECT_EQ(_mm_getcsr() & control, before);
}
#endif

}  // namespace
}  // namespace plumbline
