// Whether a line may meet a box of the tree: an answer that errs on the side of meeting. Private to the oracle.
#pragma once
#include <array>
#include <cmath>

#include "case/query.h"
#include "oracle/bag/box_tree.h"
#include "oracle/lanes.h"

namespace plumbline {
namespace {

/// A line as the test reads it. Default controls.
struct BoxProbe {
  std::array<double, 3> origin, inverse;
  std::array<bool, 3> backward;  ///< it comes from the high side
  std::array<bool, 3> still;     ///< its direction is exactly 0 here
  std::array<bool, 3> unusable;  ///< no plane is compared: still, or the inverse is of a size that rounds badly
  bool plain = true;             ///< none is unusable

  explicit BoxProbe(const Query& query) {
    const auto& [ray, tail] = query;
    origin = {ray.origin.x, ray.origin.y, ray.origin.z};
    const std::array<double, 3> direction = {ray.direction.x, ray.direction.y, ray.direction.z};
    const std::array<double, 3> rest = {tail.x, tail.y, tail.z};
    for (std::size_t i = 0; i < 3; ++i) {
      const double size = std::fabs(direction[i]);
      still[i] = direction[i] == 0 && rest[i] == 0;
      unusable[i] = !(size > 0x1p-1000 && size < 0x1p+1000);
      backward[i] = direction[i] < 0;
      inverse[i] = unusable[i] ? 0 : 1 / direction[i];
      plain = plain && !unusable[i];
    }
  }
};

/// Where a line enters a node's two children, and whether it may meet them between `from` and `to`.
struct BoxEntry {
  std::array<double, 2> near;
  unsigned met;  ///< a bit per child
};

// The exact parameter of a plane is (b - o) / D. Computed are a difference, an inverse and a product, with D within
// 2^-53 of the direction without its tail: a relative error of at most 4.1 * 2^-53 < 2^-50, and where the product
// underflows an absolute one of 2^-1074. (A difference that is subnormal is exact; the inverse is within 2^-1000 and
// 2^1000, or the axis is unusable.) So where entry <= exit exactly, of two computed numbers entry - exit <= 2^-50
// (|entry| + |exit|) (1 + 2^-50)
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

}  // namespace
}  // namespace plumbline
