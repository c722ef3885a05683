#include "oracle/offset.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "case/hard_families.h"
#include "oracle/classify.h"

namespace plumbline {
namespace {

const Triangle flat{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};    // its front is +z
const Triangle steep{{0, 0, 0}, {1, 0, 0}, {0, 1, 3}};   // N = (0, -3, 1)

Vec3 moved(const Triangle& triangle, const Vec3& point, double distance, Precision precision = Precision::binary64) {
  return moved_off(triangle, point, {&distance, 1}, precision).at(0);
}

TEST(Offset, GoesAlongTheNormal) {
  EXPECT_EQ(moved(flat, {0x1p-2, 0x1p-2, 0}, 0x1p-52), (Vec3{0x1p-2, 0x1p-2, 0x1p-52}));
  EXPECT_EQ(moved(flat, {0x1p-2, 0x1p-2, 0x1p+0}, -0x1p-53), (Vec3{0x1p-2, 0x1p-2, 0x1.fffffffffffffp-1}));
  EXPECT_EQ(moved({flat.a, flat.c, flat.b}, {0, 0, 0}, 0x1p+0), (Vec3{0, 0, -0x1p+0}));
  EXPECT_EQ(moved(flat, {0x1.8p+0, -0x1p-3, 0x1p+3}, 0), (Vec3{0x1.8p+0, -0x1p-3, 0x1p+3}));
}

TEST(Offset, TheLargestComponentMovesByTheDistance) {
  EXPECT_EQ(moved(steep, {0, 0, 0}, 0x1.8p+1), (Vec3{0, -0x1.8p+1, 0x1p+0}));
  // Seen from behind, and a third that is rounded.
  EXPECT_EQ(moved(steep, {0, 0, 0}, -0x1p+0), (Vec3{0, 0x1p+0, -0x1.5555555555555p-2}));
}

TEST(Offset, EachCoordinateIsRoundedOnce) {
  EXPECT_EQ(moved(steep, {0, 0, 0}, 0x1p+0, Precision::binary32), (Vec3{0, -0x1p+0, 0x1.555556p-2}));
  // 1 + 2^-24 + 2^-54 / 3 is above the tie in binary32, but not once it is rounded to binary64.
  const Vec3 up = moved(steep, {0, 0, 0x1.000001p+0}, 0x1p-54, Precision::binary32);
  EXPECT_EQ(up, (Vec3{0, -0x1p-54, 0x1.000002p+0}));
  EXPECT_EQ(moved(flat, {0, 0, 0x1p+0}, 0x1p-53), (Vec3{0, 0, 0x1p+0}));  // a tie, to even
}

TEST(Offset, SubnormalsAndOverflow) {
  EXPECT_EQ(moved(flat, {0, 0, 0}, 0x1p-1074), (Vec3{0, 0, 0x1p-1074}));
  EXPECT_EQ(moved(flat, {0, 0, 0}, 0x1p+128, Precision::binary32).z, std::numeric_limits<double>::infinity());
}

TEST(Offset, OfWhatHasNoNormalIsEmpty) {
  constexpr double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  const std::array distances = {0x1p+0, 0x1p+1};
  EXPECT_EQ(moved_off(flat, {0, 0, 0}, distances, Precision::binary64).size(), 2u);
  EXPECT_TRUE(moved_off({flat.a, flat.b, flat.b}, {0, 0, 0}, distances, Precision::binary64).empty());
  EXPECT_TRUE(moved_off({flat.a, flat.b, {0, inf, 0}}, {0, 0, 0}, distances, Precision::binary64).empty());
  EXPECT_TRUE(moved_off(flat, {0, nan, 0}, distances, Precision::binary64).empty());
  const std::array infinite = {0x1p+0, inf};
  EXPECT_TRUE(moved_off(flat, {0, 0, 0}, infinite, Precision::binary64).empty());
}

// From a vertex, which lies in the plane exactly: far enough for rounding not to matter, the front is the front.
TEST(Offset, IsOnTheSideThatItSays) {
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const Triangle t = draw(Family::random, 7, i).triangle;
    for (const double distance : {0x1p-20, -0x1p-20}) {
      const Vec3 p = moved(t, t.a, distance);
      const Truth back_to_a = classify(t, Ray{p, {t.a.x - p.x, t.a.y - p.y, t.a.z - p.z}});
      EXPECT_EQ(back_to_a.det_sign, distance > 0 ? -1 : 1) << i;
    }
  }
}

}  // namespace
}  // namespace plumbline
