#include "oracle/sensitivity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "case/hard_families.h"
#include "case/random.h"
#include "oracle/measure.h"

namespace plumbline {
namespace {

const Triangle unit{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

TEST(Sensitivity, ByHand) {
  // t = O_z / -D_z: each of the two changes t by eps. u = O_x / B_x, v = O_y / C_y.
  const auto s = sensitivity(unit, Ray{{0.25, 0.25, 1}, {0, 0, -1}});
  ASSERT_TRUE(s);
  EXPECT_EQ(s->t, 2.0);
  EXPECT_EQ(s->u, 0.5);
  EXPECT_EQ(s->v, 0.5);
  EXPECT_EQ(s->w, 1.0);
}

TEST(Sensitivity, GrowsWithTheDistanceFromZeroAndWithTheAngle) {
  // Moved by 2^20, z of origin and vertices is 2^20 + 1 and 2^20: t changes by their changes.
  const Triangle far{{0, 0, 0x1p+20}, {1, 0, 0x1p+20}, {0, 1, 0x1p+20}};
  EXPECT_EQ(sensitivity(far, Ray{{0.25, 0.25, 0x1p+20 + 1}, {0, 0, -1}})->t, 0x1p+21 + 2);
  // Along the plane, down by 2^-20 of the way: t = 1, but x and y of nothing matter to t.
  EXPECT_EQ(sensitivity(unit, Ray{{-0.5, 0.25, 0x1p-20}, {1, 0, -0x1p-20}})->t, 2.0);
  EXPECT_EQ(sensitivity(unit, Ray{{-0.5, 0.25, 0x1p-20}, {1, 0, -0x1p-20}})->u, 0.5 + 1 + 0.5 + 2);
}

TEST(Sensitivity, ThereIsNoneWithoutAPointOfThePlane) {
  EXPECT_FALSE(sensitivity(unit, Ray{{0, 0, 1}, {1, 0, 0}}));
  EXPECT_FALSE(sensitivity({}, Ray{{0, 0, 1}, {1, 0, 0}}));
  EXPECT_FALSE(sensitivity(unit, Ray{{0, 0, 1}, {0, 0, 0}}));
}

std::array<double*, 15> numbers(Triangle& t, Ray& r) {
  return {&t.a.x,      &t.a.y,      &t.a.z,      &t.b.x,         &t.b.y,         &t.b.z,        &t.c.x, &t.c.y, &t.c.z,
          &r.origin.x, &r.origin.y, &r.origin.z, &r.direction.x, &r.direction.y, &r.direction.z};
}

std::array<double, 4> values(const Triangle& triangle, const Ray& ray) {
  const auto at = *measure<double>(triangle, ray);
  return {at.t, at.u, at.v, 1 - at.u - at.v};
}

// No small change moves t, u, v, w farther, and the worst choice of signs comes as far.
TEST(Sensitivity, IsTheMostThatRelativeChangesDo) {
  constexpr double eps = 0x1p-26;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const Shot shot = draw(Family::random, 3, i);
    const auto s = sensitivity(shot.triangle, shot.ray);
    if (!s || s->t > 0x1p+10) continue;
    const std::array<double, 4> expected = {s->t, s->u, s->v, s->w}, before = values(shot.triangle, shot.ray);
    for (std::size_t k = 0; k < 4; ++k) {
      Triangle worst = shot.triangle;
      Ray ray = shot.ray;
      for (std::size_t x = 0; x < 15; ++x) {
        Triangle t = shot.triangle;
        Ray r = shot.ray;
        *numbers(t, r)[x] *= 1 + eps;
        *numbers(worst, ray)[x] *= values(t, r)[k] > before[k] ? 1 + eps : 1 - eps;
      }
      const double moved = (values(worst, ray)[k] - before[k]) / eps;
      EXPECT_NEAR(moved, expected[k], expected[k] * 0x1p-12) << i << " " << k;
      Random random(7, i);
      for (int again = 0; again < 20; ++again) {
        Triangle t = shot.triangle;
        Ray r = shot.ray;
        for (double* x : numbers(t, r)) *x *= 1 + eps * random.unit();
        EXPECT_LE(std::abs(values(t, r)[k] - before[k]) / eps, expected[k] * (1 + 0x1p-12)) << i << " " << k;
      }
    }
  }
}

}  // namespace
}  // namespace plumbline
