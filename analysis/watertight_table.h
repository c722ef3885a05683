// The result of a search for leaks as text: tables for people, CSV for machines.
#pragma once
#include <string>

#include "analysis/watertight.h"

namespace plumbline {

/// For each precision of inputs a table of pairs, fans and strips and one of spheres. A line for each tracer; a
/// second one, "by its contract", where that excuses some of it. '.' is none. Tests without a tracer that reads them
/// are left out.
std::string to_terminal(const LeakResult& result);
/// The same in GitHub's dialect.
std::string to_markdown(const LeakResult& result);

/// A header, and a line for each tracer and test that it reads: tracer, precision, test, rays, of each LeakCount
/// NAME, NAME_broken and NAME_worst_ulps, then culled_leaks, culled_nearest, apart, faults.
std::string to_csv(const LeakResult& result);

}  // namespace plumbline
