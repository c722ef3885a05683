// The scalar stage for full 53-bit data of a few binades: the determinants in exact 192-bit integers. Integers only, so
// that rounding mode, FTZ and DAZ have no say. Private to the oracle.
#pragma once
#include <optional>

#include "case/geometry.h"
#include "oracle/signs.h"
#include "oracle/truth.h"

namespace plumbline {

/// No value where the case is invalid, or its coordinates do not fit (integer_case.h). Computes the determinants whose
/// signs are not known.
std::optional<Truth> classify_integer(const Triangle& triangle, const Ray& ray, const KnownSigns& known = {});

}  // namespace plumbline
