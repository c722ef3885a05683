// Where a ray and a triangle are, for pictures of them: each number is rounded correctly from the exact one, so that
// a picture may be zoomed until an ulp is seen. Lengths are the case's own.
#pragma once
#include <array>
#include <optional>

#include "case/query.h"

namespace plumbline {

struct Point2 {
  double x = 0, y = 0;
};

/// A triangle in a plane, around the point where the ray is, (0, 0). One edge runs to the right, and the corner that
/// is not on it is not below it.
struct Outline {
  std::array<Point2, 3> corner;  ///< a, b, c
  std::array<Point2, 3> edge;    ///< b - a, c - b, a - c: not differences of the above, which would cancel
};

/// Seen along the ray, whose line is a point; `base` is the edge that runs to the right: 0 ab, 1 bc, 2 ca. How far
/// the ray has to be moved sideways for another answer is a distance in this view. No value where det is 0 or the
/// case is invalid.
std::optional<Outline> seen_along_ray(const Triangle& triangle, const Query& query, unsigned base);

/// Seen at right angles to the triangle's plane, around the point where the line meets it. There where the other is.
std::optional<Outline> seen_flat(const Triangle& triangle, const Query& query, unsigned base);

/// How far origin + t * direction is off the triangle's plane; above is where its vertices appear counter-clockwise.
/// No value where the triangle has no area, the case is invalid, or t is not finite.
std::optional<double> height_above_plane(const Triangle& triangle, const Query& query, double t);

}  // namespace plumbline
