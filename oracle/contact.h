// Rays that touch a triangle without crossing it: those that run in its plane, and those that meet a triangle without area.
#pragma once
#include <optional>

#include "case/query.h"
#include "oracle/truth.h"

namespace plumbline {

/// For class coplanar or degenerate: whether the closed t range holds a point of the closed triangle (of the segment or
/// point that it is, where it has no area). Exact.
bool touches(const Triangle& triangle, const Query& query);

/// Closed triangle, closed range. Parallel: false. Coplanar and degenerate: no value where they touch, else false (contact
/// without a crossing is a matter of convention). Invalid: no value. `truth` is that of the two others.
std::optional<bool> hit(const Triangle& triangle, const Query& query, const Truth& truth);

}  // namespace plumbline
