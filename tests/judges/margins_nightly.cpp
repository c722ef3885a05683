// Four million margins, other ones every day.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/judges/margins_agreement.h"
#include "tests/judges/print.h"
#include "tests/judges/seed.h"

namespace plumbline::judges {
namespace {

class MarginsOf : public testing::TestWithParam<std::size_t> {};

TEST_P(MarginsOf, AgreeOnMany) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(nightly_seed()));
  EXPECT_EQ(check_margins_of_family(static_cast<Family>(GetParam()), nightly_seed(), 100000).cases, 100000u);
}

INSTANTIATE_TEST_SUITE_P(Families, MarginsOf, testing::Range<std::size_t>(0, family_names.size()),
                         [](const auto& each) { return std::string(family_names[each.param]); });

class MarginsOfSpreadCases : public testing::TestWithParam<Precision> {};

TEST_P(MarginsOfSpreadCases, AgreeOnMany) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(nightly_seed()));
  EXPECT_EQ(check_spread_margins(GetParam(), nightly_seed(), 1000000).cases, 1000000u);
}

INSTANTIATE_TEST_SUITE_P(Precisions, MarginsOfSpreadCases,
                         testing::Values(Precision::binary32, Precision::binary64),
                         [](const auto& each) { return std::string(name(each.param)); });

}  // namespace
}  // namespace plumbline::judges
