// A ray as a segment: how far it reaches, what is rounded, what is asked, when there is none.
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
      for (const double spoilt : {not_a_number, infinity}) {
        *coordinates(triangle)[i] = 2;
        *coordinates(triangle)[(i + 4) % 9] = spoilt;
        EXPECT_EQ(largest_coordinate({.triangles = {triangle}}), spoilt == infinity ? infinity : 3) << i;
        *coordinates(triangle)[(i + 4) % 9] = 3;
      }
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
}

TEST(Segment, TheQueryIsTheLineThroughTheRoundedEnds) {
  const auto query = [](const Ray& ray) { return segment_of(ray, 1, Precision::binary64)->query; };
  EXPECT_EQ(query({.origin = {1, 2, 3}, .direction = {2, 0, -4}, .t_min = 0.5, .t_max = 2}),
            Query(Ray{.origin = {2, 2, 1}, .direction = {3, 0, -6}, .t_min = 0, .t_max = 1}));
  EXPECT_EQ(query({.origin = {1, 0, 0}, .direction = {0x1p-60, 0, 1}, .t_max = 1}),
            Query(Ray{.origin = {1, 0, 0}, .direction = {0, 0, 1}, .t_min = 0, .t_max = 1}));
  const Query with_tail = query({.origin = {0x1p-60, 0, 0}, .direction = {1, 0, 1}, .t_max = 1});  // to {1, 0, 1}
  EXPECT_EQ(with_tail.ray.direction, (Vec3{1, 0, 1}));
  EXPECT_EQ(with_tail.direction_tail, (Vec3{-0x1p-60, 0, 0}));
}

TEST(Segment, ThereIsNoneWithoutTwoPoints) {
  const Ray good{.origin = {1, 2, 8}, .direction = {0, 0, -2}};
  for (const double bad : {not_a_number, infinity, -infinity})
    for (std::size_t i = 0; i < 6; ++i) {
      Ray ray = good;
      *coordinates(ray)[i] = bad;
      EXPECT_FALSE(segment_of(ray, 4, Precision::binary64)) << "ray coordinate " << i << " = " << bad;
    }
  const auto with_range = [&](double t_min, double t_max) {
    Ray ray = good;
    ray.t_min = t_min, ray.t_max = t_max;
    return segment_of(ray, 4, Precision::binary64).has_value();
  };
  EXPECT_TRUE(with_range(-infinity, infinity));
  EXPECT_FALSE(with_range(not_a_number, 1));
  EXPECT_FALSE(with_range(0, not_a_number));
  EXPECT_FALSE(with_range(1, 0));
  EXPECT_FALSE(with_range(1, 1));
  EXPECT_FALSE(with_range(infinity, infinity));
  EXPECT_FALSE(with_range(0, 0x1p-60));    // rounded to one point
  EXPECT_FALSE(with_range(0, 0x1p+1023));  // a product overflows
  EXPECT_FALSE(segment_of({.origin = {1, 2, 8}, .direction = {}}, 4, Precision::binary64));
  EXPECT_FALSE(segment_of(good, 0x1p+1022, Precision::binary64));  // the reach overflows
  EXPECT_FALSE(segment_of(good, infinity, Precision::binary64));
  const Ray far{.origin = {1, 0, 0}, .direction = {0, 0, -0x1p+127}, .t_max = 2};
  EXPECT_FALSE(segment_of(far, 1, Precision::binary32));
  EXPECT_TRUE(segment_of(far, 1, Precision::binary64));
  const Ray wide{.origin = {}, .direction = {0x1.8p+1023, 1, 0}, .t_min = -1, .t_max = 1};
  EXPECT_FALSE(segment_of(wide, 1, Precision::binary64));  // the ends are there, their difference overflows
}

}  // namespace
}  // namespace plumbline
