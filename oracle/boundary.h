// Solves one coordinate exactly, so as to put a ray on the boundary of a decision: each determinant that
// decides is affine in every single coordinate of the case, det = p + q x, and is zero at x = -p/q.
#pragma once
#include <optional>

#include "case/case.h"
#include "case/geometry.h"

namespace plumbline {

/// w_AB, w_BC, w_CA, det, T - t_min det, T - t_max det (README.md).
enum class Decision : unsigned char { ab, bc, ca, det, t_min, t_max };

/// The value of that coordinate at which the determinant is zero, rounded once, to nearest, ties to even,
/// straight from the exact fraction to the precision; what the coordinate is now doesn't matter. Coordinates:
/// 0-2 origin, 3-5 direction, 6-8 a, 9-11 b, 12-14 c. No value where the determinant doesn't depend on it,
/// where the case or the bound of t is not finite, or where the value is too large for the precision.
std::optional<double> boundary(const Triangle& triangle, const Ray& ray, Decision decision, int coordinate,
                               Precision precision = Precision::binary64);

}  // namespace plumbline
