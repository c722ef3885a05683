// Rays whose exact direction has two parts: class, range and numbers against mpq.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "case/float_bits.h"
#include "oracle/classify.h"
#include "oracle/explain.h"
#include "oracle/measure.h"
#include "oracle/severity.h"
#include "tests/judges/mpq_judge.h"
#include "tests/judges/print.h"
#include "tests/judges/seed.h"
#include "tests/oracle/float_environment.h"
#include "tests/oracle/grid_shots.h"

namespace plumbline {
namespace {

Vec3 point(Random& random) {
  const auto x = [&] {
    const auto significand = static_cast<double>(static_cast<std::int64_t>(random()));
    return std::ldexp(significand, static_cast<int>(random() % 20) - 70);
  };
  const double a = x(), b = x(), c = x();
  return {a, b, c};
}

// A ray through a double near the point of the triangle's plane that the shot aims at: its direction seldom is a double.
std::optional<Query> query_of(const Shot& shot) {
  const auto at = measure<double>(shot.triangle, shot.ray);
  const double t = at && is_finite(at->t) ? at->t : 1;
  const Vec3& o = shot.ray.origin;
  const Vec3& d = shot.ray.direction;
  return query_through(o, {o.x + t * d.x, o.y + t * d.y, o.z + t * d.z}, shot.ray.t_min, 1);
}

TEST(Query, ClassAgreesWithMpqInEveryFamily) {
  const std::uint64_t seed = judges::seed();
  std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
  int tails = 0;
  for (std::size_t family = 0; family < family_names.size(); ++family)
    for (std::uint64_t i = 0; i < 3000; ++i) {
      const Shot shot = draw(static_cast<Family>(family), seed, i);
      const auto query = query_of(shot);
      if (!query || query->ray.direction == Vec3{}) continue;
      tails += query->has_tail();
      ASSERT_EQ(classify(shot.triangle, *query), judges::mpq_truth(shot.triangle, *query))
          << family_names[family] << ' ' << i << '\n' << explain(shot.triangle, *query);
    }
  EXPECT_GT(tails, 5000);
}

// Vertices, edges and the end of the range are met exactly: the second point is on them.
TEST(Query, SecondPointsOnTheBoundaryAreMetExactly) {
  Random random(judges::seed() + 1);
  for (int i = 0; i < 2000; ++i) {
    const Triangle triangle{point(random), point(random), point(random)};
    const auto query = query_through(point(random), triangle.b, 0, 1);
    ASSERT_TRUE(query);
    const Truth truth = classify(triangle, *query);
    if (truth.hit_class == HitClass::degenerate || truth.hit_class == HitClass::coplanar) continue;
    EXPECT_EQ(truth.feature, Feature::b);
    EXPECT_EQ(truth.versus_t_max, 0);
    EXPECT_EQ(measure<double>(triangle, *query)->t, 1);
    EXPECT_EQ(measure<double>(triangle, *query)->u, 1);
    EXPECT_FALSE(severity(triangle, *query, true, Precision::binary64));
  }
}

// The tail decides: without it the ray would pass beside the vertex.
TEST(Query, TheTailCounts) {
  const Triangle triangle{{1, 1, 1}, {4, 0, 1}, {0, 4, 1}};
  const auto query = query_through({-0x1p-60, 0, 0}, triangle.a, 0, 1);
  ASSERT_TRUE(query);
  EXPECT_EQ(query->direction_tail, (Vec3{0x1p-60, 0, 0}));
  EXPECT_EQ(classify(triangle, *query).feature, Feature::a);
  EXPECT_EQ(classify(triangle, query->ray).feature, Feature::none);
}

TEST(Query, IsInvalidAsItsRay) {
  const Triangle triangle{{1, 1, 1}, {4, 0, 1}, {0, 4, 1}};
  Query query = Ray{.origin = {0, 0, 0}, .direction = {1, NAN, 1}};
  query.direction_tail = {0, 0x1p-70, 0};
  EXPECT_EQ(classify(triangle, query).invalid, Invalid::direction_not_finite);
  EXPECT_FALSE(measure<double>(triangle, query));
}

TEST(Query, ASubnormalTailCountsInEveryEnvironment) {
  const Triangle triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  Query query = Ray{.origin = {0.25, 0, 1}, .direction = {0, 0, -1}};
  query.direction_tail = {0, -0x1p-1074, 0};
  for (const FloatEnvironment& environment : float_environments()) {
    SCOPED_TRACE(testing::Message() << environment);
    Truth truth;
    {
      const FloatScope scope(environment);
      truth = classify(triangle, query);
    }
    EXPECT_EQ(truth.hit_class, HitClass::exterior);
  }
}

}  // namespace
}  // namespace plumbline
