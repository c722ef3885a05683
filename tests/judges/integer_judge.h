// A fast independent judge for small integer coordinates: the textbook determinants in 64-bit integers. Coordinates and
// direction components are below 2^9 in magnitude, bounds of t are multiples of 1/4 below 2^4.
#pragma once
#include <array>
#include <cstdint>

#include "tests/judges/judged.h"

namespace plumbline::judges {

using IntVec = std::array<std::int64_t, 3>;

/// The bounds of t are given in quarters.
Judged integer_judged(const IntVec& a, const IntVec& b, const IntVec& c, const IntVec& origin, const IntVec& direction,
                        std::int64_t t_min_quarters, std::int64_t t_max_quarters);

}  // namespace plumbline::judges
