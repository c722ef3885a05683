// The oracle against both judges on seeded random families.
#pragma once
#include <cstdint>

#include "case/hard_families.h"
#include "tests/judges/print.h"
#include "tests/judges/seed.h"

namespace plumbline::judges {

struct Agreement {
  std::uint64_t cases = 0;
  std::uint64_t crossings = 0;  ///< of which t, u, v were checked, in both precisions
};

/// Compares class, signs, contact and rounded t, u, v of `count` cases; stops at the first difference with a GoogleTest
/// failure that prints the case. The EPECK judge is asked of each, the rational judge of every `rational_every`th.
Agreement check_family(Family family, std::uint64_t seed, std::uint64_t count, std::uint64_t rational_every);

}  // namespace plumbline::judges
