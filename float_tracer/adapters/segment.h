// A ray as the segment that libraries ask for, and what is asked by it.
#pragma once
#include <optional>

#include "case/case.h"
#include "case/query.h"

namespace plumbline {

/// The greatest magnitude among the coordinates of a bag.
double largest_coordinate(const Bag& bag);

/// The least power of two by which a ray from this origin surely goes past a bag whose coordinates are at most
/// `largest`: the largest component of the direction, so multiplied, is at least four times any coordinate of bag and
/// origin. 1 where both are at zero; infinity where there is none: a zero direction, an overflow.
double reach(const Vec3& origin, const Vec3& direction, double largest);

struct Segment {
  Vec3 from, to;
};

/// From the ray's point at t_min to the one at t_max, each rounded; the origin itself for t_min = 0. Where t_max is
/// infinite, `reach` lengths of the direction beyond the first point; where t_min is, as far before. No value for an
/// empty range, one of a single t, and points that aren't finite at that precision.
std::optional<Segment> segment_of(const Ray& ray, double largest, Precision precision);

/// What is asked by the segment: the line through its ends, with t in [0, 1]. The ray itself where there is none.
Query asked_by(const std::optional<Segment>& segment, const Ray& ray);

}  // namespace plumbline
