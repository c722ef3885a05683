// What a search looks at in an examined case: the cells of the archive that the case competes for, and how it scores.
//
// A cell is a logarithmic bucket of one quantity, or of two: severity of a false hit and of a false miss, displacement
// of u and v, residual of t, each alone and over the condition; how near the case is to another truth, by wish, truth and
// answer; and the signature of a finding. Every cell keeps the case with the greatest error that was found there, so that
// there are stepping stones from every condition and size of error to the next.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "analysis/examine.h"
#include "analysis/signature.h"

namespace plumbline {

using Cell = std::uint32_t;

/// Cells of quantities are below this.
inline constexpr Cell plain_cells = 1 << 14;
/// Cells of signatures have this bit; the rest of theirs is Signature::key(). They are kept by finding_ulps alone.
inline constexpr Cell signature_cell = 1u << 31;
/// Another one that is: the nominal case of greatest severity.
inline constexpr Cell worst_nominal_cell = 13 * 1024;

struct Features {
  /// How large the error is, in ulps: the greatest of severity and displacement.
  double error = 0;
  double severity = 0;  ///< in ulps; 0 where the answer is not wrong
  double found = 0;     ///< finding_ulps of what was found
  bool nominal = false;
  std::array<Cell, 16> cells;
  std::size_t size = 0;
};

/// Without cells where the case has no condition: invalid, without area, coplanar.
Features features(const Examination& examination, const std::optional<Signature>& found, Wish wish = Wish::none);

}  // namespace plumbline
