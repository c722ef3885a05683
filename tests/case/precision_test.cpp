#include "case/precision.h"

#include <gtest/gtest.h>

#include <limits>

namespace plumbline {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(AtPrecision, RoundsToNearestTiesToEven) {
  for (const auto& [x, rounded] : {std::pair(0x1.000001p+0, 0x1p+0),
                                   {0x1.0000010000001p+0, 0x1.000002p+0},
                                   {0x1.000003p+0, 0x1.000004p+0},
                                   {-0x1.ffffffp+0, -0x1p+1},
                                   {0x1p-149, 0x1p-149},
                                   {0x1p-150, 0.0},
                                   {0x1.8p-149, 0x1p-148},
                                   {0x1.fffffefffffffp+127, 0x1.fffffep+127},
                                   {0x1.ffffffp+127, infinity}}) {
    EXPECT_EQ(at_precision(x, Precision::binary32), rounded) << x;
    EXPECT_EQ(at_precision(x, Precision::binary64), x);
  }
}

// One by one: a compiler was seen to round some coordinates of a point only.
TEST(AtPrecision, RoundsEveryNumberOfACase) {
  constexpr double x = 0x1.00000001p+0, r = 0x1p+0;
  const Vec3 point{x, 2 * x, 4 * x}, rounded{r, 2 * r, 4 * r};
  EXPECT_EQ(at_precision(point, Precision::binary32), rounded);
  EXPECT_EQ(at_precision(Triangle{point, point, point}, Precision::binary32), (Triangle{rounded, rounded, rounded}));
  EXPECT_EQ(at_precision(Ray{point, point, x, 2 * x}, Precision::binary32), (Ray{rounded, rounded, r, 2 * r}));
  const Bag bag = at_precision(Bag{.triangles = {{point, point, point}}, .thickness = x}, Precision::binary32);
  EXPECT_EQ(bag.triangles.front(), (Triangle{rounded, rounded, rounded}));
  EXPECT_EQ(bag.thickness, r);
  EXPECT_EQ(at_precision(point, Precision::binary64), point);
}

}  // namespace
}  // namespace plumbline
