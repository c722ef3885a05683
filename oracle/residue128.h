// The scalar residue stage: full 53-bit data on grids of a few binades. Private to the oracle.
//
// The idea of the vector residue stage (batch_kernel.h) with 128-bit integers: a determinant of integers is known exactly
// when it is known modulo 2^128 and known, by its binary64 value, to lie in (-2^127, 2^127). Integer and binary64
// arithmetic only, in any rounding mode, FTZ and DAZ included.
#pragma once
#include <optional>

#include "case/geometry.h"
#include "oracle/truth.h"

namespace plumbline {

/// The case is not invalid. No value where it is outside the stage's range.
std::optional<Truth> classify_residue128(const Triangle& triangle, const Ray& ray);

}  // namespace plumbline
