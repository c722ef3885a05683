// The oracle against both judges on seeded random families.
#pragma once
#include <cstdint>

#include <ostream>

#include "case/hard_families.h"

namespace plumbline {
/// For GoogleTest.
inline void PrintTo(Family family, std::ostream* out) { *out << name(family); }
}  // namespace plumbline

namespace plumbline::judges {

struct Agreement {
  std::uint64_t cases = 0;
  std::uint64_t crossings = 0;  ///< of which t, u, v were checked, in both precisions
};

/// Compares class, signs, contact and rounded t, u, v of `count` cases; stops at the first difference with a GoogleTest
/// failure that prints the case. The EPECK judge is asked of each, the rational judge of every `rational_every`th.
Agreement check_family(Family family, std::uint64_t seed, std::uint64_t count, std::uint64_t rational_every);

/// PLUMBLINE_SEED, or the default; printed, so that a failure can be repeated.
std::uint64_t seed();

}  // namespace plumbline::judges
