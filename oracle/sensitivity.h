// How much the numbers of a case lean on its input: what tells a hard problem from an unstable algorithm.
//
// Where every coordinate x of origin, direction and vertices changes by at most a relative eps, t, u, v and w = 1 - u - v
// change, to first order, by at most eps times the value given here, and for some such change by just that. So
//   forward error = sensitivity * backward error,
// with the backward error as the least relative change of the input that explains an answer; in units of the unit
// roundoff it tells what the algorithm lost, the sensitivity over the value what the problem lost. (Higham, Accuracy
// and Stability of Numerical Algorithms, 2002, sections 1.5, 1.6 and 7.2: componentwise condition numbers.)
#pragma once
#include <optional>

#include "case/query.h"

namespace plumbline {

struct Sensitivity {
  double t = 0, u = 0, v = 0, w = 0;  ///< absolute; w is the weight of a
};

/// Correctly rounded from the exact values; of a direction's tail no sensitivity is told. No value where det == 0 or
/// the case is invalid.
std::optional<Sensitivity> sensitivity(const Triangle& triangle, const Query& query);

}  // namespace plumbline
