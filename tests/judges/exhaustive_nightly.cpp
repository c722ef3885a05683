// All 14,348,907 cases of {0, 1.5, 3}^3 for origin, target, a, b, c against the integer judge.
#include <array>
#include <cstdio>

#include "tests/judges/agreement.h"

namespace plumbline::judges {
namespace {

TEST(LatticeSet, TheIntegerJudgeAgreesOnAll) {
  std::array<std::uint64_t, 8> classes{};
  for (std::uint64_t i = 0; i < LatticeCase::count; ++i) {
    const LatticeCase c(i);
    const Truth truth = classify(c.triangle, c.ray);
    ASSERT_NO_FATAL_FAILURE(expect_agreement(c.triangle, c.ray, truth, c.integer_judged())) << "case " << i;
    ++classes[static_cast<std::size_t>(truth.hit_class)];
  }
  for (std::size_t k = 0; k < classes.size(); ++k) {
    std::printf("%-10s %llu\n", hit_class_names[k].data(), static_cast<unsigned long long>(classes[k]));
    EXPECT_GT(classes[k], 0u) << hit_class_names[k];
  }
}

}  // namespace
}  // namespace plumbline::judges
