// The margins against the other functions of the oracle and against judges.
#pragma once
#include <cstdint>
#include <random>

#include "case/case.h"
#include "case/hard_families.h"
#include "case/query.h"

namespace plumbline::judges {

/// Half of the shots: each coordinate is 0 (one in twelve) or has any significand and an exponent in [-40, 20),
/// or, of binary32, [-30, 20). A quarter: small dyadic numbers. A quarter: those with powers of two added. The
/// range is [0, inf] or all t.
Shot draw_spread(std::mt19937_64& random, Precision precision);

/// Puts the ray on a boundary, exactly where the coordinate allows, and moves the coordinate by up to `ulps`
/// from there. Where no coordinate that is tried decides, the shot stays as it is.
Shot put_on_boundary(Shot shot, std::mt19937_64& random, Precision precision, int ulps);

struct MarginsChecked {
  std::uint64_t cases = 0, measured = 0, hits = 0, parallel = 0;
};

/// Against classify, severity and mpq; `brute_force`: S^2 by cpp_rational too, of a query without a tail. For
/// use with ASSERT_NO_FATAL_FAILURE.
void check_margins(const Triangle& triangle, const Query& query, Precision precision, bool brute_force,
                   MarginsChecked& checked);

/// `count` cases of a family; the brute force on every 16th, on fewer where exponents make rationals slow.
MarginsChecked check_margins_of_family(Family family, std::uint64_t seed, std::uint64_t count);

/// `count` cases of draw_spread, of which three in four are put on boundaries.
MarginsChecked check_spread_margins(Precision precision, std::uint64_t seed, std::uint64_t count);

}  // namespace plumbline::judges
