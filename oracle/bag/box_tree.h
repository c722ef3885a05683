// A tree of boxes over triangles, for finding those that a line may meet. It never loses one: boxes are rounded outwards
// and their test errs on the side of meeting. Private to the oracle.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "case/query.h"
#include "oracle/lanes.h"

namespace plumbline {

/// Two children in one cache line: a box for each, bounds in binary32, and where they go on.
struct alignas(64) BoxNode {
  std::array<std::array<float, 2>, 3> low, high;  ///< [axis][child]
  std::array<std::uint32_t, 2> child;             ///< a node; of a leaf its first triangle
  std::array<std::uint32_t, 2> count;             ///< triangles of a leaf, at most leaf_size; or `node`
  static constexpr std::uint32_t node = ~std::uint32_t{0};
};

struct BoxTree {
  static constexpr std::uint32_t leaf_size = 4;
  static constexpr std::size_t depth = 128;  ///< at most

  std::vector<BoxNode> nodes;        ///< the root first; none where there is no triangle
  std::vector<std::uint32_t> order;  ///< leaf triangles, as indices of those that it was built from

  /// Surface area heuristic in 16 bins. The triangles are finite. (Wald, "On fast construction of SAH-based bounding
  /// volume hierarchies", 2007.)
  static BoxTree build(std::span<const Triangle> triangles);
};

/// A line as the tree's test reads it. Default controls.
struct BoxProbe {
  explicit BoxProbe(const Query& query);

  std::array<double, 3> origin, inverse;
  std::array<bool, 3> backward;  ///< it comes from the high side
  std::array<bool, 3> still;     ///< its direction is exactly 0 here
  std::array<bool, 3> unusable;  ///< no test is made: still, or the inverse would be of a size that rounds badly
  bool plain;                    ///< none is unusable
};

/// Where a line enters a node's two children, and whether it may meet them between `from` and `to`.
struct BoxEntry {
  std::array<double, 2> near;
  unsigned met;  ///< a bit per child
};

// The exact parameter of a plane is (b - o) / D. Computed are a difference, an inverse and a product, with D within 2^-53
// of the direction without its tail: a relative error of at most 4.1 * 2^-53 < 2^-50, and where the product underflows an
// absolute one of 2^-1074. (A difference that is subnormal is exact; the inverse is within 2^-1000 and 2^1000, or the axis
// is unusable.) So where entry <= exit exactly, of two computed numbers entry - exit <= 2^-50 (|entry| + |exit|) (1 + 2^-50)
// + 2^-1073, and twice that covers the roundings below. Infinities, of a bound or a quotient that overflows, make the
// slack infinite or the difference a NaN, which rejects nothing.
[[gnu::always_inline]] inline BoxEntry enter(const BoxNode& node, const BoxProbe& probe, double from, double to) {
  using L = Lanes<2>;
  L::Real near = L::all(from), far = L::all(to);
  L::Int outside{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& entry = probe.backward[i] ? node.high[i] : node.low[i];
    const auto& exit = probe.backward[i] ? node.low[i] : node.high[i];
    const L::Real first = {entry[0], entry[1]}, last = {exit[0], exit[1]}, origin = L::all(probe.origin[i]);
    if (!probe.plain && probe.unusable[i]) {
      if (probe.still[i]) outside |= (first > origin) | (last < origin);
      continue;
    }
    const L::Real inverse = L::all(probe.inverse[i]);
    near = L::max((first - origin) * inverse, near);
    far = L::min((last - origin) * inverse, far);
  }
  const L::Real slack = 0x1p-49 * (L::abs(near) + L::abs(far)) + 0x1p-1022;
  return {{near[0], near[1]}, ~L::bits((L::Int)(near - far > slack) | outside) & 3};
}

}  // namespace plumbline
