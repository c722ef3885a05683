#include "oracle/program_point.h"

#include <gtest/gtest.h>

namespace plumbline {
namespace {

TEST(ProgramPoint, EachOperationIsRounded) {
  // 1 + t * 3 with t = 2^-24 + 2^-47: the product is rounded to 3 * 2^-24 + 2^-45, the sum is a tie or just above it.
  const Ray ray{{0x1p+0, 0, -0x1.8p+0}, {0x1.8p+1, 0x1p+0, 0}};
  EXPECT_EQ(point_at(ray, 0x1.000002p-24, Precision::binary32), (Vec3{0x1.000004p+0, 0x1.000002p-24, -0x1.8p+0}));
  EXPECT_EQ(point_at(ray, 0x1.000002p-24, Precision::binary64),
            (Vec3{0x1.000003000006p+0, 0x1.000002p-24, -0x1.8p+0}));
  // Contracted it would be 2^-46: (1 + 2^-23)^2 - (1 + 2^-22).
  const Ray cancels{{-0x1.000004p+0, 0, 0}, {0x1.000002p+0, 0, 0}};
  EXPECT_EQ(point_at(cancels, 0x1.000002p+0, Precision::binary32).x, 0);
  EXPECT_EQ(point_at(cancels, 0x1.000002p+0, Precision::binary64).x, 0x1p-46);
}

TEST(ProgramPoint, OfWeightsGoesFromA) {
  const Triangle t{{0x1p+0, 0, 0x1p+24}, {0x1p+1, 0, 0}, {0x1p+0, 0x1p+2, 0}};
  EXPECT_EQ(point_at(t, 0, 0, Precision::binary32), t.a);
  EXPECT_EQ(point_at(t, 0x1p-1, 0x1p-2, Precision::binary64), (Vec3{0x1.8p+0, 0x1p+0, 0x1p+22}));
  // b - a is 2^24 + 1, which binary32 hasn't.
  const Triangle far{{-0x1p+0, 0, 0}, {0x1p+24, 0, 0}, {0, 0x1p+0, 0}};
  EXPECT_EQ(point_at(far, 0x1p+0, 0, Precision::binary32).x, 0x1.fffffep+23);
  EXPECT_EQ(point_at(far, 0x1p+0, 0, Precision::binary64).x, 0x1p+24);
}

}  // namespace
}  // namespace plumbline
