// The last stage: any finite doubles, in integers only. No overflow, no underflow, no allocation, nothing to fail.
// Private to the oracle.
//
// Every determinant is a sum of products of the coordinates themselves (differences are multiplied out, so none is ever
// rounded): with S(D; P, Q, R) = D . (P x Q + Q x R + R x P),
//   det = S(D; A, B, C)   w_AB = S(D; A, B, O)   w_BC = S(D; B, C, O)   w_CA = S(D; C, A, O)
//   T = A . (B x C) - S(O; A, B, C)
// Each product of 2 to 4 significands is at most 212 bits; positive and negative ones are summed apart as fixed-point
// numbers that reach from the lowest to the highest bit that occurs (at most 8456 bits: 2^-4296 to 2^4096, and carries),
// and the two sums are compared from the top.
#pragma once
#include "case/geometry.h"
#include "oracle/truth.h"

namespace plumbline {

/// The case is not invalid.
Truth classify_accumulate(const Triangle& triangle, const Ray& ray);

}  // namespace plumbline
