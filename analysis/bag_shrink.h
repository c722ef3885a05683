// Makes a finding in a bag plain: the fewest triangles that the tracer gets wrong in the same way, then the simplest
// numbers.
//
// Triangles are taken away in halves, quarters and so on, down to one by one (delta debugging: Zeller and Hildebrandt,
// IEEE Transactions on Software Engineering 28(2), 2002). Then every coordinate of a vertex, which its triangles keep
// sharing, and of the ray is rounded to as few bits as may be, over and over until nothing changes; before that the bag
// is moved towards the origin, where it still is wrong there. Of up to four triangles, numbers are also simplified hard
// and one coordinate is solved for exactly, which puts the ray back onto its knife's edge. Simpler is as in shrink.h.
// Every step is examined by tracer and oracle; the same case and tracer give the same result. Of a death triangles
// alone are taken away: each try may be a hang, and take all the time that the tracer is allowed.
#pragma once
#include <cstdint>
#include <optional>

#include "analysis/bag_examine.h"

namespace plumbline {

struct ShrunkBag {
  Case what;  ///< at the tracer's precision
  BagExamination before, after;
  unsigned bits_before = 0, bits_after = 0;  ///< significant_bits of both
  std::uint64_t tries = 0;                   ///< cases examined
};

/// Keeps tracer and signature; and what is wrong by 1024 ulps or more stays so. No value where the tracer gets the case
/// right.
std::optional<ShrunkBag> shrink_bag(const Case& asked, const Tracer& tracer);

/// Significant bits of all numbers; a coordinate that vertices share counts once for each vertex, not for each
/// triangle. A default range counts nothing.
unsigned significant_bits(const Case& what);

}  // namespace plumbline
