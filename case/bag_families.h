// Seeded families of bags of triangles, with rays aimed at what is hard in them: the edges and vertices that
// triangles share. A family, an aim, a seed and an index give the same bits on every machine.
//
// Exact by construction: coordinates are whole multiples of 2^(2 - bits), below 2 in magnitude; those of vertices are
// multiples of four such units, so that the quarter points of an edge are points of the grid as well. A ray goes from
// one point of the grid towards another, so it passes exactly through what it is aimed at, unless `ulps` moves it
// aside. What it meets in all is the oracle's to say.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "case/case.h"
#include "case/geometry.h"

namespace plumbline {

enum class BagFamily : unsigned char { pair, fan, strip, sphere, sheets, overlap, lattice };
inline constexpr std::array<std::string_view, 7> bag_family_names = {"pair",   "fan",     "strip",  "sphere",
                                                                     "sheets", "overlap", "lattice"};
constexpr std::string_view name(BagFamily f) { return bag_family_names[static_cast<unsigned>(f)]; }

inline constexpr std::array<std::string_view, 7> bag_family_summaries = {
    "two triangles that share an edge",
    "3 to 12 triangles all around a vertex",
    "a strip whose two sides meet along edges that one of them halves: vertices that lie within an edge",
    "a closed sphere of 1280 triangles (of 80, with less than 16 bits), its radius jittered",
    "3 to 8 parallel sheets of two triangles each, some of them very near to each other",
    "2 to 5 triangles that overlap in one plane, some of them the same twice",
    "all bags of two triangles that share an edge, with vertices from {-1, 0, 1}^3, one by one",
};
constexpr std::string_view summary(BagFamily f) { return bag_family_summaries[static_cast<unsigned>(f)]; }

/// How many bags the family lattice has; its index counts through them, again and again. Triangles without area are
/// among them.
inline constexpr std::uint64_t lattice_bags = 27 * 26 / 2 * (25 * 24 / 2);

enum class BagTarget : unsigned char {
  edge,    ///< a quarter point of an edge: a shared one, where there are such
  vertex,  ///< a shared one, where there are such; of a strip one that lies within an edge
  face,    ///< inside of a triangle
};

/// From outside and inside, where there is such a place, all triangles around the target are seen from one side: the
/// ray goes through, and touches no fold.
enum class BagOrigin : unsigned char {
  outside,  ///< of a bag that isn't closed: in front of it
  inside,   ///< or behind
  grazing,  ///< beside a triangle at the target, all but in its plane
};

struct BagAim {
  BagTarget target = BagTarget::edge;
  BagOrigin origin = BagOrigin::outside;
  Precision precision = Precision::binary32;  ///< all numbers are representable in it
  /// 8 to 24, in binary64 to 53. With 8, the products of three differences are exact in either precision.
  int bits = 8;
  int ulps = 0;  ///< by up to so many units in the last place each component of the direction is moved that isn't 0
};

struct AimedBag {
  std::vector<Triangle> triangles;  ///< the vertices go counter-clockwise seen from outside (overlap: from the front)
  bool closed = false;
  std::vector<Ray> rays;  ///< range [0, inf]
};

AimedBag draw(BagFamily family, const BagAim& aim, std::size_t rays, std::uint64_t seed, std::uint64_t index);

}  // namespace plumbline
