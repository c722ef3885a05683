// Points beside a triangle: moved off it along its exact normal, as far as one asks.
#pragma once
#include <span>
#include <vector>

#include "case/case.h"
#include "case/geometry.h"

namespace plumbline {

/// point + distance * N / |N|, for each distance, where N = (b-a) x (c-a), so that a positive one is on the side from
/// which the vertices appear counter-clockwise, and |N| is N's largest component: the coordinate that moves most
/// moves by the distance, the others in proportion. Each is rounded once, straight from its exact value, to nearest,
/// ties to even, to the precision. Empty where the triangle has no area or something is not finite.
std::vector<Vec3> moved_off(const Triangle& triangle, const Vec3& point, std::span<const double> distances,
                            Precision precision);

}  // namespace plumbline
