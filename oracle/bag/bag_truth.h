// Where a ray meets a bag of triangles, exactly: every triangle that it crosses, in the exact order of t, with exact
// ties kept as ties; the triangles that it touches without crossing; how often it goes through.
//
// Triangles are surfaces here; what solids and plates make of it is in segments.h. This file asks every triangle;
// scene.h is for many of them.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "case/query.h"
#include "oracle/truth.h"

namespace plumbline {

/// A triangle that is crossed within the closed t range.
struct BagHit {
  std::uint32_t triangle = 0;
  std::uint32_t rank = 0;  ///< 0 nearest; equal where t is exactly equal, else greater by 1
  Truth truth;
  bool owner = false;  ///< see owner.h
  double t = 0;        ///< rounded correctly to binary64
};

/// Where a ray touches a triangle without crossing it: along a stretch of its plane, or a triangle without area.
struct Stretch {
  std::uint32_t triangle = 0;
  HitClass hit_class = HitClass::coplanar;  ///< or degenerate
  double low = 0, high = 0;  ///< in t, cut by the range, each rounded correctly to binary64; equal for a single point
};

struct BagTruth {
  Invalid invalid = Invalid::none;  ///< of the ray, or of the first triangle that is
  std::vector<BagHit> hits;         ///< by t; of equal ones the lower index first
  std::vector<Stretch> stretches;   ///< by index
  bool on_surface = false;          ///< the origin lies on a triangle

  /// How many triangles are at the nearest t: hits[0] to hits[nearest() - 1].
  std::size_t nearest() const;
  /// How often a ray turned aside infinitesimally goes through the bag, within the range: of a closed bag odd if one
  /// end is inside. No value where the origin lies on the surface.
  std::optional<std::uint32_t> crossings() const;
  /// The same, out of the bag counted as 1 and into it as -1 (seen from outside, vertices go counter-clockwise).
  std::optional<std::int32_t> signed_crossings() const;
};

/// At most 2^32 - 1 triangles.
BagTruth bag_truth(std::span<const Triangle> triangles, const Query& query);

/// How often a bag winds around a point: of a closed bag, oriented outwards, 1 inside and 0 outside. No value where the
/// point lies on a triangle. What the bag isn't, closed, is not noticed. Throws InputError for what isn't finite.
std::optional<std::int32_t> winding_number(std::span<const Triangle> triangles, const Vec3& point);

}  // namespace plumbline
