// A case as 125-bit integers, where it is one: the points multiples of one power of two, the direction of
// another. Full doubles over 72 binades are. Reads bits only: rounding mode, FTZ and DAZ have no say. Private
// to the oracle.
#pragma once
#include <algorithm>
#include <optional>

#include "oracle/decoded.h"
#include "oracle/largest.h"
#include "oracle/wide_int.h"

namespace plumbline {

/// Coordinates are integers times 2^point_unit (the direction's, times 2^direction_unit), below 2^125 in
/// magnitude. So differences are below 2^126, components of the cross product of two of them below 2^253, its
/// product with a third below 3 * 2^379, that of two cross products below 3 * 2^506: 2, 4, 6 and 8 words hold
/// them.
struct WideCase {
  static constexpr int bits = 125;

  WideVec<2> origin, direction, a, b, c;
  int point_unit = 0, direction_unit = 0;

  /// Of numbers of which that is the largest in magnitude. Not looked at further where it is 0, infinite or
  /// NaN.
  static int unit(double largest) { return Decoded(largest).high() - bits; }

  /// No value where the coordinates are not such integers, or one is NaN or infinite. The direction may be
  /// zero.
  static std::optional<WideCase> make(const Triangle& triangle, const Ray& ray) {
    // A number below the unit is seen before any is scaled.
    const double point = largest_magnitude(ray.origin, triangle.a, triangle.b, triangle.c);
    if (!is_finite(point)) return std::nullopt;
    if (below(least_magnitude(ray.origin, triangle.a, triangle.b, triangle.c), unit(point))) return std::nullopt;
    const double direction = largest_magnitude(ray.direction);
    if (!is_finite(direction)) return std::nullopt;
    if (below(least_magnitude(ray.direction), unit(direction))) return std::nullopt;
    WideCase x;
    x.point_unit = unit(point);
    x.direction_unit = unit(direction);
    std::uint64_t lost = 0;
    x.origin = scaled(ray.origin, x.point_unit, lost);
    x.direction = scaled(ray.direction, x.direction_unit, lost);
    x.a = scaled(triangle.a, x.point_unit, lost);
    x.b = scaled(triangle.b, x.point_unit, lost);
    x.c = scaled(triangle.c, x.point_unit, lost);
    if (lost != 0) return std::nullopt;
    return x;
  }

 private:
  static bool below(double x, int unit) { return Decoded(x).high() <= unit; }
  static WideVec<2> scaled(const Vec3& v, int unit, std::uint64_t& lost) {
    return {scaled(v.x, unit, lost), scaled(v.y, unit, lost), scaled(v.z, unit, lost)};
  }
  // x / 2^unit; what is below the unit goes to `lost`.
  static WideInt<2> scaled(double x, int unit, std::uint64_t& lost) {
    const Decoded k(x);
    const int up = k.exponent - unit;  // at most bits - 53
    Word128 magnitude = static_cast<Word128>(k.significand) << std::max(up, 0);
    if (up < 0 && k.significand != 0) {
      const int down = std::min(-up, 63);
      magnitude >>= down;
      lost |= k.significand & ((std::uint64_t{1} << down) - 1);
    }
    const Int128 negative = k.negative ? -1 : 0;
    return WideInt<2>((static_cast<Int128>(magnitude) ^ negative) - negative);
  }
};

}  // namespace plumbline
