#include "oracle/hit_errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "oracle/measure.h"

namespace plumbline {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
const Triangle unit{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
const Ray third{{0, 0, 1}, {0.25, 0.25, -3}};  // t = 1/3, u = v = 1/12; the largest coordinate is 1

HitErrors errors(const Ray& ray, double t, double u, double v, Precision precision = Precision::binary64) {
  return *hit_errors(unit, ray, {.t = t, .uv = {{u, v}}}, precision);
}

TEST(HitErrors, AreDistancesInUnitsOfTheExactValue) {
  const auto best = *measure<double>(unit, third);
  const HitErrors e = errors(third, best.t, best.u, best.v);
  EXPECT_EQ(e.t, 0x1.5555555555555p-2);  // a third of an ulp: 0x1.5555555555555p-2 is (1 - 2^-54) / 3
  EXPECT_EQ(e.t_off, 0x1.5555555555555p-56);
  const HitErrors off = errors(third, best.t + 0x1p-52, best.u, -best.v);
  EXPECT_EQ(off.t, 0x1.d555555555555p+1);  // 4 ulp above, less a third
  EXPECT_EQ(off.u, e.u);
  EXPECT_GT(off.v, 0x1p+50);
  EXPECT_DOUBLE_EQ(off.v_off, 1.0 / 6);
  EXPECT_EQ(errors(third, 0x1.555556p-2, 0, 0, Precision::binary32).t, 0x1.5555555555555p-2);
}

TEST(HitErrors, OfZeroAreInLeastNormals) {
  const Ray on_plane{{0.25, 0.25, 0}, {0, 0, -1}};
  EXPECT_EQ(errors(on_plane, 0x1p-1020, 0.25, 0.25).t, 4.0);
  EXPECT_EQ(errors(on_plane, 0x1p-126, 0.25, 0.25, Precision::binary32).t, 1.0);
  EXPECT_EQ(errors(on_plane, -0.0, 0.25, 0.25).t, 0.0);
}

TEST(HitErrors, LengthsAreInUlpsOfTheLargestCoordinate) {
  const Ray down{{0.25, 0.5, 2}, {0, 0, -2}};  // the largest coordinate is 2, whose ulp is 2^-51; t = 1
  const HitErrors e = errors(down, 1 + 0x1p-52, 0.25 + 0x1p-40, 0.5);
  EXPECT_EQ(e.point, 0x1p+11);
  EXPECT_EQ(e.residual, 1.0);  // 2 * 2^-52
  EXPECT_EQ(e.start, 1.0);
  EXPECT_EQ(errors(down, 1, 0.25, 0.5 - 0x1p-10).point, 0x1p+41);
  EXPECT_EQ(errors(down, 1, 0.25, 0.5 - 0x1p-10, Precision::binary32).point, 0x1p+12);
  // A plane at 45 degrees: the residual is counted across it, not along the ray.
  const Triangle tilted{{0, 0, 0}, {1, 0, 0}, {0, 1, 1}};
  const auto across = hit_errors(tilted, Ray{{0.25, 0.25, 1}, {0, 0, -1}}, {.t = 0.75 + 0x1p-20, .uv = {}},
                                 Precision::binary64);
  EXPECT_DOUBLE_EQ(across->residual, 0x1p+32 / std::sqrt(2));
}

TEST(HitErrors, AProgramsPointIsRounded) {
  // 1/3 of (1/4, 1/4, -3) from (0, 0, 1): the exact z is 0, that with t rounded down is 2^-54, rounded it is 0.
  const auto t = measure<double>(unit, third)->t;
  const HitErrors e = errors(third, t, 0, 0);
  EXPECT_EQ(e.residual, 0x1p-2);  // (1 - 3 t) over 2^-52
  EXPECT_EQ(e.start, 0.0);
}

TEST(HitErrors, OfNoNumberAreInfinite) {
  const HitErrors e = errors({{0.25, 0.25, 1}, {0, 0, -1}}, nan, inf, 0.25);
  EXPECT_EQ(e.t, inf);
  EXPECT_EQ(e.u, inf);
  EXPECT_EQ(e.v, 0.0);
  EXPECT_EQ(e.point, inf);
  EXPECT_EQ(e.residual, inf);
  EXPECT_EQ(e.start, inf);
}

TEST(HitErrors, OfNothingSaidAreNaN) {
  const auto e = hit_errors(unit, third, {}, Precision::binary64);
  ASSERT_TRUE(e);
  for (const double x : {e->t, e->u, e->v, e->t_off, e->point, e->residual, e->start}) EXPECT_TRUE(std::isnan(x));
}

TEST(HitErrors, AreThereWhereThePlaneIsMet) {
  EXPECT_FALSE(hit_errors(unit, Ray{{0, 0, 1}, {1, 0, 0}}, {.t = 1, .uv = {}}, Precision::binary64));
  EXPECT_FALSE(hit_errors({}, third, {.t = 1, .uv = {}}, Precision::binary64));
  EXPECT_FALSE(hit_errors(unit, Ray{{0, 0, nan}, {1, 0, -1}}, {.t = 1, .uv = {}}, Precision::binary64));
}

}  // namespace
}  // namespace plumbline
