// A hundred thousand margins: all families, the numbers that a search draws, and cases solved onto boundaries.
#include <gtest/gtest.h>

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
                         [](const auto& info) { return std::string(family_names[info.param]); });

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
                         [](const auto& info) { return std::string(name(info.param)); });

}  // namespace
}  // namespace plumbline::judges
