// Cases on integer grids of chosen widths, for the limits of the stages: extreme corners, exact meetings with edges and
// vertices, and their neighbours one unit off.
#pragma once
#include <cstdint>
#include <random>

#include "case/hard_families.h"

namespace plumbline {

using Random = std::mt19937_64;
/// Uniform in [low, high].
inline std::int64_t uniform(Random& random, std::int64_t low, std::int64_t high) {
  return low + static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(high - low + 1));
}

/// The binades that a set of numbers takes: all are integers below 2^bits in units of 2^low, and the least such bits.
struct Width {
  int low = 1 << 16, high = -(1 << 16);
  void add(const Vec3& v);
  int bits() const { return high > low ? high - low : 0; }
  int exponent() const { return high - 1; }  ///< of the largest number
};
Width point_width(const Shot& shot);
Width direction_width(const Shot& shot);

/// Points below 2^point_bits, the direction below 2^direction_bits, both at most 62; t range [0, inf]. In two of three
/// cases the line meets an edge, a vertex or the interior exactly, or misses that by one unit of one coordinate.
Shot draw_on_grids(Random& random, int point_bits, int direction_bits);

/// Points times 2^points, direction times 2^direction. Nothing may be lost.
Shot scaled(Shot shot, int points, int direction);

}  // namespace plumbline
