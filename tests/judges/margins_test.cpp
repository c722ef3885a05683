// A hundred thousand margins: all families, the numbers that a search draws, and cases solved onto boundaries.
#include "oracle/margins.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "tests/judges/margins_agreement.h"
#include "tests/judges/print.h"
#include "tests/judges/seed.h"

namespace plumbline::judges {
namespace {

class MarginsOf : public testing::TestWithParam<std::size_t> {};

void report(const char* what, const MarginsChecked& c) {
  std::printf("%s, seed %llu: %llu cases, %llu measured, %llu hits, %llu parallel\n", what,
              static_cast<unsigned long long>(seed()), static_cast<unsigned long long>(c.cases),
              static_cast<unsigned long long>(c.measured), static_cast<unsigned long long>(c.hits),
              static_cast<unsigned long long>(c.parallel));
}

TEST_P(MarginsOf, AgreeWithTruthSeverityAndExactRationals) {
  const auto family = static_cast<Family>(GetParam());
  const MarginsChecked checked = check_margins_of_family(family, seed() + 5, 3000);
  report(name(family).data(), checked);
  EXPECT_EQ(checked.cases, 3000u);
  EXPECT_EQ(checked.measured > 1000, family != Family::degenerate);
}

INSTANTIATE_TEST_SUITE_P(Families, MarginsOf, testing::Range<std::size_t>(0, family_names.size()),
                         [](const auto& each) { return std::string(family_names[each.param]); });

class MarginsOfSpreadCases : public testing::TestWithParam<Precision> {};

TEST_P(MarginsOfSpreadCases, AgreeWithTruthSeverityAndExactRationals) {
  const MarginsChecked checked = check_spread_margins(GetParam(), seed() + 6, 25000);
  report(name(GetParam()).data(), checked);
  EXPECT_EQ(checked.cases, 25000u);
  EXPECT_GT(checked.measured, 20000u);
  EXPECT_GT(checked.hits, 1000u);
  EXPECT_GT(checked.parallel, 50u);
}

INSTANTIATE_TEST_SUITE_P(Precisions, MarginsOfSpreadCases,
                         testing::Values(Precision::binary32, Precision::binary64),
                         [](const auto& each) { return std::string(name(each.param)); });

TEST(Margins, AtAndPastTheEndsOfTheExponentsTheyTake) {
  MarginsChecked checked;
  const std::array exponents = {-1040, -700, -430, -302, -301, -300, -299, 0,
                                297,   298,  299,  300,  301,  700,  1000};
  for (const int points : exponents)
    for (const int direction : exponents)
      for (const Family family : {Family::exact_edge12, Family::ulp12, Family::small_far}) {
        Shot shot = draw(family, seed() + 9, checked.cases);
        auto& [triangle, ray] = shot;
        for (Vec3* p : {&triangle.a, &triangle.b, &triangle.c, &ray.origin})
          *p = {std::ldexp(p->x, points), std::ldexp(p->y, points), std::ldexp(p->z, points)};
        Vec3& d = ray.direction;
        d = {std::ldexp(d.x, direction), std::ldexp(d.y, direction), std::ldexp(d.z, direction)};
        ASSERT_NO_FATAL_FAILURE(check_margins(shot.triangle, shot.ray, Precision::binary64, false, checked));
      }
  EXPECT_GT(checked.measured, 500u);
}

// Points 2^1100 times as large as the direction, or as small, and a t that a double holds all the same.
TEST(Margins, WhereTheUnitsAreFarApart) {
  MarginsChecked checked;
  for (const int points : {550, -550}) {
    const double e = std::ldexp(1.0, points), height = std::ldexp(1.0, points - 120);
    const Shot shot{{{0, 0, 0}, {4 * e, 0, 0}, {0, 4 * e, 0}},
                    {{e, e, height}, {0, 0, std::ldexp(-1.0, -points)}}};
    ASSERT_EQ(margins(shot.triangle, shot.ray, Precision::binary64)->t, std::ldexp(1.0, 2 * points - 120));
    ASSERT_NO_FATAL_FAILURE(check_margins(shot.triangle, shot.ray, Precision::binary64, true, checked));
  }
}

// Rays to a double near the triangle: their exact directions mostly have a tail.
TEST(Margins, OfQueriesWithTails) {
  MarginsChecked checked;
  int tails = 0;
  for (std::uint64_t i = 0; i < 600; ++i) {
    const auto [triangle, ray] = draw(i % 2 == 0 ? Family::edge_ulps : Family::mixed40, seed() + 13, i);
    const auto& [a, b, c] = triangle;
    const Vec3 target = {(a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2};
    const auto query = query_through(ray.origin, target, ray.t_min, ray.t_max);
    ASSERT_TRUE(query.has_value());
    tails += query->has_tail() ? 1 : 0;
    ASSERT_NO_FATAL_FAILURE(check_margins(triangle, *query, Precision::binary64, false, checked));
  }
  EXPECT_GT(tails, 300);
  EXPECT_GT(checked.measured, 500u);
}

// By integer matrices that are rotations but for a factor: exact for a few bits, and no axis stays one.
std::vector<Shot> rotated(const Shot& shot) {
  using Rows = std::array<std::array<double, 3>, 3>;
  constexpr std::array<Rows, 3> matrices = {Rows{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
                                            Rows{{{1, 2, 2}, {2, 1, -2}, {2, -2, 1}}},
                                            Rows{{{2, 3, 6}, {3, -6, 2}, {6, 2, -3}}}};
  std::vector<Shot> shots;
  for (const Rows& m : matrices) {
    Shot r = shot;
    for (Vec3* v : {&r.triangle.a, &r.triangle.b, &r.triangle.c, &r.ray.origin, &r.ray.direction}) {
      const auto row = [v, &m](std::size_t k) { return m[k][0] * v->x + m[k][1] * v->y + m[k][2] * v->z; };
      *v = {row(0), row(1), row(2)};
    }
    shots.push_back(r);
  }
  return shots;
}

// A number in [1, 2) of a few bits.
double few_bits(std::mt19937_64& random, int bits) {
  return 1 + std::ldexp(static_cast<double>(random() >> (64 - bits)), -bits);
}

// A ray along x, and an edge that runs off from above its begin at a small angle. The common perpendicular of
// the two lines lies just before the begin, or just off the edge: its length is too short an answer, by more
// than 2^-40, while the products that tell are some 2^-52 of their terms.
TEST(Margins, OfARayNearlyParallelToAnEdge) {
  std::mt19937_64 random(seed() + 11);
  MarginsChecked checked;
  for (int i = 0; i < 1500; ++i) {
    const double x = std::ldexp(few_bits(random, 4), -10 - i % 10),
                 k = std::ldexp(few_bits(random, 4), -26 - i % 15);
    const double y = i % 3 == 0 ? 0 : (i % 3 == 1 ? x : -x) * k / 4, h = few_bits(random, 6);
    const double side = random() % 2 == 0 ? 1 : -1, forth = random() % 2 == 0 ? 1 : -1, l = few_bits(random, 4);
    const Triangle t{{-side * x, y, h}, {-side * x - forth * l, y - forth * k * l, h}, {-forth, 0.5, 2}};
    for (const Shot& shot : rotated({t, {{0, 0, 0}, {few_bits(random, 10), 0, 0}}}))
      ASSERT_NO_FATAL_FAILURE(check_margins(shot.triangle, shot.ray, Precision::binary64, false, checked));
  }
  EXPECT_EQ(checked.measured, checked.cases);
}

// A ray that leaves from above a point just beyond the tip of a needle, or just inside it.
TEST(Margins, OfARayThatBeginsAboveTheTipOfANeedle) {
  std::mt19937_64 random(seed() + 12);
  MarginsChecked checked;
  for (int i = 0; i < 700; ++i) {
    const double x = std::ldexp(random() % 2 == 0 ? few_bits(random, 4) : -few_bits(random, 4), -10 - i % 10);
    const double k = std::ldexp(few_bits(random, 4), -26 - i % 15), l = few_bits(random, 4),
                 h = few_bits(random, 6);
    const Triangle t{{x, 0, 0}, {x + l, k, 0}, {x + few_bits(random, 4), -k, 0}};
    for (const Shot& shot : rotated({t, {{0, 0, h}, {0, 0, few_bits(random, 10)}}}))
      ASSERT_NO_FATAL_FAILURE(check_margins(shot.triangle, shot.ray, Precision::binary64, false, checked));
  }
  EXPECT_EQ(checked.measured, checked.cases);
}

// The widest integers: coordinates of 125 bits of each sign, or of one unit of the grid, of which there are
// less than 2^15 patterns that matter.
TEST(Margins, OfTheWidestIntegers) {
  constexpr double most = 0x1.fffffffffffffp+124;
  MarginsChecked checked;
  for (unsigned pattern = 0; pattern < 1u << 15; pattern += 5) {
    const auto vec = [pattern](unsigned first) {
      const auto x = [pattern](unsigned k) {
        const double magnitude = (pattern * 7 + k * k) % 5 == 0 ? 1 : most;
        return (pattern >> k & 1) != 0 ? -magnitude : magnitude;
      };
      return Vec3{x(first), x(first + 1), x(first + 2)};
    };
    const Shot shot{{vec(0), vec(3), vec(6)}, {vec(9), vec(12)}};
    ASSERT_NO_FATAL_FAILURE(
        check_margins(shot.triangle, shot.ray, Precision::binary64, pattern % 64 == 0, checked));
  }
  EXPECT_GT(checked.measured, 3000u);
}

}  // namespace
}  // namespace plumbline::judges
