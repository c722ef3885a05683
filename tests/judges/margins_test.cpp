// A hundred thousand margins: all families, the numbers that a search draws, and cases solved onto boundaries.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>

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
        ASSERT_NO_FATAL_FAILURE(check_margins(shot, Precision::binary64, false, checked));
      }
  EXPECT_GT(checked.measured, 500u);
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
    ASSERT_NO_FATAL_FAILURE(check_margins(shot, Precision::binary64, pattern % 64 == 0, checked));
  }
  EXPECT_GT(checked.measured, 3000u);
}

}  // namespace
}  // namespace plumbline::judges
