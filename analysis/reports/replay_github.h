// A replay as workflow commands: GitHub shows each line as an annotation at the case's place in its file.
#pragma once
#include <string>

#include "analysis/replay.h"

namespace plumbline {

/// A line "::error file=...,line=...,title=...::..." for each result that disagrees, "::warning" for each other
/// fault.
std::string to_github(const ReplaySummary& summary);

}  // namespace plumbline
