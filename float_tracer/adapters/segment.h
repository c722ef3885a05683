// A ray as the segment of two points that libraries ask for which know no rays, rounded as their users would round
// it, and what is asked by it.
#pragma once
#include <optional>

#include "case/case.h"
#include "case/query.h"

namespace plumbline {

/// The greatest magnitude of a component; a NaN is passed over.
double largest_component(const Vec3& v);

/// The same among the coordinates of a bag.
double largest_coordinate(const Bag& bag);

/// The least power of two by which a ray from this origin surely goes past a bag whose coordinates are at most
/// `largest`: the largest component of the direction, so multiplied, is at least four times any coordinate of bag and
/// origin. 1 where both are at zero; infinity where there is none: a zero direction, an overflow.
double reach(const Vec3& origin, const Vec3& direction, double largest);

struct Segment {
  Vec3 from, to;
  Query query;  ///< the line through these points exactly, t from 0 to 1
};

/// From the ray's point at t_min to the one at t_max, each rounded to that precision; the origin itself for t = 0.
/// Where t_max is infinite, `reach` lengths of the direction beyond the first point; where t_min is, as far before
/// the last. `largest` is that of the bag. No value where there are no two points: a coordinate or bound that is NaN,
/// an infinite coordinate, a direction of zero, an empty range or one of a single t, ends that are rounded to one,
/// ends or a difference of them beyond the precision's range.
std::optional<Segment> segment_of(const Ray& ray, double largest, Precision precision);

}  // namespace plumbline
