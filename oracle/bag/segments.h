// What a bag that isn't a set of surfaces is to a ray: pieces of it, inside of a solid or through a plate.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "case/case.h"
#include "case/query.h"

namespace plumbline {

/// A piece of the ray, in t; each end is rounded once, from its exact value, to binary64.
struct RaySegment {
  double in = 0, out = 0;
  friend bool operator==(const RaySegment&, const RaySegment&) = default;
};

/// Of a closed bag: where the ray is inside, cut by its range, in order. A line that touches the solid, and is inside
/// for no length, is not inside. Where the bag winds twice around itself, that counts as outside: pairs are made of
/// crossings as they come, as BRL-CAD makes them of a solid without orientation. No value where the origin lies on the
/// surface, the query or a triangle is invalid, or the crossings don't pair up: the bag isn't closed.
std::optional<std::vector<RaySegment>> inside(std::span<const Triangle> triangles, const Query& query);

/// Through the plate that a crossed triangle of the bag is, not cut by the range. With the length of the ray's way
/// through it, L = thickness / |cos| (thickness, where the bag has no cosine): from t - L/2 to t + L/2 centred, from t
/// to t + L appended. The ends are irrational where the normal's length is. No value where the line doesn't cross the
/// triangle, or something is invalid. The thickness is finite.
std::optional<RaySegment> plate(const Bag& bag, std::uint32_t triangle, const Query& query);

}  // namespace plumbline
