// ODE (libode-dev), dCollide of a ray with a triangle mesh per bag, for the closest hit on either side, of Debian's
// double precision build. Built only where CMake finds it.
//
// Its ray has a normalized direction and a length: `asked` reads the former back; t of the answer is a distance. For
// an infinite t_max the length is the `reach` (segment.h) of that direction. The ray starts at its origin.
// Outcome::fault, because some of it aborts the process: coordinates that are not finite or, of mesh and origin,
// beyond float; a direction whose length is zero, subnormal or overflows; a negative or NaN t_min; a range whose end
// is not positive and finite. Nor may two threads ask at once, this build having one cache for all: the adapter lets
// one in at a time.
//
// The manual says nothing of edges, rays in the plane, triangles without area and hits exactly at an end of the
// range: all unspecified. Oddities of 0.16.2:
// - Doubles outside, floats inside: mesh and ray are rounded to float before they meet (what the contract, of
//   doubles, doesn't excuse), so that a direction normalized in double is rounded once more.
// - A weight or distance of -0 counts as negative: of two rays from a point of the triangle one misses, and so do
//   rays through edges, by the winding.
// - |det| up to 1e-6 times the square of the shorter of the edges ab and ac counts as parallel, det being twice the
//   area seen along the ray. So rays at less than 1e-6 to the plane are missed, and so are slivers with their narrow
//   angle at a, which with another vertex first are hit.
// - With edges below 2^-63 the reciprocal of det overflows in float, and all is missed.
#pragma once
#include <memory>
#include <vector>

#include "float_tracer/tracer.h"

namespace plumbline {

/// ode_f64.
std::vector<std::unique_ptr<Tracer>> ode_tracers();

}  // namespace plumbline
