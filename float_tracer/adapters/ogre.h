// The OGRE engine (libogre-1.12-dev), Math::intersects(ray, a, b, c, true, true); built only where CMake finds it.
//
// Both sides are asked for. A ray is "a line with an origin and direction", of any length; t_min and t_max are not
// read, and whether t = 0 belongs to it isn't said. Of edges, rays in the plane and triangles without area it says
// nothing either: all unspecified. It answers with t only. A coordinate that is not finite is Outcome::fault: see
// below. The mode of the bag is not read: every triangle counts as a surface.
//
// Oddities:
// - It tests the point in the plane with "alpha < -1e-6 * area" and the like: a triangle is widened by 1e-6 of its
//   height beside each edge, of which the documentation has nothing.
// - These comparisons reject, so a NaN passes them: with a NaN in the origin it hits whatever the plane is like, and
//   the same where finite numbers overflow on the way.
// - A ray is called parallel where |D . N| is at most 2^-23, absolutely, N being the product of two edges: small
//   triangles are missed, and short directions miss.
#pragma once
#include <memory>
#include <vector>

#include "float_tracer/tracer.h"

namespace plumbline {

/// ogre_f32.
std::vector<std::unique_ptr<Tracer>> ogre_tracers();

}  // namespace plumbline
