// The results of self-intersection as CSV, and as text. Numbers are the shortest decimals that read back the same; an
// infinity is inf.
#pragma once
#include <string>

#include "analysis/self_hits.h"

namespace plumbline {

/// A line for each tracer, family, point and way of leaving that was measured: tracer, precision, family, hits,
/// misses, faults, not_finite (of first rays), point, leaving, rays, beyond, start, beyond_hits, start_hits,
/// false_hits; then for either remedy, origin and t_min: REMEDY_tracer, _exact and _excess, each with _median, _p99,
/// _worst (ulps; empty where the tracer isn't asked), then _nothing and _never.
std::string self_hits_csv(const SelfHitResult& result);

/// For people: how many of the leaving rays hit their own triangle and whose fault it is, a line for each tracer and
/// point; how many ulps the origin has to move, by point, of the way of leaving that needs more; and t_min, by way of
/// leaving, from the point that needs more. '-' where nothing was measured.
std::string to_terminal(const SelfHitResult& result);

}  // namespace plumbline
