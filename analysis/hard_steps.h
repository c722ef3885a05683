// Steps of shrinking too hard to keep a case on its knife's edge, taken by chance: after one of them a coordinate is
// solved for exactly (oracle/boundary.h), which puts the ray back.
#pragma once
#include <span>

#include "case/random.h"

namespace plumbline {

/// A small whole number, a half or a power of two, down to 2^-digits.
double plain_number(int digits, Random& random);

/// Makes some of the coordinates, three of a point after each other and at most 64, plain: few bits, whole numbers, on
/// a grid.
void simplify_hard(std::span<double* const> coordinates, int digits, Random& random);

}  // namespace plumbline
