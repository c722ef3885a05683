// Families with a dial: seeded random shots that grow harder step by step, each dial in one way alone, so that error can be
// drawn over difficulty. A dial, a setting, a precision, a seed and an index give the same bits on every machine.
//
// All numbers are representable in the precision. They are drawn in binary64 and rounded, so where a ray is aimed at a
// point it meets it as nearly as rounding lets; what the ray really meets is the oracle's to say. Rays have the range
// [0, inf]. About a third of them hit where nothing else is said.
#pragma once
#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "case/case.h"
#include "case/hard_families.h"

namespace plumbline {

/// The setting is an exponent k of 2 but for lattice; triangles have the size 1.
enum class Dial : unsigned char {
  needle,           ///< one edge is 2^-k of the others
  cap,              ///< a vertex lies 2^-k beside the middle of the opposite edge
  grazing,          ///< the ray starts 2^-k above the plane, a length away
  parallel,         ///< the ray starts a length above the plane and nears it by 2^-k of its way: hardly any hits
  far,              ///< triangle and origin are 2^k away from 0
  tiny,             ///< points are scaled by 2^-k
  huge,             ///< points are scaled by 2^k
  near_start,       ///< the ray starts 2^-k before or behind the plane
  near_edge,        ///< the ray passes by an edge at 2^-k, on either side: half of them hit
  near_vertex,      ///< the same of a vertex
  lattice,          ///< coordinates of k bits, exactly through an edge or vertex: all hit but what is degenerate
  direction_scale,  ///< the direction has the length 2^k or 2^-k
  mixed_exponents,  ///< coordinates spread over k binades, aimed at a vertex
};
inline constexpr std::array<std::string_view, 13> dial_names = {
    "needle",     "cap",       "grazing",     "parallel", "far",             "tiny",           "huge",
    "near_start", "near_edge", "near_vertex", "lattice",  "direction_scale", "mixed_exponents"};
constexpr std::string_view name(Dial d) { return dial_names[static_cast<unsigned>(d)]; }

/// What an axis of the settings says: "longest edge over altitude, log2".
std::string_view meaning(Dial dial);

/// From easy to as hard as the precision can hold, in even steps.
std::vector<int> settings(Dial dial, Precision precision);

/// At one of settings(), or any in between.
Shot draw(Dial dial, int setting, Precision precision, std::uint64_t seed, std::uint64_t index);

}  // namespace plumbline
