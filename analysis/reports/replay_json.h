// A replay as NDJSON: a line for each case and tracer, and one for each expectation. `plumbline replay --help` lists
// the keys.
#pragma once
#include <string>

#include "analysis/replay.h"

namespace plumbline {

std::string to_json_lines(const ReplaySummary& summary);

}  // namespace plumbline
