// t, u and v rounded: halfway ties, subnormals and overflow, in both precisions.
#include <gtest/gtest.h>

#include <cmath>

#include "oracle/measure.h"
#include "tests/judges/rational_judge.h"

namespace plumbline::judges {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

// The plane z = height, hit from the origin along (0, 0, slope): t = height / slope.
Coordinates<double> t_of(double height, double slope) {
  const Triangle triangle{{-1, -1, height}, {3, -1, height}, {-1, 3, height}};
  return *measure<double>(triangle, Ray{{0, 0, 0}, {0, 0, slope}});
}
Coordinates<float> t32_of(double height, double slope) {
  const Triangle triangle{{-1, -1, height}, {3, -1, height}, {-1, 3, height}};
  return *measure<float>(triangle, Ray{{0, 0, 0}, {0, 0, slope}});
}

TEST(Rounding, TiesGoToEven) {
  // 2^53 + 1 and 2^53 + 3, as heights seen from z = -1: the exact t is a tie of binary64.
  const auto from_below = [](double height) {
    const Triangle triangle{{-1, -1, height}, {3, -1, height}, {-1, 3, height}};
    return measure<double>(triangle, Ray{{0, 0, -1}, {0, 0, 1}})->t;
  };
  EXPECT_EQ(from_below(0x1p+53), 0x1p+53);
  EXPECT_EQ(from_below(0x1.0000000000001p+53), 0x1.0000000000002p+53);
  EXPECT_EQ(from_below(-0x1p+54), -0x1p+54);
  // binary32 ties that rounding by way of binary64 gets wrong: 1 + 2^-24 + 2^-60 is just above the tie.
  EXPECT_EQ(t32_of(0x1.000001p+0, 1).t, 0x1p+0f);
  EXPECT_EQ(t32_of(0x1.000003p+0, 1).t, 0x1.000004p+0f);
  const Triangle above{{-1, -1, 0x1.000001p+0}, {3, -1, 0x1.000001p+0}, {-1, 3, 0x1.000001p+0}};
  EXPECT_EQ(measure<float>(above, Ray{{0, 0, -0x1p-60}, {0, 0, 1}})->t, 0x1.000002p+0f);
  EXPECT_EQ(measure<float>(above, Ray{{0, 0, 0x1p-60}, {0, 0, 1}})->t, 0x1p+0f);
}

TEST(Rounding, SubnormalsRoundAsSubnormals) {
  EXPECT_EQ(t_of(0x1p-1074, 1).t, 0x1p-1074);
  EXPECT_EQ(t_of(0x1p-1074, 2).t, 0.0);               // half of the least: tie to even zero
  EXPECT_EQ(t_of(0x1.8p-1073, 2).t, 0x1p-1073);       // 1.5 units: tie to 2
  EXPECT_EQ(t_of(-0x1p-1074, 1.5).t, -0x1p-1074);     // 2/3 of the least
  EXPECT_TRUE(std::signbit(t_of(-0x1p-1074, 4).t));   // rounds to -0
  EXPECT_EQ(t_of(0x1.fffffffffffffp-1022, 2).t, 0x1p-1022);  // largest subnormal + 1/2: carries into the normals
  EXPECT_EQ(t32_of(0x1p-149, 1).t, 0x1p-149f);
  EXPECT_EQ(t32_of(0x1p-150, 1).t, 0.0f);
  EXPECT_EQ(t32_of(0x1.8p-150, 1).t, 0x1p-149f);
  EXPECT_EQ(t32_of(0x1p-600, 1).t, 0.0f);
}

TEST(Rounding, BeyondTheLargestIsInfinite) {
  EXPECT_EQ(t_of(0x1.fffffffffffffp+1023, 1).t, 0x1.fffffffffffffp+1023);
  EXPECT_EQ(t_of(0x1.fffffffffffffp+1023, 0x1.fffffffffffffp-1).t, inf);  // exactly 2^1024
  EXPECT_EQ(t_of(-0x1p+1023, 0x1p-1074).t, -inf);
  EXPECT_EQ(t32_of(0x1.fffffep+127, 1).t, 0x1.fffffep+127f);
  EXPECT_EQ(t32_of(0x1.fffffefffffffp+127, 1).t, 0x1.fffffep+127f);  // just below the midpoint past the largest
  EXPECT_EQ(t32_of(0x1.ffffffp+127, 1).t, std::numeric_limits<float>::infinity());  // the midpoint
}

TEST(Rounding, TheCheckerItselfRejectsNeighbours) {
  const Rational third = Rational(1) / 3;
  const double nearest = 0x1.5555555555555p-2;
  EXPECT_TRUE(is_rounded(third, nearest));
  EXPECT_FALSE(is_rounded(third, std::nextafter(nearest, 1)));
  EXPECT_FALSE(is_rounded(third, std::nextafter(nearest, 0)));
  EXPECT_FALSE(is_rounded(third, -nearest));
  EXPECT_TRUE(is_rounded(Rational(1) + Rational(0x1p-53), 1.0));
  EXPECT_FALSE(is_rounded(Rational(1) + Rational(0x1p-53), 0x1.0000000000001p+0));
  EXPECT_TRUE(is_rounded_sqrt(Rational(2), 0x1.6a09e667f3bcdp+0));
  EXPECT_FALSE(is_rounded_sqrt(Rational(2), 0x1.6a09e667f3bccp+0));
}

}  // namespace
}  // namespace plumbline::judges
