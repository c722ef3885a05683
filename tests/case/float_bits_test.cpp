#include "case/float_bits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace plumbline {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double least = 0x1p-1074, least_normal = 0x1p-1022, largest = 0x1.fffffffffffffp+1023;

TEST(FloatBits, TellsKindsApartByBits) {
  EXPECT_TRUE(is_nan(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_TRUE(is_nan(from_bits<double>(0x7ff0000000000001u)));  // signalling
  EXPECT_FALSE(is_nan(inf));
  EXPECT_FALSE(is_finite(-inf));
  EXPECT_TRUE(is_finite(largest));
  EXPECT_TRUE(is_zero(-0.0));
  EXPECT_FALSE(is_zero(least));
  EXPECT_TRUE(is_negative(-0.0));
}

TEST(FloatBits, OrdinalsOfNeighboursDifferByOne) {
  for (const double x : {0.0, least, -least, least_normal, 1.0, -1.0, 0x1p+52, 0x1.fffffffffffffp-1}) {
    EXPECT_EQ(ordinal(std::nextafter(x, inf)), ordinal(x) + 1) << x;
    EXPECT_EQ(to_bits(from_ordinal<double>(ordinal(x))), to_bits(x)) << x;
  }
  EXPECT_EQ(ordinal(-0.0), 0);
  EXPECT_EQ(ordinal(std::nextafterf(1.0f, 2.0f)), ordinal(1.0f) + 1);
}

TEST(FloatBits, StepsStopAtInfinity) {
  EXPECT_EQ(step_ulps(1.0, 1), 0x1.0000000000001p+0);
  EXPECT_EQ(step_ulps(1.0, -1), 0x1.fffffffffffffp-1);
  EXPECT_EQ(step_ulps(least, -2), -least);
  EXPECT_EQ(step_ulps(largest, 1), inf);
  EXPECT_EQ(step_ulps(largest, std::numeric_limits<std::int64_t>::max()), inf);
  EXPECT_EQ(step_ulps(-largest, -5), -inf);
  EXPECT_EQ(step_ulps(0x1.fffffep+127f, 1), std::numeric_limits<float>::infinity());
}

TEST(FloatBits, UlpExponent) {
  EXPECT_EQ(ulp_exponent(1.0), -52);
  EXPECT_EQ(ulp_exponent(0x1.fffffffffffffp-1), -53);
  EXPECT_EQ(ulp_exponent(0.0), -1074);
  EXPECT_EQ(ulp_exponent(least_normal), -1074);
  EXPECT_EQ(ulp_exponent(0x1p-1021), -1073);
  EXPECT_EQ(ulp_exponent(largest), 971);
  EXPECT_EQ(ulp_exponent(1.0f), -23);
  EXPECT_EQ(ulp_exponent(0x1p-149f), -149);
}

TEST(FloatBits, IsBinary32) {
  for (const double x : {0.0, -0.0, 1.0, 0x1.fffffep+127, 0x1p-149, -0x1.8p-148, 0x1.fffffcp-127, inf}) EXPECT_TRUE(is_binary32(x)) << x;
  for (const double x : {0x1.000001p+0, 0x1p+128, 0x1p-150, 0x1.8p-149, 0x1.fffffep-127, least, largest, 0.1})
    EXPECT_FALSE(is_binary32(x)) << x;
}

}  // namespace
}  // namespace plumbline
