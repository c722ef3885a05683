#include "float_tracer/brlcad/segment.h"

#include <cmath>

namespace plumbline::brlcad {

std::optional<Segment> segment_at(const Solid& solid, const Vector& direction, double t) {
  switch (solid.mode) {
    case BagMode::surface:
      return Segment{t, t};
    case BagMode::solid:
      if (solid.orientation != Orientation::none) {
        const double slope = dot(solid.face.unit_normal, direction);
        if (slope < 0 || slope > 0) return std::nullopt;
      }
      return Segment{t, t};
    case BagMode::plate:
      break;
  }
  const double way =
      solid.cosine ? std::abs(solid.thickness / dot(solid.face.unit_normal, direction)) : solid.thickness;
  const double in = solid.position == PlatePosition::centred ? t - way * 0.5 : t;
  return Segment{in, in + way};
}

std::optional<Segment> weave(Segment s) {
  if (std::isnan(s.in) || std::isnan(s.out)) return std::nullopt;
  if (std::abs(s.in) < distance_tolerance) s.in = 0;
  if (s.in > s.out) return std::nullopt;
  if (std::abs(s.out - s.in) < distance_tolerance) s.out = s.in;
  if (s.out < distance_tolerance) return std::nullopt;
  return s;
}

}  // namespace plumbline::brlcad
