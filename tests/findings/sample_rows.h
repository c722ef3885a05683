// Findings that were never found, for tests of what shows them: names that no page should obey, and as many as
// wanted.
#pragma once
#include <string>
#include <vector>

#include "findings/finding_row.h"

namespace plumbline {

/// Names of tracers that break what isn't escaped, each in its own way.
std::vector<std::string> hostile_names();

/// The unit triangle, and a ray down on (x, y) from a height of 1.
Case case_at(std::string id, double x, double y);

/// False hits of `tracer` beside edge ab: 2^-50 off it at the worst, 2^-51 in the simplest case.
FindingRow sample_row(std::int64_t id, std::string tracer);

/// That many of all kinds, elements and conditions, ids from 1 on, tracers 'tracer_0' to 'tracer_39'. All of a list's
/// columns vary as widely as they do in years of searching.
std::vector<FindingRow> many_rows(std::size_t count);

}  // namespace plumbline
