// CGAL's kernels (libcgal-dev, the LGPL part), do_intersect(Ray_3, Triangle_3); built only where CMake finds them.
//
// Its documentation calls the triangle closed and a ray one that begins at its first point: edges, vertices and t = 0
// belong to it, and so does contact in the plane. A triangle without area is against do_intersect's precondition: the
// adapter asks the kernel's own is_degenerate and leaves such triangles out, so of these the contract says nothing.
// t_min and t_max are not read: a Ray_3 has no bounds.
//
// do_intersect says hit or miss; no t, u, v. Of several triangles the first in the bag that is met is named, not the
// nearest. The mode of the bag is not read. A coordinate that is not finite, a zero direction, or a second point that
// is rounded to the first is Outcome::fault.
//
// Oddities (corpus/adapters/cgal.case):
// - Ray_3(point, vector) keeps two points: where the numbers are doubles, the second is origin + direction, rounded,
//   and that line is what is asked. A short direction at a far origin vanishes altogether. With EPECK it is exact.
// - The side on which the ray leaves the plane is the sign of orientation(a, b, c, a + (second - first)): with plain
//   doubles a far triangle swallows the direction, which then counts as parallel.
// - With plain doubles a determinant that underflows is zero, and zero means coplanar: triangles of 2^-400 are hit by
//   rays that point away from them; smaller ones are degenerate, and missed.
#pragma once
#include <memory>
#include <vector>

#include "float_tracer/tracer.h"

namespace plumbline {

/// cgal_cartesian_f64, plain double arithmetic; cgal_epick, exact predicates; cgal_epeck, exact constructions, too.
std::vector<std::unique_ptr<Tracer>> cgal_tracers();

}  // namespace plumbline
