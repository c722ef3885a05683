#include "case/query.h"

#include <gtest/gtest.h>

#include <limits>

namespace plumbline {
namespace {

constexpr double largest = std::numeric_limits<double>::max();

TEST(Query, ARayIsAQueryWithoutATail) {
  const Ray ray{.origin = {1, 2, 3}, .direction = {4, 5, 6}, .t_min = -1, .t_max = 7};
  const Query query = ray;
  EXPECT_EQ(query.ray, ray);
  EXPECT_FALSE(query.has_tail());
}

TEST(Query, ThroughTwoPointsWhoseDifferenceIsANumber) {
  const auto query = query_through({1, 2, 3}, {4, 2, 0x1.8p+1}, 0, 1);
  ASSERT_TRUE(query);
  EXPECT_EQ(*query, Query(Ray{.origin = {1, 2, 3}, .direction = {3, 0, 0}, .t_min = 0, .t_max = 1}));
}

TEST(Query, KeepsWhatTheDifferenceLoses) {
  // 1 + 2^-53 is halfway between two numbers; the tie goes to 1, the even one.
  const auto query = query_through({-0x1p-53, 0x1p-60, -1}, {1, 1, 0x1p-1074}, 0, 1);
  ASSERT_TRUE(query);
  EXPECT_EQ(query->ray.direction, (Vec3{1, 1, 1}));
  EXPECT_EQ(query->direction_tail, (Vec3{0x1p-53, -0x1p-60, 0x1p-1074}));
  EXPECT_TRUE(query->has_tail());
}

TEST(Query, RefusesADifferenceThatOverflows) {
  EXPECT_FALSE(query_through({-largest, 0, 0}, {largest, 0, 0}, 0, 1));
  EXPECT_FALSE(query_through({0, 0, 0}, {0, std::numeric_limits<double>::infinity(), 0}, 0, 1));
  EXPECT_FALSE(query_through({0, 0, std::numeric_limits<double>::quiet_NaN()}, {0, 0, 1}, 0, 1));
  EXPECT_TRUE(query_through({largest, 0, 0}, {largest, 0, 1}, 0, 1));
}

}  // namespace
}  // namespace plumbline
