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
    ASSERT_EQ(truth, c.integer_truth()) << "case " << i << '\n' << explain(c.triangle, c.ray);
    ASSERT_EQ(truth, rational_meeting(c.triangle, c.ray).truth) << "case " << i << '\n' << explain(c.triangle, c.ray);
    if (truth.invalid != Invalid::none) continue;
    ASSERT_EQ(truth, epeck_truth(c.triangle, c.ray)) << "case " << i << '\n' << explain(c.triangle, c.ray);
  }
  EXPECT_EQ(seen, 68005u);
}

}  // namespace
}  // namespace plumbline::judges
