// The adapter to Irrlicht: infinite lines, closed edges, and what it takes for zero.
#include "float_tracer/adapters/irrlicht.h"

#include <gtest/gtest.h>

#include "tests/float_tracer/shoot.h"

namespace plumbline {
namespace {

const Triangle flat{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
const Ray down{.origin = {1, 2, 8}, .direction = {0, 0, -2}};

class Irrlicht : public testing::TestWithParam<std::string> {
 protected:
  Outcome outcome(const Triangle& triangle, const Ray& ray) { return shoot(GetParam(), {{triangle}}, ray).outcome; }
};
INSTANTIATE_TEST_SUITE_P(All, Irrlicht, testing::Values("irrlicht_f32", "irrlicht_f64"), parameter_name);

TEST_P(Irrlicht, GivesTAndTheNearestTriangle) {
  const Triangle far{{0, 0, -4}, {4, 0, -4}, {0, 4, -4}};
  const Answer answer = shoot(GetParam(), {{far, flat}}, down);
  ASSERT_EQ(answer.outcome, Outcome::hit);
  EXPECT_TRUE(answer.has_t && !answer.has_uv && !answer.has_segment);
  EXPECT_EQ(answer.triangle, 1u);
  EXPECT_EQ(answer.t, 4);
}

TEST_P(Irrlicht, IsAskedTheRayItself) {
  const Ray ray{.origin = {1, 2, 8}, .direction = {0.25, 0, -3}, .t_min = 1, .t_max = 2};
  EXPECT_EQ(tracer_named(GetParam()).prepare({{flat}})->asked(ray), Query(ray));
}

TEST_P(Irrlicht, SearchesTheWholeLine) {
  Ray ray = down;
  ray.t_min = 5, ray.t_max = 6;  // not read
  EXPECT_EQ(outcome(flat, ray), Outcome::hit);
  EXPECT_EQ(outcome(flat, {.origin = {1, 1, 0}, .direction = {0, 0, -1}}), Outcome::hit);
  EXPECT_EQ(shoot(GetParam(), {{flat}}, {.origin = {1, 1, -8}, .direction = {0, 0, -1}}).t, -8);
}

TEST_P(Irrlicht, HitsEdgesAndVerticesFromBothSides) {
  for (const double side : {1.0, -1.0})
    for (const auto& [x, y] : {std::pair(0, 0), {4, 0}, {0, 4}, {2, 0}, {2, 2}, {0, 2}})
      EXPECT_EQ(outcome(flat, {.origin = {1.0 * x, 1.0 * y, 8 * side}, .direction = {0, 0, -side}}), Outcome::hit)
          << x << " " << y;
}

TEST_P(Irrlicht, WidensATriangleByAnAngleOfAMillionthOfItsEdges) {
  const auto beside = [&](double by) { return outcome(flat, {.origin = {2, -by, 8}, .direction = {0, 0, -1}}); };
  EXPECT_EQ(beside(1.99e-6), Outcome::hit);  // 2 away from a: the angle is half of it
  EXPECT_EQ(beside(2.01e-6), Outcome::miss);
}

TEST_P(Irrlicht, CallsShortDirectionsParallel) {
  EXPECT_EQ(outcome(flat, {.origin = {1, 1, 8}, .direction = {0, 0, -1.01e-8}}), Outcome::hit);
  EXPECT_EQ(outcome(flat, {.origin = {1, 1, 8}, .direction = {0, 0, -0.99e-8}}), Outcome::miss);
}

TEST_P(Irrlicht, MissesAnEmptyBag) { EXPECT_EQ(shoot(GetParam(), {}, down).outcome, Outcome::miss); }

}  // namespace
}  // namespace plumbline
