// The filter's errors against its bounds, by hill climbing in every rounding mode.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

#include "tests/judges/seed.h"
#include "tests/oracle/filter_search.h"

namespace plumbline {
namespace {

// PLUMBLINE_CLIMB: evaluations for each bound and mode.
int evaluations() {
  const char* text = std::getenv("PLUMBLINE_CLIMB");
  return text != nullptr ? std::atoi(text) : 30000;
}

class FilterError : public testing::TestWithParam<int> {};

TEST_P(FilterError, StaysBelowItsBound) {
  const FloatEnvironment environment{.rounding = GetParam()};
  Random random(judges::seed());
  for (const Measured m : {Measured::det, Measured::T, Measured::w_ab, Measured::w_bc, Measured::w_ca, Measured::V}) {
    const Worst error = climb(m, Objective::error, environment, random, evaluations());
    const Worst wrong_side = climb(m, Objective::wrong_side, environment, random, evaluations());
    testing::Message text;
    text << environment << ' ' << measured_names[static_cast<std::size_t>(m)] << ": worst error / bound " << error.ratio
         << ", of a wrong sign " << wrong_side.ratio << ", seed " << judges::seed();
    std::printf("%s\n", text.GetString().c_str());
    EXPECT_LT(error.ratio, 0.67) << text;  // 84 of 128 u: what is proved
    EXPECT_LT(wrong_side.ratio, 0.5) << text;
    EXPECT_GT(error.ratio, 0.02) << text;  // the search does find errors
  }
}

INSTANTIATE_TEST_SUITE_P(Modes, FilterError, testing::Values(FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO));

}  // namespace
}  // namespace plumbline
