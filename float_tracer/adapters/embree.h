// Intel's Embree 3 (libembree-dev) on a scene per bag; built only where CMake finds it.
//
// Its documentation says of edges, coplanar rays and triangles without area nothing, and of hits exactly at tnear or
// tfar that nothing is guaranteed: all unspecified. Limits, checked before each call, because a build with assertions
// aborts the process beyond them and one without has no defined answer: a coordinate (of the bag, too: such a
// triangle would be dropped silently) that is NaN or of magnitude 1.844e18 or more, a NaN or negative t_min or t_max.
// Such a ray, or every ray at such a bag, is Outcome::fault. The mode of the bag is not read: every triangle counts
// as a surface.
//
// Oddities (corpus/adapters/embree.case):
// - The answers depend on the instruction set, avx2 and avx512 with fused multiply-add, sse2 without; so does which
//   one Embree picks at run time. A name with an instruction set pins it; one that this processor lacks is not
//   listed.
// - Where a ray begins on the triangle, the default flags miss and the robust ones hit.
// - The determinant underflows for triangles of about 1e-20: all missed, robust or not.
// - The robust flag widens: it hits beside edges, by far more than it misses there.
#pragma once
#include <memory>
#include <vector>

#include "float_tracer/tracer.h"

namespace plumbline {

/// embree_default, and embree_robust with RTC_SCENE_FLAG_ROBUST: "robust traversal, and avoids optimizations that
/// reduce arithmetic accuracy". Each also with a suffix: _sse2, _avx2, _avx512 for an instruction set; _w4, _w8, _w16
/// for packets of so many rays, neighbours in the span; _occluded for rtcOccluded1, which says hit or miss only.
std::vector<std::unique_ptr<Tracer>> embree_tracers();

}  // namespace plumbline
