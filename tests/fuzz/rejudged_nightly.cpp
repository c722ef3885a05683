// No false findings: a million disagreements of campaigns, other ones every night, judged again.
#include "tests/fuzz/rejudged.h"
#include "tests/judges/seed.h"

namespace plumbline {
namespace {

class Rejudge : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Tracers, Rejudge, rejudged_tracers,
                         [](const auto& info) { return std::string(info.param); });

TEST_P(Rejudge, NoDisagreementIsFalse) { rejudge(GetParam(), judges::nightly_seed(), 90000, 10000); }

}  // namespace
}  // namespace plumbline
