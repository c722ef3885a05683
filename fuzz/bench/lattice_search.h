// The report's lattice as a search, to compare with: what it comes to when every ray is fired.
#pragma once
#include "fuzz/summary.h"
#include "float_tracer/tracer.h"

namespace plumbline {

/// Every ordered triple of points of {0, 1.5}^3 that is no line; at each of the 64 targets of the report (tolerances 0.1,
/// 0.001, 0.00001), from each of the eight points, with the direction normalized: 172,032 rays less those from a target
/// itself.
Summary lattice_search(const Tracer& tracer);

}  // namespace plumbline
