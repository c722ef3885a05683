// Searches for the finite doubles that take a single call of classify longest: hill climbing from the families, by
// mutations that prefer cancellation and wide exponents.
//
// A call is timed as the least of several repetitions, so that noise can't win; the branches of a repeated call are
// predicted well, so a call among others may take somewhat longer.
#pragma once
#include <cstddef>
#include <cstdint>

#include "case/hard_families.h"

namespace plumbline {

struct WorstCase {
  double ns = 0;
  Shot shot;
  std::size_t tried = 0;
};

/// Seeded, but the times have a say in what is found.
WorstCase search_worst_case(std::uint64_t seed, double seconds);

}  // namespace plumbline
