// A tree of boxes over triangles, for finding those that a line may meet (box_probe.h). Boxes are rounded outwards, so
// that none is lost. Private to the oracle.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "case/geometry.h"

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

}  // namespace plumbline
