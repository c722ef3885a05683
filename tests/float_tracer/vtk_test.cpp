// The adapter to VTK: segments, binary64 throughout, tolerances.
#include "float_tracer/adapters/vtk.h"

#include <gtest/gtest.h>

#include "float_tracer/adapters/segment.h"
#include "tests/float_tracer/expect_outcomes.h"
#include "tests/float_tracer/shoot.h"

namespace plumbline {
namespace {

const Triangle flat{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
const Ray down{.origin = {1, 2, 8}, .direction = {0, 0, -2}};

class Vtk : public testing::TestWithParam<std::string> {
 protected:
  Outcome outcome(const Triangle& triangle, const Ray& ray) { return shoot(GetParam(), {{triangle}}, ray).outcome; }
};
INSTANTIATE_TEST_SUITE_P(All, Vtk,
                         testing::Values("vtk_triangle", "vtk_triangle_tolerant", "vtk_obb_tree", "vtk_cell_locator",
                                         "vtk_static_cell_locator"),
                         parameter_name);

TEST_P(Vtk, GivesTOfTheSegmentUVAndTheNearestTriangle) {
  const Triangle far{{0, 0, -4}, {4, 0, -4}, {0, 4, -4}};
  const auto bag = tracer_named(GetParam()).prepare({{far, flat}});
  Answer answer;
  bag->trace({&down, 1}, {&answer, 1});
  ASSERT_EQ(answer.outcome, Outcome::hit);
  EXPECT_TRUE(answer.has_t && answer.has_uv && !answer.has_segment);
  EXPECT_EQ(answer.triangle, 1u);
  EXPECT_NEAR(answer.t, 0.25, 0x1p-40);  // of the segment from z = 8 to -24
  EXPECT_NEAR(answer.u, 0.25, 0x1p-40);
  EXPECT_NEAR(answer.v, 0.5, 0x1p-40);
  EXPECT_EQ(bag->asked(down), segment_of(down, 4, Precision::binary64)->query);
  EXPECT_EQ(bag->asked(down).ray.direction, (Vec3{0, 0, -32}));
}

TEST_P(Vtk, SearchesTheSegmentOfTheRange) {
  expect_range_searched(GetParam(), flat, down);
  EXPECT_EQ(outcome(flat, {.origin = {1, 1, -2}, .direction = {0, 0, -1}}), Outcome::miss);  // behind
}

// Where a vertex were rounded to binary32 on the way, the edge would lie on the ray's other side.
TEST_P(Vtk, KeepsBinary64) {
  const Triangle triangle{{0x1p-30 + 1, 0, 0}, {5, 0, 0}, {0x1p-30 + 1, 4, 0}};
  const double step = GetParam() == "vtk_triangle_tolerant" ? 0x1p-18 : 0x1p-40;
  const auto at = [&](double x) { return outcome(triangle, {.origin = {x, 1, 8}, .direction = {0, 0, -1}}); };
  EXPECT_EQ(at(0x1p-30 + 1 + 0x1p-40), Outcome::hit);
  EXPECT_EQ(at(0x1p-30 + 1 - step), Outcome::miss);
}

TEST_P(Vtk, FaultsOnWhatIsNotFiniteOrNoSegment) {
  expect_faults(GetParam(), flat, down, {not_a_number, infinity, -infinity});
  Ray ray = down;
  ray.t_min = 5, ray.t_max = 3;
  EXPECT_EQ(outcome(flat, ray), Outcome::fault);
}

TEST_P(Vtk, MissesAnEmptyBag) { EXPECT_EQ(shoot(GetParam(), {}, down).outcome, Outcome::miss); }

TEST_P(Vtk, EveryToleranceButOneIsZero) {
  EXPECT_EQ(outcome(flat, {.origin = {1, -0x1p-20, 8}, .direction = {0, 0, -1}}),  // 9.5e-7 beside
            GetParam() == "vtk_triangle_tolerant" ? Outcome::hit : Outcome::miss);
  EXPECT_EQ(outcome(flat, {.origin = {1, -0x1p-19, 8}, .direction = {0, 0, -1}}), Outcome::miss);
}

}  // namespace
}  // namespace plumbline
