// S against brute force over all pairs of features in cpp_rational.
#include <gtest/gtest.h>

#include <cstdio>

#include "case/hard_families.h"
#include "oracle/classify.h"
#include "oracle/contact.h"
#include "oracle/explain.h"
#include "oracle/severity.h"
#include "tests/judges/families_agreement.h"
#include "tests/judges/rational_judge.h"

namespace plumbline::judges {
namespace {

class SeverityOf : public testing::TestWithParam<Family> {};

TEST_P(SeverityOf, IsTheRoundedLeastDistance) {
  int measured = 0;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const auto [triangle, ray] = draw(GetParam(), seed() + 2, i);
    const auto is_hit = hit(triangle, ray, classify(triangle, ray));
    for (const bool answered_hit : {false, true}) {
      const auto s = severity(triangle, ray, answered_hit, Precision::binary64);
      if (!is_hit || *is_hit == answered_hit) {
        ASSERT_FALSE(s.has_value()) << explain(triangle, ray);
        continue;
      }
      if (!s) continue;  // no area, or an empty range
      ++measured;
      ASSERT_TRUE(is_rounded_sqrt(squared_severity(triangle, ray, answered_hit), s->length))
          << "index " << i << " answered " << answered_hit << " S " << s->length << '\n'
          << explain(triangle, ray);
    }
  }
  std::printf("%s: %d severities\n", name(GetParam()).data(), measured);
  EXPECT_GT(measured, 500);
}

INSTANTIATE_TEST_SUITE_P(Families, SeverityOf,
                         testing::Values(Family::random, Family::small_far, Family::lattice_points,
                                         Family::exact_edge23,
                                         Family::ulp51, Family::mixed40, Family::coplanar, Family::wide_edge),
                         [](const auto& info) { return std::string(name(info.param)); });

}  // namespace
}  // namespace plumbline::judges
