// The archive of a search: the worst case of each cell (features.h). The search takes its parents from it.
//
// Merging archives takes the worst of each cell: it is associative, commutative and idempotent, since ties go to the
// input whose bytes are lexicographically less.
#pragma once
#include <compare>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "case/case_bytes.h"
#include "case/random.h"
#include "fuzz/features.h"

namespace plumbline {

struct Elite {
  Cell cell = 0;
  double score = 0;  ///< the error; in a cell of a signature its finding_ulps, in that of the worst nominal case the severity
  double drive = 0;  ///< the error where the case is nominal, else 0: what parents are chosen by
  FuzzInput input;
};

class Elites {
 public:
  /// Puts the input in the cells where it is worse than what is there. Returns how many; changed() has their places.
  std::size_t offer(const FuzzInput& input, const Features& features);

  /// A parent: mostly any elite, in one of four the one with the greatest drive of eight. Null where there is none.
  const Elite* parent(Random& random) const;

  std::span<const Elite> all() const { return elites_; }
  const Elite* at(Cell cell) const;
  /// Indices in all() of what the last offer put.
  std::span<const std::uint32_t> changed() const { return changed_; }

 private:
  std::uint32_t& place(Cell cell);

  static constexpr std::uint32_t nowhere = ~std::uint32_t{0};
  std::vector<Elite> elites_;
  std::vector<std::uint32_t> plain_ = std::vector<std::uint32_t>(plain_cells, nowhere);
  std::unordered_map<Cell, std::uint32_t> others_;
  std::vector<std::uint32_t> changed_;
};

/// The score of a case in a cell.
double score_in(Cell cell, const Features& features);

/// Of cell and input.
std::uint64_t fingerprint(const Elite& elite);
/// Of the contents: equal for equal archives, whatever the order in which they came about.
std::uint64_t fingerprint(const Elites& elites);

}  // namespace plumbline
