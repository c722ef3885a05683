// A stated part of {0, 1.5, 3}^3 for origin, target, a, b, c: every 211th of the 27^5 cases (211 is prime to 27, so all
// residues of every coordinate occur), against three judges. All of them run nightly against the integer judge.
#include "tests/judges/agreement.h"
#include "tests/judges/epeck_judge.h"
#include "tests/judges/rational_judge.h"

namespace plumbline::judges {
namespace {

TEST(LatticeSet, EveryJudgeAgreesOnEvery211th) {
  std::uint64_t seen = 0;
  for (std::uint64_t i = 0; i < LatticeCase::count; i += 211, ++seen) {
    const LatticeCase c(i);
    const Truth truth = classify(c.triangle, c.ray);
    SCOPED_TRACE(testing::Message() << "case " << i);
    ASSERT_NO_FATAL_FAILURE(expect_agreement(c.triangle, c.ray, truth, c.integer_judged()));
    ASSERT_NO_FATAL_FAILURE(expect_agreement(c.triangle, c.ray, truth, rational_meeting(c.triangle, c.ray)));
    if (truth.invalid != Invalid::none) continue;
    ASSERT_NO_FATAL_FAILURE(expect_agreement(c.triangle, c.ray, truth, epeck_judged(c.triangle, c.ray)));
  }
  EXPECT_EQ(seen, 68005u);
}

}  // namespace
}  // namespace plumbline::judges
