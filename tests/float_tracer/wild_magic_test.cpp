// The adapter to Wild Magic: unit directions, its range, what its documentation leaves open.
#include "float_tracer/adapters/wild_magic.h"

#include <gtest/gtest.h>

#include <cmath>

#include "case/float_bits.h"
#include "tests/float_tracer/shoot.h"

namespace plumbline {
namespace {

const Triangle flat{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
const Ray down{.origin = {1, 2, 8}, .direction = {0, 0, -2}};

class WildMagic : public testing::TestWithParam<std::string> {
 protected:
  Answer shoot(const Triangle& triangle, const Ray& ray) { return plumbline::shoot(GetParam(), {{triangle}}, ray); }
  Outcome outcome(const Triangle& triangle, const Ray& ray) { return shoot(triangle, ray).outcome; }
  Query asked(const Ray& ray) { return tracer_named(GetParam()).prepare({{flat}})->asked(ray); }
};
INSTANTIATE_TEST_SUITE_P(All, WildMagic, testing::Values("wild_magic_f32", "wild_magic_f64"), parameter_name);

TEST_P(WildMagic, GivesTUVAndTheTriangle) {
  const Triangle far{{0, 0, -4}, {4, 0, -4}, {0, 4, -4}};
  const Answer answer = plumbline::shoot(GetParam(), {{far, flat}}, down);
  ASSERT_EQ(answer.outcome, Outcome::hit);
  EXPECT_TRUE(answer.has_t && answer.has_uv && !answer.has_segment);
  EXPECT_EQ(answer.triangle, 1u);
  EXPECT_EQ(answer.t, 8);  // in lengths of the unit vector
  EXPECT_EQ(answer.u, 0.25);
  EXPECT_EQ(answer.v, 0.5);
}

TEST_P(WildMagic, AsksWithADirectionOfUnitLength) {
  EXPECT_EQ(asked(down).ray.origin, down.origin);
  EXPECT_EQ(asked(down).ray.direction, (Vec3{0, 0, -1}));
  EXPECT_FALSE(asked(down).has_tail());
  const double third = GetParam() == "wild_magic_f32" ? static_cast<double>(0x1.555556p-2f) : 1.0 / 3;
  EXPECT_EQ(asked({.origin = {}, .direction = {1, -2, 2}}).ray.direction, (Vec3{third, -2 * third, 2 * third}));
  // Neither overflows nor vanishes on the way.
  EXPECT_EQ(asked({.origin = {}, .direction = {0x1p-149, 0, 0}}).ray.direction, (Vec3{1, 0, 0}));
  EXPECT_EQ(asked({.origin = {}, .direction = {0, 0x1p+127, 0}}).ray.direction, (Vec3{0, 1, 0}));
}

TEST_P(WildMagic, TOfTheAnswerIsThatOfTheQuery) {
  const Ray slanted{.origin = {0, 0, 8}, .direction = {0.25, 0.125, -1}};
  const Answer answer = shoot(flat, slanted);
  ASSERT_EQ(answer.outcome, Outcome::hit);
  const Ray query = asked(slanted).ray;
  EXPECT_NEAR(query.origin.z + answer.t * query.direction.z, 0, 0x1p-18);
}

TEST_P(WildMagic, SearchesFromTheOriginToInfinity) {
  Ray ray = down;
  ray.t_min = 5, ray.t_max = 6;  // not read
  EXPECT_EQ(outcome(flat, ray), Outcome::hit);
  EXPECT_EQ(outcome(flat, {.origin = {1, 1, 0}, .direction = {0, 0, -1}}), Outcome::hit);  // t = 0
  EXPECT_EQ(outcome(flat, {.origin = {1, 1, -0x1p-20}, .direction = {0, 0, -1}}), Outcome::miss);
}

TEST_P(WildMagic, HitsEdgesAndVerticesFromBothSidesAndMissesBeside) {
  for (const double side : {1.0, -1.0}) {
    const auto at = [&](double x, double y) {
      return outcome(flat, {.origin = {x, y, 8 * side}, .direction = {0, 0, -side}});
    };
    for (const auto& [x, y] : {std::pair(0, 0), {4, 0}, {0, 4}, {2, 0}, {2, 2}, {0, 2}})
      EXPECT_EQ(at(x, y), Outcome::hit) << x << " " << y;
    EXPECT_EQ(at(-0x1p-20, 1), Outcome::miss);
    EXPECT_EQ(at(1, -0x1p-20), Outcome::miss);
    EXPECT_EQ(at(2, 0x1.00001p+1), Outcome::miss);
  }
}

TEST_P(WildMagic, CallsSmallTrianglesParallel) {
  const double least = GetParam() == "wild_magic_f32" ? 1e-6 : 1e-8;
  const auto straight_on = [&](double edge) {
    return outcome({{0, 0, 0}, {edge, 0, 0}, {0, edge, 0}}, {.origin = {0, 0, 1}, .direction = {0, 0, -1}});
  };
  EXPECT_EQ(straight_on(step_ulps(static_cast<float>(std::sqrt(least)), 4)), Outcome::hit);
  EXPECT_EQ(straight_on(step_ulps(static_cast<float>(std::sqrt(least)), -4)), Outcome::miss);
}

TEST_P(WildMagic, FaultsWithoutADirection) {
  for (const double bad : {not_a_number, infinity, -infinity})
    EXPECT_EQ(outcome(flat, {.origin = {1, 1, 8}, .direction = {0, bad, -1}}), Outcome::fault);
  EXPECT_EQ(outcome(flat, {.origin = {1, 1, 8}, .direction = {0, -0.0, 0}}), Outcome::fault);
}

TEST_P(WildMagic, MissesAnEmptyBag) { EXPECT_EQ(plumbline::shoot(GetParam(), {}, down).outcome, Outcome::miss); }

// D . N is inf: no sum of weights is larger, so edge bc is not there, and t is inf / inf.
TEST(WildMagicF32, HitsBesideLargeTriangles) {
  const double large = 0x1p+65;
  const Triangle huge{{0, 0, 0}, {large, 0, 0}, {0, large, 0}};
  const Answer answer = shoot("wild_magic_f32", {{huge}}, {.origin = {large, large, 1}, .direction = {0, 0, -1}});
  EXPECT_EQ(answer.outcome, Outcome::hit);
  EXPECT_TRUE(std::isnan(answer.t));
  EXPECT_EQ(shoot("wild_magic_f32", {{huge}}, {.origin = {-large, large, 1}, .direction = {0, 0, -1}}).outcome,
            Outcome::miss);
}

}  // namespace
}  // namespace plumbline
