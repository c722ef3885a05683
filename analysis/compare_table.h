// The result of a comparison as text: tables for people, CSV and JSON for machines, cases to replay.
#pragma once
#include <string>

#include "analysis/compare.h"

namespace plumbline {

/// A line for each tracer with "false misses/false hits" by family; what they would be had it been asked the ray itself,
/// where that differs; and for up to four tracers who is right where two of them disagree.
std::string to_terminal(const CompareResult& result);
std::string to_markdown(const CompareResult& result);

/// One object a line. For each tracer and family: tracer, family, inputs, cases, false_misses, false_hits, unspecified,
/// faults, boundary, boundary_hits, ray_false_misses, ray_false_hits, worst_nominal_ulps. For each pair that disagrees:
/// first, second, family, class, differ, first_right, second_right.
std::string to_json_lines(const CompareResult& result);

/// The worst cases as a .case file, with a line `known` for the tracer that gets it wrong.
std::string to_cases(const CompareResult& result);

}  // namespace plumbline
