// A replay as JUnit XML, for whatever shows test results: a testsuite for the expectations and one for each tracer,
// in it a testcase for each case. tests/schemas/junit.xsd is what is used of the format.
#pragma once
#include <string>

#include "analysis/replay.h"

namespace plumbline {

/// A disagreement is a failure, its text the exact margin and the command that explains; a fault that isn't listed is
/// skipped.
std::string to_junit(const ReplaySummary& summary);

}  // namespace plumbline
