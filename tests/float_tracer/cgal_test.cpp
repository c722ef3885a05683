// The adapter to CGAL's kernels: what it passes on, what it refuses, what it is really asked.
#include "float_tracer/adapters/cgal.h"

#include <gtest/gtest.h>

#include "tests/float_tracer/expect_outcomes.h"
#include "tests/float_tracer/shoot.h"

namespace plumbline {
namespace {

const Triangle flat{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
const Ray down{.origin = {1, 2, 8}, .direction = {0, 0, -2}};

class Cgal : public testing::TestWithParam<std::string> {
 protected:
  Outcome outcome(const Triangle& triangle, const Ray& ray) {
    return shoot(GetParam(), {.triangles = {triangle}}, ray).outcome;
  }
  Query asked(const Ray& ray) { return tracer_named(GetParam()).prepare({.triangles = {flat}})->asked(ray); }
};
INSTANTIATE_TEST_SUITE_P(All, Cgal, testing::Values("cgal_cartesian_f64", "cgal_epick", "cgal_epeck"),
                         parameter_name);

TEST_P(Cgal, SaysWhichTriangleAndNoMore) {
  const Triangle beside{{5, 5, 0}, {9, 5, 0}, {5, 9, 0}}, point{};
  const Answer answer = shoot(GetParam(), {.triangles = {beside, point, flat}}, down);
  ASSERT_EQ(answer.outcome, Outcome::hit);
  EXPECT_TRUE(!answer.has_t && !answer.has_uv && !answer.has_segment);
  EXPECT_EQ(answer.triangle, 2u);
}

TEST_P(Cgal, HitsTheWholeClosedTriangle) {
  for (const Vec3 target : {flat.a, flat.b, flat.c, Vec3{2, 0, 0}, Vec3{2, 2, 0}, Vec3{0, 2, 0}})
    for (const double side : {8, -8, 0})  // 0: the ray begins there
      EXPECT_EQ(outcome(flat, {.origin = {target.x, target.y, side}, .direction = {0, 0, side > 0 ? -1.0 : 1.0}}),
                Outcome::hit);
}

TEST_P(Cgal, HitsInThePlane) {
  EXPECT_EQ(outcome(flat, {.origin = {-8, 1, 0}, .direction = {1, 0, 0}}), Outcome::hit);
  EXPECT_EQ(outcome(flat, {.origin = {-8, 5, 0}, .direction = {1, 0, 0}}), Outcome::miss);
  EXPECT_EQ(outcome(flat, {.origin = {8, 1, 0}, .direction = {1, 0, 0}}), Outcome::miss);
}

TEST_P(Cgal, ReadsNoBounds) {
  const Ray none{.origin = down.origin, .direction = down.direction, .t_min = 5, .t_max = 3};
  EXPECT_EQ(outcome(flat, none), Outcome::hit);
  EXPECT_EQ(outcome(flat, {.origin = {1, 2, -8}, .direction = down.direction, .t_min = -infinity}), Outcome::miss);
}

TEST_P(Cgal, FaultsOnWhatIsNoRayAndNoTriangle) {
  expect_faults(GetParam(), flat, down, {not_a_number, infinity, -infinity});
  EXPECT_EQ(outcome(flat, {.origin = down.origin, .direction = {}}), Outcome::fault);
}

// A Ray_3 keeps its second point: only EPECK's numbers hold it.
TEST_P(Cgal, SaysWhatItsRayIs) {
  const Ray short_of{.origin = {0x1p+60, 0, 8}, .direction = {0x1p-60, 0, -1}};
  const Ray tiny{.origin = {1, 1, 1}, .direction = {0x1p-60, 0, 0}};
  if (GetParam() == "cgal_epeck") {
    EXPECT_EQ(asked(short_of), Query(short_of));
    EXPECT_EQ(outcome(flat, tiny), Outcome::miss);
  } else {
    EXPECT_EQ(asked(short_of), Query(Ray{.origin = short_of.origin, .direction = {0, 0, -1}}));
    EXPECT_EQ(outcome(flat, tiny), Outcome::fault);
  }
}

}  // namespace
}  // namespace plumbline
