// Ten million cases of the families, other ones every day; cpp_rational is asked of every tenth.
#include <gtest/gtest.h>

#include "tests/judges/families_agreement.h"

namespace plumbline::judges {
namespace {

class Families : public testing::TestWithParam<std::size_t> {};

TEST_P(Families, BothJudgesAgreeOnMany) {
  const auto family = static_cast<Family>(GetParam());
  EXPECT_EQ(check_family(family, nightly_seed(), 720000, 10).cases, 720000u);
}

INSTANTIATE_TEST_SUITE_P(All, Families, testing::Range<std::size_t>(0, family_names.size()),
                         [](const auto& info) { return std::string(family_names[info.param]); });

}  // namespace
}  // namespace plumbline::judges
