// The exact truth of one ray and one triangle, as far as signs go. Eight bytes; what costs more is asked for apart:
// contact.h (rays that touch without crossing), measure.h (t, u, v), severity.h.
#pragma once
#include <array>
#include <string_view>

#include "case/hit_class.h"

namespace plumbline {

enum class Invalid : unsigned char {
  none,
  triangle_not_finite,
  origin_not_finite,
  direction_not_finite,
  zero_direction,
  range_nan,
};
inline constexpr std::array<std::string_view, 6> invalid_reasons = {
    "",
    "a coordinate of the triangle is NaN or infinite",
    "a coordinate of the origin is NaN or infinite",
    "a coordinate of the direction is NaN or infinite",
    "the direction is zero",
    "a bound of the t range is NaN"};
constexpr std::string_view reason(Invalid invalid) { return invalid_reasons[static_cast<unsigned>(invalid)]; }

struct Truth {
  HitClass hit_class = HitClass::invalid;  ///< of the line through the ray
  Feature feature = Feature::none;
  signed char det_sign = 0;      ///< sign of direction . ((b-a) x (c-a)): < 0 where the ray meets the front
  signed char versus_t_min = 0;  ///< interior, edge, vertex: sign of t - t_min
  signed char versus_t_max = 0;  ///< interior, edge, vertex: sign of t - t_max
  Invalid invalid = Invalid::none;
  std::array<unsigned char, 2> unused = {};  ///< zero
  friend bool operator==(const Truth&, const Truth&) = default;
};

/// Whether the line crosses the closed triangle at a t of the closed range. What remains open where this is false is
/// contact without a crossing (coplanar, degenerate): see hit() in contact.h.
constexpr bool crosses(const Truth& truth) {
  return truth.hit_class <= HitClass::vertex && truth.versus_t_min >= 0 && truth.versus_t_max <= 0;
}

}  // namespace plumbline
