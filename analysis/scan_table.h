// What a scan comes to, as text.
#pragma once
#include <string>

#include "analysis/scan.h"

namespace plumbline {

/// For people: what is true of each set, what each tracer got wrong, what it took.
std::string to_terminal(const ScanPlan& plan, const ScanResult& result);

/// One line for each set and tracer, after a line of titles; no times.
std::string to_csv(const ScanPlan& plan, const ScanState& state);

}  // namespace plumbline
