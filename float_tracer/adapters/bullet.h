// Bullet (libbullet-dev), btTriangleRaycastCallback::processTriangle, of Debian's single precision build; its flags
// are none, so back faces count. Built only where CMake finds it.
//
// Its interface is a segment: the points of the ray at t_min and t_max, rounded to float, and for an infinite t_max
// the one that is `reach` (segment.h) lengths of the direction away. `asked` says which segment it is; t of the
// answer is the fraction of it. A ray of which there is none is Outcome::fault: an empty range or one of a single t,
// a zero direction, NaN, an end beyond float.
//
// The manual says nothing of edges, but a remark in the source of processTriangle does: it adds a tolerance in case
// the ray hits exactly on the edge, scaled for the triangle's size. So edges are closed. It admits weights down to
// -0.0001, which beside an edge is 1e-4 of the altitude and beyond a vertex up to 1e-4 of the sum of the edges that
// meet there: slack_relative is 2e-4. Of ends on the plane, rays in it and triangles without area nothing is said:
// unspecified. Oddities of 3.24:
// - An end on the plane is no hit. Nor is one where the product of the ends' distances to the plane rounds to zero:
//   these have the unit of a volume, so that small triangles (1e-8, say) are missed by all rays.
// - A fraction that rounds to 1 is no hit, though the segment ends beyond the plane.
// - The plane's constant is a difference from the world's origin: far from it, it cancels, and chance decides.
// - The normal of a sliver cancels as well; the tolerance, which scales with its square, can't make up for it.
#pragma once
#include <memory>
#include <vector>

#include "float_tracer/tracer.h"

namespace plumbline {

/// bullet_f32.
std::vector<std::unique_ptr<Tracer>> bullet_tracers();

}  // namespace plumbline
