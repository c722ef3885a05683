// A replay as SARIF 2.1.0, the form in which code scanning takes results: where in which file, by which rule, and
// what makes a result the same as one of an earlier run. tests/schemas/sarif.schema.json is what is used of the
// format.
#pragma once
#include <string>
#include <string_view>

#include "analysis/replay.h"

namespace plumbline {

/// The fingerprint plumblineSignature/v1 is the tracer and the signature of its error, or the rule where there is
/// none.
std::string to_sarif(const ReplaySummary& summary, std::string_view version);

}  // namespace plumbline
