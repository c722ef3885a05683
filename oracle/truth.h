// The exact truth of one ray and one triangle, as far as signs go. Eight bytes; what needs numbers (t, u, v, severity)
// is in measure.h and severity.h.
#pragma once
#include <optional>

#include "case/hit_class.h"

namespace plumbline {

enum class Invalid : unsigned char { none, triangle_not_finite, origin_not_finite, direction_not_finite, zero_direction, range_nan };

struct Truth {
  HitClass hit_class = HitClass::invalid;  ///< of the line through the ray
  Feature feature = Feature::none;
  signed char det_sign = 0;      ///< sign of direction . ((b-a) x (c-a)): < 0 where the ray meets the front
  signed char versus_t_min = 0;  ///< sign of t - t_min, where det_sign != 0
  signed char versus_t_max = 0;  ///< sign of t - t_max, where det_sign != 0
  bool touches = false;          ///< coplanar, degenerate: the closed t range holds a point of the closed triangle
  Invalid invalid = Invalid::none;
  friend bool operator==(const Truth&, const Truth&) = default;
};

/// Whether t lies in the closed range. Meaningful where det_sign != 0.
constexpr bool in_range(const Truth& truth) { return truth.versus_t_min >= 0 && truth.versus_t_max <= 0; }

/// Closed triangle, closed range. Parallel: false. Coplanar and degenerate: no value where they touch, else false (a
/// ray that touches without crossing is a matter of convention). Invalid: no value.
constexpr std::optional<bool> hit(const Truth& truth) {
  switch (truth.hit_class) {
    case HitClass::interior:
    case HitClass::edge:
    case HitClass::vertex: return in_range(truth);
    case HitClass::exterior:
    case HitClass::parallel: return false;
    case HitClass::coplanar:
    case HitClass::degenerate: return truth.touches ? std::nullopt : std::optional(false);
    case HitClass::invalid: break;
  }
  return std::nullopt;
}

}  // namespace plumbline
