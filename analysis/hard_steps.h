// Steps of shrinking too hard to keep a case on its knife's edge, taken by chance: after one of them a coordinate is
// solved for exactly (oracle/boundary.h), which puts the ray back.
#pragma once
#include <span>

#include "analysis/simpler_number.h"
#include "case/precision.h"
#include "case/random.h"

namespace plumbline {

/// A small whole number, a half or a power of two, down to 2^-digits.
double plain_number(int digits, Random& random);

/// Makes some of the coordinates, three of a point after each other and at most 64, plain: few bits, whole numbers, on
/// a grid.
void simplify_hard(std::span<double* const> coordinates, int digits, Random& random);

/// Offers `take` a coordinate that was solved for, those up to 3 ulps beside, and it rounded to ever more bits (each in
/// the direction() of rounded_to_bits), until it takes one.
template <class Direction, class Take>
bool take_near(double root, Precision precision, Direction direction, Take take) {
  for (const int ulps : {0, 1, -1, 2, -2, 3, -3})
    if (take(step_ulps(root, ulps, precision))) return true;
  for (int bits = 2; bits < digits(precision); bits += 4)
    if (take(rounded_to_bits(root, bits, direction()))) return true;
  return false;
}

}  // namespace plumbline
