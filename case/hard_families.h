// Seeded random families of one triangle and one ray that are hard to decide, each for another reason. A family, a seed
// and an index give the same bits on every machine.
#pragma once
#include <array>
#include <cstdint>
#include <string_view>

#include "case/geometry.h"

namespace plumbline {

enum class Family : unsigned char {
  random,          ///< coordinates uniform in [-1, 1]: easy, for comparison
  small_far,       ///< triangles of size 2^-10 at distance 1, about half of them hit
  lattice_points,  ///< origin, target and vertices from {0, 1.5}^3
  exact_edge12,  ///< the ray passes exactly through an edge or vertex; coordinates on a 12-bit grid
  exact_edge23,  ///< the same on a 23-bit grid: what binary32 holds
  exact_edge51,  ///< the same on a 51-bit grid: full mantissas
  ulp12,         ///< exact_edge12 with one coordinate moved by one unit in the last place
  ulp51,         ///< exact_edge51 likewise
  coplanar,      ///< the line runs exactly in the triangle's plane
  degenerate,    ///< collinear or coinciding vertices
  mixed40,       ///< coordinates spread over 40 binades, aimed at vertex A as nearly as rounding lets
  wide,          ///< every coordinate's exponent uniform in +-500
  wide_edge,     ///< exact_edge51 with each axis and the direction scaled by powers of two up to 2^+-300
  full_range,    ///< any finite bits: subnormals, huge values, signed zeros
  // Aimed at a point of the triangle's plane, as nearly as rounding lets; about a third of them hit.
  sliver,     ///< an altitude 2^-20 of the longest edge
  far,        ///< triangle and origin 2^20 times their size away from 0
  grazing,    ///< the origin above the plane by 2^-20 of its distance
  tiny,       ///< points scaled by 2^-66: products of three underflow in binary32
  huge,       ///< points scaled by 2^59: they overflow there
  edge_ulps,  ///< aimed at a point of edge AB
};
inline constexpr std::array<std::string_view, 20> family_names = {
    "random", "small_far",  "lattice_points", "exact_edge12", "exact_edge23", "exact_edge51", "ulp12",
    "ulp51",  "coplanar",   "degenerate", "mixed40",   "wide",         "wide_edge",    "full_range",
    "sliver", "far",        "grazing", "tiny",         "huge",         "edge_ulps"};
constexpr std::string_view name(Family f) { return family_names[static_cast<unsigned>(f)]; }

struct Shot {
  Triangle triangle;
  Ray ray;
};

/// About half of the rays have the range [0, inf]; the others end or begin at small dyadic t, often exactly at the hit.
Shot draw(Family family, std::uint64_t seed, std::uint64_t index);

}  // namespace plumbline
