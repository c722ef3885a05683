// Intel's Embree 3 (libembree-dev), rtcIntersect1 on a scene per bag; built only where CMake finds it.
//
// Its documentation says of edges, coplanar rays and triangles without area nothing, and of hits exactly at tnear or
// tfar that nothing is guaranteed: all unspecified. Its answers depend on the instruction set that it picks at run
// time. Limits, checked before each call, because a build with assertions aborts the process beyond them and one
// without has no defined answer: a coordinate (of the bag, too: such a triangle would be dropped silently) that is NaN
// or of magnitude 1.844e18 or more, a NaN or negative t_min or t_max. Such a ray, or every ray at such a bag, is
// Outcome::fault. The mode of the bag is not read: every triangle counts as a surface.
#pragma once
#include <memory>
#include <vector>

#include "float_tracer/tracer.h"

namespace plumbline {

/// embree_default, and embree_robust with RTC_SCENE_FLAG_ROBUST: "robust traversal, and avoids optimizations that reduce
/// arithmetic accuracy".
std::vector<std::unique_ptr<Tracer>> embree_tracers();

}  // namespace plumbline
