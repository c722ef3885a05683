// The adapter to GTS: what it passes on, what it refuses, what it is really asked.
#include "float_tracer/adapters/gts.h"

#include <gtest/gtest.h>

#include "tests/float_tracer/shoot.h"

namespace plumbline {
namespace {

const Triangle flat{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
const Ray down{.origin = {1, 2, 8}, .direction = {0, 0, -2}};

Outcome outcome(const Triangle& triangle, const Ray& ray) {
  return shoot("gts_segment_f64", {.triangles = {triangle}}, ray).outcome;
}

TEST(Gts, GivesTAndTheNearestTriangle) {
  const Triangle far{{0, 0, -4}, {4, 0, -4}, {0, 4, -4}};
  for (const bool swapped : {false, true}) {
    const Bag bag{.triangles = swapped ? std::vector{far, flat} : std::vector{flat, far}};
    const Answer answer = shoot("gts_segment_f64", bag, down);
    ASSERT_EQ(answer.outcome, Outcome::hit);
    EXPECT_TRUE(answer.has_t && !answer.has_uv && !answer.has_segment);
    EXPECT_EQ(answer.triangle, swapped ? 1u : 0u);
    EXPECT_EQ(answer.t, 0.25);  // of the segment from z = 8 to -24
    EXPECT_EQ(tracer_named("gts_segment_f64").prepare(bag)->asked(down),
              Query(Ray{.origin = down.origin, .direction = {0, 0, -32}, .t_min = 0, .t_max = 1}));
  }
}

// At these it returns a vertex of the triangle or an end of the segment, which the adapter must not free.
TEST(Gts, HitsVerticesEdgesAndEndsAsOftenAsAsked) {
  const auto prepared = tracer_named("gts_segment_f64").prepare({.triangles = {flat}});
  const std::vector<Ray> rays = {
      {.origin = {0, 0, 8}, .direction = {0, 0, -2}},              // a
      {.origin = {4, 0, 8}, .direction = {0, 0, -2}},              // b
      {.origin = {0, 4, 8}, .direction = {0, 0, -2}},              // c
      {.origin = {2, 0, 8}, .direction = {0, 0, -2}},              // ab
      {.origin = {2, 2, 8}, .direction = {0, 0, -2}},              // bc
      {.origin = {0, 2, -8}, .direction = {0, 0, 2}},              // ca
      {.origin = {1, 1, 0}, .direction = {0, 0, 2}},               // begins on it
      {.origin = {1, 1, 8}, .direction = {0, 0, -2}, .t_max = 4},  // ends on it
      {.origin = {0, 0, 0}, .direction = {1, 1, 1}},               // begins on a vertex
  };
  std::vector<Answer> answers(rays.size());
  for (int repeat = 0; repeat < 3; ++repeat) {
    prepared->trace(rays, answers);
    for (std::size_t i = 0; i < rays.size(); ++i) EXPECT_EQ(answers[i].outcome, Outcome::hit) << i;
  }
  EXPECT_EQ(answers[6].t, 0);
  EXPECT_EQ(answers[7].t, 1);
}

TEST(Gts, ReadsTheRange) {
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
  ray.t_min = -infinity, ray.direction = {0, 0, 2};
  EXPECT_EQ(outcome(flat, ray), Outcome::hit);
  ray.t_min = -4;
  EXPECT_EQ(outcome(flat, ray), Outcome::hit);
  ray.t_min = -3;
  EXPECT_EQ(outcome(flat, ray), Outcome::miss);
}

TEST(Gts, MissesInThePlaneAsItsDocumentationSays) {
  EXPECT_EQ(outcome(flat, {.origin = {-8, 1, 0}, .direction = {1, 0, 0}}), Outcome::miss);
}

TEST(Gts, FaultsWhereNoSegmentStandsForTheRay) {
  Ray ray = down;
  ray.t_min = ray.t_max = 4;
  EXPECT_EQ(outcome(flat, ray), Outcome::fault);
  ray = down, ray.t_max = not_a_number;
  EXPECT_EQ(outcome(flat, ray), Outcome::fault);
  for (const double bad : {not_a_number, infinity}) {
    Triangle spoilt = flat;
    spoilt.b.y = bad;
    EXPECT_EQ(outcome(spoilt, down), Outcome::fault);
    EXPECT_EQ(shoot("gts_segment_f64", {.triangles = {flat, spoilt}}, down).outcome, Outcome::fault);
  }
}

}  // namespace
}  // namespace plumbline
