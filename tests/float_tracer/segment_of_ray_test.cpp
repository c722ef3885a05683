// The segment that stands for a ray: where it ends, what is then asked, and where there is none.
#include "float_tracer/adapters/segment_of_ray.h"

#include <gtest/gtest.h>

#include "tests/float_tracer/shoot.h"

namespace plumbline {
namespace {

TEST(SegmentOfRay, EndsAtFiniteBounds) {
  const auto segment =
      segment_of({.origin = {1, 2, 3}, .direction = {2, 0, -4}, .t_min = 0.5, .t_max = 2}, 100);
  ASSERT_TRUE(segment);
  EXPECT_EQ(segment->from, (Vec3{2, 2, 1}));
  EXPECT_EQ(segment->to, (Vec3{5, 2, -5}));
  EXPECT_EQ(segment->query, Query(Ray{.origin = {2, 2, 1}, .direction = {3, 0, -6}, .t_min = 0, .t_max = 1}));
}

TEST(SegmentOfRay, TheQueryIsTheLineThroughTheRoundedEnds) {
  const Ray ray{.origin = {1, 0, 0}, .direction = {0x1p-60, 0, 1}, .t_max = 1};
  const auto segment = segment_of(ray, 1);
  ASSERT_TRUE(segment);
  EXPECT_EQ(segment->to, (Vec3{1, 0, 1}));
  EXPECT_EQ(segment->query.ray.direction, (Vec3{0, 0, 1}));
  const auto with_tail = segment_of({.origin = {0x1p-60, 0, 0}, .direction = {1, 0, 1}, .t_max = 1}, 1);
  EXPECT_EQ(with_tail->to, (Vec3{1, 0, 1}));
  EXPECT_EQ(with_tail->query.direction_tail, (Vec3{-0x1p-60, 0, 0}));
}

// 2^k is by the header the one that takes 4 <= 2^k * step / extent <= 16, with a margin to either side.
TEST(SegmentOfRay, AnInfiniteBoundPassesTheBag) {
  for (const double extent : {0x1p-1074, 0x1p-300, 0.9, 1.0, 1.1, 0x1.fffffffffffffp+0, 0x1p+300})
    for (const double step : {0x1p-1074, 0x1p-300, 0.9, 1.0, 1.1, 0x1.fffffffffffffp+0, 0x1p+300}) {
      const auto from_bag = segment_of({.origin = {}, .direction = {0, -step, 0}}, extent);
      ASSERT_TRUE(from_bag) << extent << " " << step;
      EXPECT_GE(-from_bag->to.y, 4 * extent);
      EXPECT_LE(-from_bag->to.y, 16 * extent);
      const auto from_origin = segment_of({.origin = {extent, 0, 0}, .direction = {0, 0, step}}, 0);
      EXPECT_EQ(from_origin->to.z, -from_bag->to.y);
      EXPECT_EQ(from_origin->to.x, extent);
    }
  EXPECT_EQ(segment_of({.origin = {}, .direction = {0, 3, 0}}, 0)->to, (Vec3{0, 3, 0}));
}

TEST(SegmentOfRay, AnInfiniteNearBoundGoesBackAsFar) {
  const auto line = segment_of({.origin = {}, .direction = {1, -2, 0}, .t_min = -infinity}, 4);
  ASSERT_TRUE(line);
  EXPECT_EQ(line->from, (Vec3{-line->to.x, -line->to.y, 0}));
  EXPECT_EQ(line->to.y, -32);
}

TEST(SegmentOfRay, ThereIsNoneWhereItsEndsAreNoTwoPoints) {
  const Ray good{.origin = {1, 2, 3}, .direction = {1, 1, 1}};
  EXPECT_TRUE(segment_of(good, 1));
  for (const double bad : {not_a_number, infinity, -infinity})
    for (std::size_t i = 0; i < 6; ++i) {
      Ray spoilt = good;
      *coordinates(spoilt)[i] = bad;
      EXPECT_FALSE(segment_of(spoilt, 1));
    }
  Ray ray = good;
  ray.direction = {};
  EXPECT_FALSE(segment_of(ray, 1));
  ray = good, ray.t_min = not_a_number;
  EXPECT_FALSE(segment_of(ray, 1));
  ray = good, ray.t_max = not_a_number;
  EXPECT_FALSE(segment_of(ray, 1));
  ray = good, ray.t_min = ray.t_max = 2;
  EXPECT_FALSE(segment_of(ray, 1));
  ray = good, ray.direction = {0x1p-60, 0, 0}, ray.t_max = 1;
  EXPECT_FALSE(segment_of(ray, 1));  // its end is rounded to the origin
  EXPECT_FALSE(segment_of(good, 0x1p+1022));
  ray = {.origin = {-0x1.8p+1023, 0, 0}, .direction = {0x1.8p+1023, 1, 0}, .t_max = 1.875};
  EXPECT_FALSE(segment_of(ray, 1));  // a product overflows
}

TEST(SegmentOfRay, EmptyRangesAreToldApart) {
  const Ray ray{.origin = {}, .direction = {1, 0, 0}};
  const auto empty = [&](double t_min, double t_max) {
    return has_empty_range({.origin = {}, .direction = {1, 0, 0}, .t_min = t_min, .t_max = t_max});
  };
  EXPECT_FALSE(has_empty_range(ray));
  EXPECT_FALSE(empty(-infinity, infinity));
  EXPECT_FALSE(empty(1, 1));
  EXPECT_TRUE(empty(2, 1));
  EXPECT_TRUE(empty(infinity, infinity));
  EXPECT_TRUE(empty(-infinity, -infinity));
  EXPECT_FALSE(empty(not_a_number, 1));
}

TEST(SegmentOfRay, TheReachIsTheLargestCoordinate) {
  EXPECT_EQ(reach({}), 0);
  Triangle t{{1, 2, 3}, {4, -9, 6}, {7, 8, 5}};
  EXPECT_EQ(reach({.triangles = {t}}), 9);
  t.c.z = infinity;
  EXPECT_EQ(reach({.triangles = {t}}), std::nullopt);
}

}  // namespace
}  // namespace plumbline
