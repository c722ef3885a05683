// cglm (libcglm-dev), glm_ray_triangle; inline functions, so compiled with the floating-point options of this
// project. Built only where CMake finds it.
//
// Its documentation names Moller and Trumbore's algorithm and says no more. So as their paper has it: edges and
// vertices are hits, and rays in or beside the plane and triangles without area miss. Of hits exactly at an end of
// the range nothing is said: unspecified. It hands back no u and v. It starts at the origin, so a negative t_min is
// Outcome::fault; the distance is tested against t_min and t_max here. Oddities of 0.8.8:
// - |det| < 1e-6 counts as parallel. det is a length cubed times that of the direction: whether a triangle can be hit
//   depends on the unit of length, and with unit directions none of area below 5e-7 can.
// - A hit at t <= 1e-6 is none, however long the direction is.
// - A NaN in the origin passes all comparisons but that of t.
#pragma once
#include <memory>
#include <vector>

#include "float_tracer/tracer.h"

namespace plumbline {

/// cglm_f32.
std::vector<std::unique_ptr<Tracer>> cglm_tracers();

}  // namespace plumbline
