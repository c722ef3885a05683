// An independent judge: CGAL's exact predicates and exact constructions kernel. Origin and direction are kept apart;
// the second point O + D is constructed exactly, never rounded.
#pragma once
#include "case/geometry.h"
#include "tests/judges/judged.h"

namespace plumbline::judges {

/// The case is not invalid.
Judged epeck_judged(const Triangle& triangle, const Ray& ray);

}  // namespace plumbline::judges
