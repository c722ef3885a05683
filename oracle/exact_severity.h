// S^2 of severity.h as an exact fraction. Private to the oracle.
#pragma once
#include <optional>

#include "oracle/exact_case.h"

namespace plumbline::exact {

/// No value where the triangle has no area, the range is empty, or the answer is true or a matter of convention
/// (coplanar contact).
std::optional<Quotient> squared_severity(const ExactCase& exact, const Ray& ray, bool answered_hit);

Dyadic squared_longest_edge(const ExactCase& exact);

}  // namespace plumbline::exact
