// A ray as a segment: how far it reaches, what is rounded, when there is none.
#include "float_tracer/adapters/segment.h"

#include <gtest/gtest.h>

#include "tests/float_tracer/shoot.h"

namespace plumbline {
namespace {

TEST(Segment, TheLargestCoordinateIsThatOfAnyVertex) {
  EXPECT_EQ(largest_coordinate({}), 0);
  for (std::size_t i = 0; i < 9; ++i)
    for (const double sign : {1.0, -1.0}) {
      Triangle triangle{{1, 2, 3}, {1, 2, 3}, {1, 2, 3}};
      *coordinates(triangle)[i] = 7 * sign;
      EXPECT_EQ(largest_coordinate({.triangles = {{{0, 0, 4}, {0, 0, 0}, {0, 0, 0}}, triangle}}), 7) << i;
    }
}

// The least power of two with reach * |d| >= 4 * the largest coordinate, in the maximum norm.
TEST(Segment, ReachIsTheLeastPowerOfTwo) {
  EXPECT_EQ(reach({1, -8, 2}, {0, 0, -2}, 3), 16);
  EXPECT_EQ(reach({1, -3, 2}, {0, 0, -2}, 8), 16);
  EXPECT_EQ(reach({0, 0, 0}, {1, 0, 0}, 1), 4);
  EXPECT_EQ(reach({0, 0, 0}, {1, 0, 0}, 0x1.0000000000001p+0), 8);
  EXPECT_EQ(reach({0, 0, 0}, {0x1.fffffffffffffp-1, 0, 0}, 1), 8);
  EXPECT_EQ(reach({0, 0, 0}, {0, -1.5, 1}, 1.5), 4);
  EXPECT_EQ(reach({0, 0, 0}, {0, -1.5, 1}, 1.75), 8);
  EXPECT_EQ(reach({0, 0, 0}, {0, 0, 5}, 0), 1);
  EXPECT_EQ(reach({0, 0, 0}, {0, 0, 0x1p-1074}, 0x1p-1074), 4);
  EXPECT_EQ(reach({0, 0, 0}, {0, 0, 0x1p-1000}, 0x1p+100), infinity);
  EXPECT_EQ(reach({0, 0, 0}, {0, 0, 0}, 1), infinity);
  EXPECT_EQ(reach({0, 0, 0}, {0, 0, infinity}, 1), infinity);
  EXPECT_EQ(reach({infinity, 0, 0}, {0, 0, 1}, 1), infinity);
}

TEST(Segment, RunsFromTheFirstPointOfTheRangeToTheLast) {
  const auto ends = [](double t_min, double t_max) {
    return segment_of({{1, 2, 8}, {0, 0, -2}, t_min, t_max}, 4, Precision::binary32);
  };
  for (const auto& [t_min, t_max, from, to] :
       {std::tuple(0.0, 3.0, 8.0, 2.0), std::tuple(1.0, 3.0, 6.0, 2.0), std::tuple(-1.0, 3.0, 10.0, 2.0),
        std::tuple(0.0, infinity, 8.0, -24.0), std::tuple(20.0, infinity, -32.0, -160.0),
        std::tuple(-infinity, 3.0, 18.0, 2.0), std::tuple(-infinity, infinity, 104.0, -24.0)}) {
    const auto segment = ends(t_min, t_max);
    ASSERT_TRUE(segment) << t_min << ' ' << t_max;
    EXPECT_EQ(segment->from, (Vec3{1, 2, from})) << t_min << ' ' << t_max;
    EXPECT_EQ(segment->to, (Vec3{1, 2, to})) << t_min << ' ' << t_max;
  }
  for (const auto& [t_min, t_max] : {std::pair(1.0, 1.0), {2.0, 1.0}, {infinity, infinity}, {-infinity, -infinity}})
    EXPECT_FALSE(ends(t_min, t_max)) << t_min << ' ' << t_max;
}

TEST(Segment, RoundsItsEndsToThePrecision) {
  const Ray ray{.origin = {1, 0, 0}, .direction = {0x1p-30, 0, -1}, .t_max = 1};
  EXPECT_EQ(segment_of(ray, 1, Precision::binary32)->to, (Vec3{1, 0, -1}));
  EXPECT_EQ(segment_of(ray, 1, Precision::binary64)->to, (Vec3{0x1.00000004p+0, 0, -1}));
  const Ray far{.origin = {1, 0, 0}, .direction = {0, 0, -0x1p+127}, .t_max = 2};
  EXPECT_FALSE(segment_of(far, 1, Precision::binary32));
  EXPECT_TRUE(segment_of(far, 1, Precision::binary64));
}

TEST(Segment, WithoutOneTheRayItselfIsAsked) {
  const Ray ray{.origin = {1, 2, 8}, .direction = {0, 0, 0}};
  EXPECT_EQ(asked_by(std::nullopt, ray), Query(ray));
  EXPECT_EQ(asked_by(Segment{{1, 0, 0}, {3, 0, 0x1p-3}}, ray), Query(Ray{{1, 0, 0}, {2, 0, 0x1p-3}, 0, 1}));
}

}  // namespace
}  // namespace plumbline
