// The adapter to Gazebo Math: that the segment gets there as meant, and that the wrong answers are the library's.
#include "float_tracer/adapters/gz_math.h"

#include <gtest/gtest.h>

#include "float_tracer/adapters/segment.h"
#include "tests/float_tracer/expect_outcomes.h"
#include "tests/float_tracer/shoot.h"

namespace plumbline {
namespace {

const Triangle flat{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
const Ray down{.origin = {1, 2, 8}, .direction = {0, 0, -2}};

class GzMath : public testing::TestWithParam<std::string> {
 protected:
  Outcome outcome(const Triangle& triangle, const Ray& ray) { return shoot(GetParam(), {{triangle}}, ray).outcome; }
};
INSTANTIATE_TEST_SUITE_P(All, GzMath, testing::Values("gz_math_f32", "gz_math_f64"), parameter_name);

TEST_P(GzMath, GivesTOfTheSegmentAndTheNearestTriangle) {
  const Triangle far{{0, 0, -4}, {4, 0, -4}, {0, 4, -4}};
  const auto bag = tracer_named(GetParam()).prepare({{far, flat}});
  Answer answer;
  bag->trace({&down, 1}, {&answer, 1});
  ASSERT_EQ(answer.outcome, Outcome::hit);
  EXPECT_TRUE(answer.has_t && !answer.has_uv && !answer.has_segment);
  EXPECT_EQ(answer.triangle, 1u);
  EXPECT_EQ(answer.t, 0.25);  // of the segment from z = 8 to -24
  EXPECT_EQ(bag->asked(down), segment_of(down, 4, Precision::binary64)->query);
  EXPECT_EQ(bag->asked(down).ray.direction, (Vec3{0, 0, -32}));
}

TEST_P(GzMath, SearchesTheSegmentOfTheRange) {
  expect_range_searched(GetParam(), flat, down);
  EXPECT_EQ(outcome(flat, {.origin = {1, 1, -2}, .direction = {0, 0, -1}}), Outcome::miss);  // behind
}

TEST_P(GzMath, HitsThePlaneBesideTheTriangle) {
  for (const double side : {1.0, -1.0}) {
    const auto at = [&](double x, double y) {
      return outcome(flat, {.origin = {x, y, 8 * side}, .direction = {0, 0, -side}});
    };
    EXPECT_EQ(at(1, 1), Outcome::hit);
    EXPECT_EQ(at(4, 0), Outcome::hit);
    EXPECT_EQ(at(1000, -7), Outcome::hit);  // wrong
  }
}

TEST_P(GzMath, MissesAPlaneNearerThanOne) {
  EXPECT_EQ(outcome(flat, {.origin = {1, 1, 1}, .direction = {0, 0, -1}}), Outcome::hit);
  EXPECT_EQ(outcome(flat, {.origin = {1, 1, 0.96875}, .direction = {0, 0, -1}}), Outcome::miss);  // wrong
  EXPECT_EQ(outcome(flat, {.origin = {1, 1, 0}, .direction = {0, 0, -1}}), Outcome::miss);
}

TEST_P(GzMath, HitsSegmentsInThePlane) {
  EXPECT_EQ(outcome(flat, {.origin = {-8, 1, 0}, .direction = {1, 0, 0}}), Outcome::hit);                // through
  EXPECT_EQ(outcome(flat, {.origin = {-8, -1, 0}, .direction = {1, 0, 0}}), Outcome::miss);              // beside
  EXPECT_EQ(outcome(flat, {.origin = {1, 1, 0}, .direction = {0.25, 0, 0}, .t_max = 1}), Outcome::hit);  // within
  const Triangle raised{{0, 0, 2}, {4, 0, 2}, {0, 4, 2}};
  EXPECT_EQ(outcome(raised, {.origin = {1, 1, 2}, .direction = {0.25, 0, 0}, .t_max = 1}), Outcome::miss);  // wrong
  EXPECT_EQ(outcome(flat, {.origin = {-8, 1, 1}, .direction = {1, 0, 0}}), Outcome::miss);  // parallel
}

TEST_P(GzMath, CallsEverySegmentParallelToASmallTriangle) {
  const auto straight_on = [&](double edge) {
    return outcome({{0, 0, 0}, {edge, 0, 0}, {0, edge, 0}},
                   {.origin = {edge / 4, edge / 4, 2}, .direction = {0, 0, -1}});
  };
  EXPECT_EQ(straight_on(1.001e-3), Outcome::hit);
  EXPECT_EQ(straight_on(0.999e-3), Outcome::miss);  // wrong
}

TEST_P(GzMath, FaultsOnWhatIsNotFiniteOrNoSegment) {
  expect_faults(GetParam(), flat, down, {not_a_number, infinity, -infinity});
  Ray ray = down;
  ray.t_min = 5, ray.t_max = 3;
  EXPECT_EQ(outcome(flat, ray), Outcome::fault);
  ray.t_min = not_a_number;
  EXPECT_EQ(outcome(flat, ray), Outcome::fault);
}

TEST_P(GzMath, MissesAnEmptyBag) { EXPECT_EQ(shoot(GetParam(), {}, down).outcome, Outcome::miss); }

}  // namespace
}  // namespace plumbline
