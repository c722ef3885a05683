// No false findings: 20000 disagreements of campaigns, judged again.
#include "tests/fuzz/rejudged.h"

#include "tests/judges/seed.h"

namespace plumbline {
namespace {

class Rejudge : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Tracers, Rejudge, rejudged_tracers,
                         [](const auto& info) { return std::string(info.param); });

TEST_P(Rejudge, NoDisagreementIsFalse) { rejudge(GetParam(), judges::seed(), 1800, 200); }

}  // namespace
}  // namespace plumbline
