#include "oracle/severity.h"

#include <gtest/gtest.h>

#include <limits>

namespace plumbline {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
const Triangle unit{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

double length(const Ray& ray, bool answered_hit) {
  const auto s = severity(unit, ray, answered_hit, Precision::binary64);
  return s ? s->length : -1;
}

TEST(Severity, OfAMissIsTheWayOutOverTheNearestEdge) {
  EXPECT_EQ(length({{0.25, 0x1p-4, 1}, {0, 0, -1}}, false), 0x1p-4);
  EXPECT_EQ(length({{0.5, 0.5, 1}, {0, 0, -1}}, false), 0.0);  // on the edge: the least translation is none
  // 1/4 from the legs, (1 - 1/2) / sqrt 2 = 0.35 from the hypotenuse
  EXPECT_EQ(length({{0.25, 0.25, 1}, {0, 0, -1}}, false), 0x1p-2);
}

TEST(Severity, OfAMissCountsTheEndsOfTheRange) {
  EXPECT_EQ(length({{0.25, 0.25, 0x1p-6}, {0, 0, -1}}, false), 0x1p-6);
  EXPECT_EQ(length({{0.25, 0.25, 1}, {0, 0, -1}, 0, 1 + 0x1p-9}, false), 0x1p-9);
  EXPECT_EQ(length({{0.25, 0.25, 0x1p-6}, {0, 0, -1}, -inf, inf}, false), 0x1p-2);
}

TEST(Severity, OfAHitIsTheDistanceBetweenRayAndTriangle) {
  EXPECT_EQ(length({{0.5, -0x1p-5, 1}, {0, 0, -1}}, true), 0x1p-5);          // ray and edge
  EXPECT_EQ(length({{-3, -4, 1}, {0, 0, -1}}, true), 5.0);                    // ray and vertex
  EXPECT_EQ(length({{0.25, 0.25, -2}, {0, 0, -1}}, true), 2.0);               // start and interior
  EXPECT_EQ(length({{0.25, 0.25, 3}, {0, 0, -1}, 0, 1}, true), 2.0);          // end and interior
  EXPECT_EQ(length({{0.5, -3, -4}, {0, 0, -1}}, true), 5.0);                  // start and edge
  EXPECT_EQ(length({{-1, -2, -2}, {0, 0, -1}}, true), 3.0);                   // start and vertex
  EXPECT_EQ(length({{-1, 0.25, 0x1p-7}, {1, 0, 0}}, true), 0x1p-7);           // parallel
  EXPECT_EQ(length({{-1, -0x1p-8, 0}, {1, 0, 0}}, true), 0x1p-8);             // coplanar, beside
  EXPECT_EQ(length({{2, 0, 1}, {-1, 0, 0}}, true), 1.0);                      // above, along an edge
}

TEST(Severity, IsRoundedCorrectly) {
  // The hypotenuse is 2^-20 / sqrt 2 away.
  EXPECT_EQ(length({{0.5, 0.5 + 0x1p-20, 1}, {0, 0, -1}}, true), 0x1.6a09e667f3bcdp-21);
}

TEST(Severity, InUlpsOfTheLargestCoordinateAtTheTracersPrecision) {
  const Ray ray{{0.5, -0x1p-20, 2}, {0, 0, -1}};
  EXPECT_EQ(severity(unit, ray, true, Precision::binary64)->ulps, 0x1p+31);  // ulp(2) = 2^-51
  EXPECT_EQ(severity(unit, ray, true, Precision::binary32)->ulps, 0x1p+2);   // ulp(2) = 2^-22
}

TEST(Severity, NothingForATrueAnswerOrWithoutGeometry) {
  const Ray inside{{0.25, 0.25, 1}, {0, 0, -1}}, outside{{2, 2, 1}, {0, 0, -1}};
  EXPECT_EQ(length(inside, true), -1);
  EXPECT_EQ(length(outside, false), -1);
  EXPECT_EQ(length({{-1, 0.25, 0}, {1, 0, 0}}, true), -1);   // coplanar contact: open
  EXPECT_EQ(length({{-1, 0.25, 0}, {1, 0, 0}}, false), -1);
  EXPECT_EQ(length({{0, 0, 1}, {0, 0, 0}}, true), -1);
  EXPECT_EQ(length({{2, 2, 1}, {0, 0, -1}, 1, 0}, true), -1);  // empty range
  EXPECT_FALSE(severity({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, outside, true, Precision::binary64));
}

TEST(Severity, ConditionChangesAtTwoToTheMinusTen) {
  const auto condition = [](const Triangle& t, const Ray& r) { return severity(t, r, false, Precision::binary64)->condition; };
  const Ray steep{{0.25, 0.25, 1}, {0, 0, -1}};
  EXPECT_TRUE(condition(unit, steep).nominal());
  // sin = 1 / sqrt(1 + s^2) against 2^-10: s = 1023 is above, s = 1024 below.
  EXPECT_FALSE(condition(unit, {{0.25 - 1023, 0.25, 1}, {1023, 0, -1}}).grazing);
  EXPECT_TRUE(condition(unit, {{0.25 - 1024, 0.25, 1}, {1024, 0, -1}}).grazing);
  // Altitude h over longest edge 1: exactly 2^-10 is still nominal.
  const auto sliver = [&](double h) {
    return condition({{0, 0, 0}, {1, 0, 0}, {0.5, h, 0}}, {{0.5, h / 2, 1}, {0, 0, -1}}).sliver;
  };
  EXPECT_FALSE(sliver(0x1p-10));
  EXPECT_TRUE(sliver(0x1.fffffffffffffp-11));
  // Longest edge sqrt 2 over the largest coordinate.
  const auto far = [&](double z) { return condition(unit, {{0.25, 0.25, z}, {0, 0, -1}}).far; };
  EXPECT_FALSE(far(1448));  // 1024 sqrt 2 = 1448.15..
  EXPECT_TRUE(far(1449));
}

TEST(WithinSlack, IsDecidedExactly) {
  const Ray outside{{0.5, -0x1p-4, 1}, {0, 0, -1}};
  EXPECT_TRUE(within_slack(unit, outside, 0x1p-4, 0));
  EXPECT_FALSE(within_slack(unit, outside, 0x1.fffffffffffffp-5, 0));
  // The longest edge is sqrt 2: 2^-4 <= r sqrt 2 from r = 2^-4 / sqrt 2 = 0x1.6a09e667f3bcc9...p-5 on.
  EXPECT_FALSE(within_slack(unit, outside, 0, 0x1.6a09e667f3bccp-5));
  EXPECT_TRUE(within_slack(unit, outside, 0, 0x1.6a09e667f3bcdp-5));
  // Half of it each: 2^-5 + r sqrt 2.
  EXPECT_FALSE(within_slack(unit, outside, 0x1p-5, 0x1.6a09e667f3bccp-6));
  EXPECT_TRUE(within_slack(unit, outside, 0x1p-5, 0x1.6a09e667f3bcdp-6));
}

TEST(WithinSlack, IsTrueOfARayThatMeetsTheTriangle) {
  EXPECT_TRUE(within_slack(unit, Ray{{0.25, 0.25, 1}, {0, 0, -1}}, 0, 0));
  EXPECT_TRUE(within_slack(unit, Ray{{0.5, 0, 1}, {0, 0, -1}, 0, 1}, 0, 0));
  EXPECT_TRUE(within_slack(unit, Ray{{-1, 0.25, 0}, {1, 0, 0}}, 0, 0));  // in the plane
  EXPECT_FALSE(within_slack({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, Ray{{1, 0, 1}, {0, 0, -1}}, 8, 8));
  EXPECT_FALSE(within_slack(unit, Ray{{0.25, 0.25, 1}, {0, 0, -1}, 1, 0}, 8, 8));
}

TEST(Severity, UlpsOfBinary32AreThoseOfTheCoordinateAsItIs) {
  // 0x1.fffffffp+0 would round up to 2; its binary32 ulp is 2^-23 all the same.
  const Triangle t{{0, 0, 0}, {0x1.fffffffp+0, 0, 0}, {0, 1, 0}};
  const Ray ray{{0.5, -0x1p-20, 1}, {0, 0, -1}};
  EXPECT_EQ(severity(t, ray, true, Precision::binary32)->ulps, 0x1p+3);
  const Triangle huge{{0, 0, 0}, {0x1p+130, 0, 0}, {0, 1, 0}};
  EXPECT_EQ(severity(huge, ray, true, Precision::binary32)->ulps, 0x1p-127);
}

}  // namespace
}  // namespace plumbline
