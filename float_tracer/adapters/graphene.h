// graphene (libgraphene-1.0-dev, 1.10 or newer), graphene_ray_intersect_triangle, on the vector unit that Debian's
// build uses. Built only where CMake finds it.
//
// Its ray has a normalized direction: `asked` reads it back, with t_min and t_max scaled to it, and t of the answer
// is a distance. It starts at its origin: a negative t_min is Outcome::fault, and so is a direction that comes back
// as zero or not finite. The distance is tested against t_min and t_max here.
//
// Its documentation says nothing of edges, triangles without area and hits exactly at an end of the range:
// unspecified. A remark in its source says that parallel rays are no hit, even where they do intersect: coplanar is a
// miss. Oddities of 1.10.8:
// - The direction is multiplied by an estimate of the reciprocal square root, improved once: its length is 1 only to
//   some 2^-22, and which bits come out depends on the maker of the processor. A ray that runs exactly through an
//   edge, or in the plane, seldom does so once normalized.
// - Directions no longer than 2^-23 become zero, and those of 2^64 and more not a number.
// - |det| below 2^-23 counts as parallel. With a unit direction det is twice the area seen along the ray: triangles
//   of area below 6e-8 can't be hit.
#pragma once
#include <memory>
#include <vector>

#include "float_tracer/tracer.h"

namespace plumbline {

/// graphene_f32.
std::vector<std::unique_ptr<Tracer>> graphene_tracers();

}  // namespace plumbline
