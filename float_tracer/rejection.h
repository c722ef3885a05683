// By which of its own tests a tracer missed a ray: the one that failed first, in the tracer's own order. It tells
// apart findings that are otherwise alike. It isn't the truth: of a false miss it names the number that is wrong.
#pragma once
#include <array>
#include <optional>
#include <string_view>
#include <type_traits>

namespace plumbline {

enum class Rejection : unsigned char {
  none,      ///< it hits, has no answer, or doesn't tell
  face,      ///< the triangle was dropped when the bag was prepared
  box,       ///< the ray misses a box around the triangle, which itself wasn't tested
  nudge,     ///< so does the origin that was moved into the box, and a little too far (brlcad/walk.h)
  parallel,  ///< the determinant counts as zero
  ab,        ///< outside by the test of this edge, where v < 0
  bc,        ///< the same, where u > 1, v > 1 or u + v > 1
  ca,        ///< the same, where u < 0
  t,         ///< outside the range
  segment,   ///< hit, and dropped: the entry or the exit that belongs to it is missing (brlcad/passages.h)
};
inline constexpr std::array<std::string_view, 10> rejection_names = {"none", "face", "box", "nudge", "parallel",
                                                                     "ab",   "bc",   "ca",  "t",     "segment"};
constexpr std::string_view name(Rejection r) { return rejection_names[static_cast<unsigned>(r)]; }

/// In place of a Rejection*, of a caller who doesn't ask: the code is then the same as if there were no question, and
/// so is every answer, even where the compiler may reorder sums.
struct Unasked {
  constexpr operator Rejection*() const { return nullptr; }  // NOLINT(google-explicit-constructor)
};

// Always inline: a file compiled for a processor with FMA would leave its copies of them to the linker.

/// A miss by `test`, a Rejection or a function that finds out which, told to `why` if it's there.
template <class Test>
[[gnu::always_inline]] inline std::nullopt_t missed_by(Test test, Rejection* why) {
  if (!why) return std::nullopt;
  if constexpr (std::is_same_v<Test, Rejection>)
    *why = test;
  else
    *why = test();
  return std::nullopt;
}
template <class Test>
[[gnu::always_inline]] inline std::nullopt_t missed_by(Test, Unasked) {
  return std::nullopt;
}

}  // namespace plumbline
