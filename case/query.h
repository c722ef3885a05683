// What a tracer is really asked where its interface can't hold the ray: the end points of a segment, say, or a direction
// that it normalizes.
#pragma once
#include <optional>

#include "case/float_bits.h"
#include "case/geometry.h"

namespace plumbline {

/// A ray whose exact direction is ray.direction + direction_tail. Without a tail, the ray as it is.
struct Query {
  Ray ray;
  Vec3 direction_tail{};  ///< finite; at most half an ulp of the direction's components

  Query() = default;
  Query(const Ray& r) : ray(r) {}  // NOLINT(google-explicit-constructor): every ray is a query

  /// By the bits: a subnormal tail is one, DAZ or not.
  bool has_tail() const {
    const auto& [x, y, z] = direction_tail;
    return !is_zero(x) || !is_zero(y) || !is_zero(z);
  }
  friend bool operator==(const Query&, const Query&) = default;
};

/// The line through two points, exactly: t is 0 at `origin` and 1 at `second`. No value where a component of
/// second - origin overflows. Asks for rounding to nearest, and no flushing of subnormals.
std::optional<Query> query_through(const Vec3& origin, const Vec3& second, double t_min, double t_max);

}  // namespace plumbline
