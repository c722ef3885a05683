// Rays as segments: where the ends lie, and that the query is the line through them exactly.
#include "float_tracer/adapters/segment_probe.h"

#include <gtest/gtest.h>

#include "tests/float_tracer/shoot.h"

namespace plumbline {
namespace {

TEST(SegmentProbe, GoesFourTimesTheBagOut) {
  const auto probe = segment_probe<double>({.origin = {1, 2, 8}, .direction = {0, 0, -2}}, 4);
  ASSERT_TRUE(probe);
  EXPECT_EQ(probe->from, (Vec3{1, 2, 8}));
  EXPECT_EQ(probe->to, (Vec3{1, 2, -24}));  // K = 16: 16 * 2 >= 4 * 8
  EXPECT_EQ(probe->query.ray, (Ray{{1, 2, 8}, {0, 0, -32}, 0, 1}));
  EXPECT_FALSE(probe->query.has_tail());
}

TEST(SegmentProbe, TakesTheLeastPowerOfTwoThatReaches) {
  const auto far = [](double direction, double largest) {
    return segment_probe<double>({.origin = {}, .direction = {direction, 0, 0}}, largest)->to.x;
  };
  EXPECT_EQ(far(1, 1), 4);
  EXPECT_EQ(far(0x1.8p+0, 1), 0x1.8p+2);
  EXPECT_EQ(far(1, 0x1.8p+0), 8);
  EXPECT_EQ(far(0x1.8p+0, 0x1.8p+0), 0x1.8p+2);
  EXPECT_EQ(far(1, 0), 1);  // everything lies in one point
  EXPECT_EQ(far(0x1p-1074, 0x1p-1074), 0x1p-1072);
  EXPECT_EQ(far(-0x1p-1074, 0x1p+1000), -0x1p+1002);
}

TEST(SegmentProbe, TakesFiniteBoundsAsTheyAre) {
  Ray ray{.origin = {1, 2, 8}, .direction = {0.5, 0, -2}, .t_min = 3, .t_max = 5};
  EXPECT_EQ(segment_probe<double>(ray, 4)->from, (Vec3{2.5, 2, 2}));
  EXPECT_EQ(segment_probe<double>(ray, 4)->to, (Vec3{3.5, 2, -2}));
  ray.t_min = -infinity, ray.t_max = 0;
  EXPECT_EQ(segment_probe<double>(ray, 4)->from, (Vec3{-7, 2, 40}));
  EXPECT_EQ(segment_probe<double>(ray, 4)->to, ray.origin);
}

TEST(SegmentProbe, TellsTheRoundingOfTheEnds) {
  const Ray ray{.origin = {0x1p+24, 1, 0}, .direction = {0x1p-4, 0x1.000002p+0, 0}, .t_max = 1};
  const auto single = segment_probe<float>(ray, 1);
  EXPECT_EQ(single->to, (Vec3{0x1p+24, 0x1p+1, 0}));  // 2^24 + 2^-4 and 2 + 2^-23 are no binary32 numbers
  EXPECT_EQ(single->query.ray.direction, (Vec3{0, 1, 0}));
  const auto twice = segment_probe<double>(ray, 1);
  EXPECT_EQ(twice->query.ray.direction, ray.direction);
  EXPECT_FALSE(twice->query.has_tail());

  // to.x - from.x = 1 + 2^-80 has no binary64 number.
  const auto tail = segment_probe<double>({.origin = {-0x1p-80, 0, 0}, .direction = {1, 0, 0}, .t_max = 1}, 1);
  EXPECT_EQ(tail->query.ray.direction, (Vec3{1, 0, 0}));
  EXPECT_EQ(tail->query.direction_tail, (Vec3{0x1p-80, 0, 0}));
}

TEST(SegmentProbe, RefusesWhatHasNoSegment) {
  const Ray good{.origin = {1, 2, 8}, .direction = {0, 0, -2}};
  for (const double bad : {not_a_number, infinity, -infinity})
    for (std::size_t i = 0; i < 6; ++i) {
      Ray ray = good;
      *coordinates(ray)[i] = bad;
      EXPECT_FALSE(segment_probe<double>(ray, 4)) << "ray coordinate " << i << " = " << bad;
    }
  const auto with_range = [&](double t_min, double t_max) {
    Ray ray = good;
    ray.t_min = t_min, ray.t_max = t_max;
    return segment_probe<double>(ray, 4).has_value();
  };
  EXPECT_TRUE(with_range(-infinity, infinity));
  EXPECT_FALSE(with_range(not_a_number, 1));
  EXPECT_FALSE(with_range(0, not_a_number));
  EXPECT_FALSE(with_range(1, 0));
  EXPECT_FALSE(with_range(1, 1));
  EXPECT_FALSE(with_range(infinity, infinity));
  EXPECT_FALSE(with_range(0, 0x1p-60));    // rounds to one point
  EXPECT_FALSE(with_range(0, 0x1p+1023));  // overflows
  EXPECT_FALSE(segment_probe<double>({.origin = {1, 2, 8}, .direction = {}}, 4));
  EXPECT_FALSE(segment_probe<float>({.origin = {0, 0, 0x1p+127}, .direction = {0, 0, -1}}, 4));
  EXPECT_TRUE(segment_probe<double>({.origin = {0, 0, 0x1p+127}, .direction = {0, 0, -1}}, 4));
}

}  // namespace
}  // namespace plumbline
