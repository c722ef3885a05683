// A million cases over all families. EPECK is asked of each, cpp_rational (which also checks t, u and v) of every fourth;
// of the two families whose exponents make rationals slow, fewer. Ten times as many run nightly.
#include <gtest/gtest.h>

#include "tests/judges/families_agreement.h"

namespace plumbline::judges {
namespace {

class Families : public testing::TestWithParam<std::size_t> {};

TEST_P(Families, BothJudgesAgree) {
  const auto family = static_cast<Family>(GetParam());
  const bool slow = family == Family::wide || family == Family::full_range;
  const std::uint64_t count = slow ? 20000 : 60000;
  EXPECT_EQ(check_family(family, seed(), count, slow ? 20 : 4).cases, count);
}

INSTANTIATE_TEST_SUITE_P(All, Families, testing::Range<std::size_t>(0, family_names.size()),
                         [](const auto& info) { return std::string(family_names[info.param]); });

}  // namespace
}  // namespace plumbline::judges
