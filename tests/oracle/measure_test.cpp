#include "oracle/measure.h"

#include <gtest/gtest.h>

#include <limits>

namespace plumbline {
namespace {

const Triangle unit{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

TEST(Measure, WeightsOfBAndC) {
  const auto at = measure<double>(unit, Ray{{0.25, 0.5, 3}, {0, 0, -2}});
  ASSERT_TRUE(at);
  EXPECT_EQ(at->t, 0x1.8p+0);
  EXPECT_EQ(at->u, 0x1p-2);
  EXPECT_EQ(at->v, 0x1p-1);
}

TEST(Measure, IsRoundedFromTheFractionInEachPrecision) {
  const Ray third{{0, 0, 1}, {0.25, 0.25, -3}};
  EXPECT_EQ(measure<double>(unit, third)->t, 0x1.5555555555555p-2);
  EXPECT_EQ(measure<float>(unit, third)->t, 0x1.555556p-2f);
  EXPECT_EQ(exact_t(unit, third), "1/3");
}

TEST(Measure, IsThereOutsideTheTriangleAndOutsideTheRange) {
  const Ray outside{{-4, 7, -1}, {0, 0, -1}, 0, 1};
  const auto at = measure<double>(unit, outside);
  ASSERT_TRUE(at);
  EXPECT_EQ(at->t, -1.0);
  EXPECT_EQ(at->u, -4.0);
  EXPECT_EQ(at->v, 7.0);
  EXPECT_EQ(exact_t(unit, outside), "-1/1");
}

TEST(Measure, ExactTIsInLowestTermsWithAPositiveDenominator) {
  EXPECT_EQ(exact_t(unit, Ray{{0, 0, 0}, {0, 0, -1}}), "0/1");
  EXPECT_EQ(exact_t(unit, Ray{{0, 0, 6}, {0, 0, 4}}), "-3/2");
  EXPECT_EQ(exact_t(unit, Ray{{0, 0, 0x1p-3}, {0, 0, -0x1p+3}}), "1/64");
}

TEST(Measure, NothingWhereTheLineDoesNotCross) {
  for (const Ray& ray : {Ray{{0, 0, 1}, {1, 0, 0}}, Ray{{0, 0, 0}, {1, 0, 0}}, Ray{{0, 0, 1}, {0, 0, 0}},
                         Ray{{0, 0, std::numeric_limits<double>::infinity()}, {0, 0, 1}}}) {
    EXPECT_FALSE(measure<double>(unit, ray));
    EXPECT_FALSE(exact_t(unit, ray));
  }
  EXPECT_FALSE(measure<double>({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, Ray{{0, 0, 1}, {0, 0, -1}}));
}

TEST(HitPoint, IsRoundedFromTheFractionNotFromT) {
  // t = 1/3, along (1, 1, -3): x = y = 1/3 + 1/4 * 2^-52 from an origin off by that; z = 0 exactly.
  const Ray ray{{0x1p-54, 0, 1}, {1, 1, -3}};
  const auto point = hit_point<double>(unit, ray);
  ASSERT_TRUE(point);
  EXPECT_EQ((*point)[0], 0x1.5555555555556p-2);  // 0x1.5555..55|55.. + 2^-54 = one quarter ulp past a third: rounds up
  EXPECT_EQ((*point)[1], 0x1.5555555555555p-2);
  EXPECT_EQ((*point)[2], 0.0);
  EXPECT_EQ((*hit_point<float>(unit, ray))[1], 0x1.555556p-2f);
  EXPECT_FALSE(hit_point<double>(unit, Ray{{0, 0, 1}, {1, 0, 0}}));
}

}  // namespace
}  // namespace plumbline
