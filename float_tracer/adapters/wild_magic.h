// Geometric Tools' Wild Magic 5 (libwildmagic-dev), IntrRay3Triangle3<Real>::Find; built only where CMake finds it.
//
// It says that a ray is P + t D with t >= 0, and that its user must ensure that D has unit length; so that is what it
// is asked: the direction divided by its length, in binary64 and rounded to Real. The range is that of a ray; t_min
// and t_max are not read. Of edges, rays in the plane and triangles without area it says nothing: unspecified. A
// direction that is zero or not finite has no unit vector: Outcome::fault. The mode of the bag is not read: every
// triangle counts as a surface.
//
// Oddities:
// - A ray is called parallel where |D . N| <= 1e-6 (binary32) or 1e-8 (binary64), absolutely, N being the product of
//   two edges: every triangle with edges below about 1e-3 or 1e-4 is missed, from wherever.
// - Where N overflows (edges beyond about 1e19 in binary32), D . N is infinite, no sum of weights is larger, and the
//   edge from the second vertex to the third is not there: it hits beside, with t NaN.
#pragma once
#include <memory>
#include <vector>

#include "float_tracer/tracer.h"

namespace plumbline {

/// wild_magic_f32 and wild_magic_f64.
std::vector<std::unique_ptr<Tracer>> wild_magic_tracers();

}  // namespace plumbline
