// Gazebo's (formerly Ignition) Math (libignition-math-dev), Triangle3<T>::Intersects(Line3<T>, point), templates in
// its headers over a compiled library; built only where CMake finds it.
//
// A Line3 is a segment; segment.h says which. Its documentation: "True if the given line intersects this
// triangle", the point given being "the point on the triangle that the line intersects", and of a segment in the
// plane that on the closest edge, or its start if it is within: edges (where a point "inside or on the triangle" is
// contained) are closed, and coplanar segments are hits. Of the segment's ends and of triangles without area it says
// nothing: unspecified. It answers with a point; t is worked out of it here. A coordinate that is not finite, or a
// ray without a segment, is Outcome::fault: its comparisons reject, so a NaN passes them. The mode of the bag is not
// read: every triangle counts as a surface.
//
// Oddities, in 6.10:
// - A segment that is not parallel to the plane is never tested against the edges: the function returns true for
//   every segment that meets the triangle's *plane*. (Its other function, Contains(point), has the test.)
// - It misses where the plane is nearer to the segment's start than 1.0, a distance: in the source the distance is
//   compared with 1.0 as if it were a fraction.
// - A segment is called parallel where |d . n| <= 1e-6 of unit vectors; but vectors no longer than 1e-6 are left as
//   they are, so every segment is parallel to a triangle with edges of 1e-3.
// - A segment called parallel is contained if both its ends are; else it has to come within 1e-6 of an edge. Two
//   segments with |d x e| <= 1e-6 count as parallel, and then as meeting if an end of the edge lies in the box around
//   the other, however far from its line.
// - Whether a point is in the triangle's plane is asked of a plane through the origin of the coordinates: a segment
//   within a triangle elsewhere is missed, unless it touches an edge.
// - Where the square of the segment's length overflows, its direction is zero, thus parallel.
#pragma once
#include <memory>
#include <vector>

#include "float_tracer/tracer.h"

namespace plumbline {

/// gz_math_f32 and gz_math_f64.
std::vector<std::unique_ptr<Tracer>> gz_math_tracers();

}  // namespace plumbline
