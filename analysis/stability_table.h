// The results of stability and speed as CSV, for figures and for everybody's own, and as text. Numbers are the shortest
// decimals that read back the same; an infinity is inf.
#pragma once
#include <string>

#include "analysis/stability.h"

namespace plumbline {

/// A line for each subject, dial and setting. tracer, precision (of the tracer), inputs, dial, setting, cases, hits;
/// then false_misses, false_hits, each with _low and _high, the ends of its 95 % confidence interval as shares of the
/// cases that could be so (Wilson's score interval); unspecified, faults, not_finite; then _count, _median, _p99,
/// _worst of severity, nominal_severity, t, u, v, point, residual, start, forward, backward, condition.
std::string cells_csv(const StabilityResult& result);

/// A line for each subject and dial: tracer, precision, inputs, dial, stable (0 or 1), leaves_at (empty where stable),
/// slope, wrong, answers (right or wrong), forward_p99 (the greatest of all settings), backward_p99, backward_worst.
std::string verdicts_csv(const StabilityResult& result);

/// tracer, precision, inputs, symmetry, asked, changed
std::string symmetries_csv(const StabilityResult& result);

/// tracer, variant, precision, inputs, asked, differ
std::string builds_csv(const StabilityResult& result);

/// tracer, precision, inputs, log2_condition, count, median, p99, worst
std::string conditions_csv(const StabilityResult& result);

/// For people: a line for each tracer on inputs of its own precision, a column for each dial with where it leaves its
/// bound, '.' where it doesn't.
std::string to_terminal(const StabilityResult& result);

}  // namespace plumbline
