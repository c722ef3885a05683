// GLM (libglm-dev), glm::intersectRayTriangle of GLM_GTX_intersect; headers only, so compiled with the floating-point
// options of this project. Built only where CMake finds it.
//
// Its documentation promises the intersection of a ray and a triangle after Moller's published code: which takes
// edges and vertices for hits, and lets rays in or beside the plane, and triangles without area, miss. Nothing is
// said of hits exactly at an end of the range: unspecified. Oddities of 0.9.9.8:
// - It says true behind the origin as well (a line, then), with a negative distance. A ray being promised, its
//   callers have to test the distance; so does this adapter, against t_min and t_max. Bounds of any sign can be
//   asked.
// - |det| up to the machine epsilon of the type counts as parallel. det is a length cubed times that of the
//   direction: whether a triangle can be hit depends on the unit of length.
// - A NaN in the origin passes its comparisons: true, with a distance of NaN, which is in no range.
#pragma once
#include <memory>
#include <vector>

#include "float_tracer/tracer.h"

namespace plumbline {

/// glm_f32, glm_f64.
std::vector<std::unique_ptr<Tracer>> glm_tracers();

}  // namespace plumbline
