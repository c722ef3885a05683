// A hundred million cases of the families against mpq, in batches of each instruction set in turn; other ones every
// day.
#include <gtest/gtest.h>

#include <cstdio>
#include <vector>

#include "oracle/explain.h"
#include "tests/judges/mpq_judge.h"
#include "tests/judges/print.h"
#include "tests/judges/seed.h"
#include "tests/oracle/stages.h"

namespace plumbline::judges {
namespace {

constexpr std::uint64_t chunk = 1000, chunks = 7200;  // of each family

class Soak : public testing::TestWithParam<std::size_t> {};

TEST_P(Soak, MpqAgrees) {
  const auto family = static_cast<Family>(GetParam());
  const std::uint64_t from = nightly_seed();
  std::printf("%s, seed %llu\n", name(family).data(), static_cast<unsigned long long>(from));
  std::vector<Shot> shots(chunk);
  std::vector<Truth> truths(chunk);
  for (std::uint64_t k = 0; k < chunks; ++k) {
    for (std::uint64_t i = 0; i < chunk; ++i) shots[i] = draw(family, from, k * chunk + i);
    classify(Columns(shots).batch(truths.data()), all_isas()[k % all_isas().size()], nullptr);
    for (std::uint64_t i = 0; i < chunk; ++i) {
      const auto& [triangle, ray] = shots[i];
      const Truth expected =
          ray.direction == Vec3{} ? Truth{.invalid = Invalid::zero_direction} : mpq_truth(triangle, ray);
      ASSERT_EQ(truths[i], expected) << "index " << k * chunk + i << '\n' << explain(triangle, ray);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, Soak, testing::Range<std::size_t>(0, family_names.size()),
                         [](const auto& each) { return std::string(family_names[each.param]); });

}  // namespace
}  // namespace plumbline::judges
