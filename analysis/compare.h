// Many tracers side by side on the hard families: how often each is wrong and by how much, where two of them disagree
// and which of the two is right.
//
// Every tracer is judged by its contract, on the query that it was really asked; beside that it is judged as if it had
// been asked the ray itself, which tells what its interface loses. Same plan, same result.
#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/ask.h"
#include "case/hard_families.h"

namespace plumbline {

struct ComparePlan {
  std::vector<const Tracer*> tracers;
  std::vector<Family> families;
  Precision inputs = Precision::binary64;  ///< all numbers of a case; binary32 tracers need binary32
  std::uint64_t count = 1000;              ///< cases of each family
  std::uint64_t seed = 1;
  std::size_t worst = 3;  ///< cases kept of each tracer and family
};

/// One tracer on one family.
struct Score {
  std::uint64_t cases = 0, false_misses = 0, false_hits = 0, unspecified = 0, faults = 0;
  std::uint64_t boundary = 0, boundary_hits = 0;  ///< cases whose truth is an edge or vertex in the range; hits there
  std::uint64_t ray_false_misses = 0, ray_false_hits = 0;  ///< had it been asked the ray
  double worst_nominal_ulps = 0;                           ///< greatest severity of a nominal case; 0: none is wrong
};

/// Two tracers on one family and class: answers that differ (faults don't count), and who is right by the truth of the ray.
struct Duel {
  std::uint64_t differ = 0, first_right = 0, second_right = 0;
};

/// A case that a tracer gets wrong.
struct WrongCase {
  Case asked;  ///< as put to all; provenance says who answers what
  double ulps = 0;
  bool nominal = false;
};

struct CompareResult {
  ComparePlan plan;
  std::vector<std::vector<Score>> scores;  ///< by tracer, family
  /// By pair (first < second, as of pair_index), family, class.
  std::vector<std::vector<std::vector<Duel>>> duels;
  std::vector<std::vector<std::vector<WrongCase>>> worst;  ///< by tracer, family: nominal ones first, by severity
  std::vector<Conduct> conduct;                            ///< of each tracer
  std::uint64_t done = 0;                                  ///< cases, of all families together
};

/// Index of the pair first < second among `tracers`.
std::size_t pair_index(std::size_t first, std::size_t second, std::size_t tracers);

/// Whether a family's numbers are of use in binary32: not those that need more bits or exponents.
bool suits_binary32(Family family);

using CompareProgress = std::function<void(std::uint64_t done, std::uint64_t planned)>;

/// Throws InputError where there is nothing to compare, or a binary32 tracer is to read binary64 inputs.
CompareResult compare(const ComparePlan& plan, const std::atomic<bool>& stop, const CompareProgress& progress = {});

}  // namespace plumbline
