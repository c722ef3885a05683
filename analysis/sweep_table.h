// The result of a sweep as text: a table for people, CSV and JSON for machines.
#pragma once
#include <string>

#include "analysis/sweep.h"

namespace plumbline {

/// What was done, the table and a legend. With one standoff the table has a line for each row of the result. With
/// several it shows how far the successes depend on the standoff h: a line for each tracer, offset and target, with the
/// least and the most over all h, and the first h where that happens.
std::string to_terminal(const SweepResult& result);
/// The same in GitHub's dialect.
std::string to_markdown(const SweepResult& result);

/// One object a line for each row: tracer, offset [x, y, z], standoff, target, tolerance (null where there is none),
/// attempts, successes, exact_successes, harness_errors, false_misses, false_hits, lucky, unspecified, faults.
std::string to_json_lines(const SweepResult& result);

/// Header and a line for each row: the same, with offset_x, offset_y, offset_z for the offset and an empty field for no
/// tolerance, and then lucky_misses, lucky_hits and unlucky_harness_errors (see Tally). Numbers are the shortest
/// decimals that read back the same.
std::string to_csv(const SweepResult& result);

}  // namespace plumbline
