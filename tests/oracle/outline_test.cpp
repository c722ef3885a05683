#include "oracle/outline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace plumbline {
namespace {

const Triangle unit{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

void expect_point(const Point2& p, double x, double y) {
  EXPECT_EQ(p.x, x);
  EXPECT_EQ(p.y, y);
}

TEST(Outline, FromAboveBothViewsAreTheSame) {
  const Ray down{{0.25, 0.5, 1}, {0, 0, -2}};
  for (const auto& seen : {seen_along_ray(unit, down, 0), seen_flat(unit, down, 0)}) {
    ASSERT_TRUE(seen);
    // c is above ab whichever way it is looked at: from below, b is on the left.
    const double side = seen->corner[1].x > seen->corner[0].x ? 1 : -1;
    expect_point(seen->corner[0], side * -0.25, -0.5);
    expect_point(seen->corner[1], side * 0.75, -0.5);
    expect_point(seen->corner[2], side * -0.25, 0.5);
    expect_point(seen->edge[0], side * 1, 0);
    expect_point(seen->edge[1], side * -1, 1);
    expect_point(seen->edge[2], 0, -1);
  }
}

TEST(Outline, AnyEdgeRunsToTheRight) {
  const Ray down{{0.25, 0.25, 1}, {0, 0, -1}};
  for (unsigned base = 0; base < 3; ++base) {
    const auto seen = seen_flat(unit, down, base);
    EXPECT_EQ(seen->edge[base].y, 0);
    EXPECT_EQ(std::abs(seen->edge[base].x), base == 1 ? 0x1.6a09e667f3bcdp+0 : 1);
    EXPECT_GT(seen->corner[(base + 2) % 3].y, seen->corner[base].y);
  }
}

TEST(Outline, AlongASlantedRayTheTriangleIsNarrower) {
  const Ray slanted{{0, 0.25, 1}, {1, 0, -1}};         // 45 degrees, in the plane of x and z; it meets (1, 0.25, 0)
  const auto seen = seen_along_ray(unit, slanted, 2);  // ca stays as it is
  EXPECT_EQ(std::abs(seen->edge[2].x), 1);
  EXPECT_EQ(seen->corner[1].y - seen->corner[0].y, 0x1.6a09e667f3bcdp-1);
  EXPECT_EQ(seen->corner[0].y, -0x1.6a09e667f3bcdp-1);
}

TEST(Outline, AnUlpIsSeen) {
  const Ray beside{{0.5, -0x1p-60, 1}, {0, 0, -1}};
  EXPECT_EQ(seen_along_ray(unit, beside, 0)->corner[0].y, 0x1p-60);
  EXPECT_EQ(seen_flat(unit, beside, 0)->corner[0].y, 0x1p-60);
  EXPECT_EQ(std::abs(seen_flat(unit, beside, 0)->corner[0].x), 0.5);
}

TEST(Outline, NoneWhereThereIsNoCrossing) {
  EXPECT_FALSE(seen_along_ray(unit, Ray{{0, 0, 1}, {1, 0, 0}}, 0));
  EXPECT_FALSE(seen_flat(unit, Ray{{0, 0, 0}, {1, 0, 0}}, 0));
  EXPECT_FALSE(seen_flat({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, Ray{{0, 0, 1}, {0, 0, -1}}, 0));
  EXPECT_FALSE(seen_along_ray(unit, Ray{{0, 0, 1}, {0, 0, 0}}, 0));
}

TEST(HeightAbovePlane, HasASignAndAnUlp) {
  const Ray down{{0.25, 0.25, 1}, {0, 0, -1}};
  EXPECT_EQ(height_above_plane(unit, down, 0), 1);
  EXPECT_EQ(height_above_plane(unit, down, 1), 0);
  EXPECT_EQ(height_above_plane(unit, down, 0x1.8p+0), -0.5);
  EXPECT_EQ(height_above_plane(unit, down, 0x1.0000000000001p+0), -0x1p-52);
  EXPECT_EQ(height_above_plane(unit, Ray{{0, 0, 0x1p-1074}, {1, 0, 0}}, 7), 0x1p-1074);  // beside the plane
  EXPECT_FALSE(height_above_plane(unit, down, std::numeric_limits<double>::infinity()));
  EXPECT_FALSE(height_above_plane({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, down, 1));
}

}  // namespace
}  // namespace plumbline
