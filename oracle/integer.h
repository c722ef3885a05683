// The scalar stages that compute the determinants in exact integers of fixed width: 192 bits for full doubles of a
// few binades, 384 for full doubles over 72 binades. Integers only, so that rounding mode, FTZ and DAZ have no say.
// Private to the oracle.
#pragma once
#include <optional>

#include "case/geometry.h"
#include "oracle/signs.h"
#include "oracle/truth.h"

namespace plumbline {

// Both compute the determinants whose signs are not known.

/// No value where the case is invalid, or its coordinates do not fit (integer_case.h).
std::optional<Truth> classify_integer(const Triangle& triangle, const Ray& ray, const KnownSigns& known = {});

/// The case is not invalid. No value where its coordinates do not fit (wide_case.h).
std::optional<Truth> classify_wide(const Triangle& triangle, const Ray& ray, const KnownSigns& known = {});

}  // namespace plumbline
