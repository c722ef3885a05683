// The last stage: any finite doubles, in integers only. No overflow, no underflow, no allocation, nothing to fail.
// Private to the oracle.
//
// Every determinant is a sum of products of the coordinates themselves (differences are multiplied out, so none is ever
// rounded): with S(D; P, Q, R) = D . (P x Q + Q x R + R x P),
//   det = S(D; A, B, C)   w_AB = S(D; A, B, O)   w_BC = S(D; B, C, O)   w_CA = S(D; C, A, O)
//   T = A . (B x C) - S(O; A, B, C)
// A direction in two parts (query.h) has twice the terms. The products P x Q are shared among them. Each product of 3 or 4 significands is below 2^212; positive and negative ones
// are summed apart in fixed-point numbers that reach from the lowest bit to the highest (at most 7576 bits: 2^-4504, for
// subnormal numbers are normalized, to 2^3072), and the two sums are compared from the top.
#pragma once
#include "case/query.h"
#include "oracle/truth.h"

namespace plumbline {

/// The case is not invalid.
Truth classify_accumulate(const Triangle& triangle, const Query& query);

}  // namespace plumbline
