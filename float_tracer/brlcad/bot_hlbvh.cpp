#include "float_tracer/brlcad/bot_hlbvh.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "float_tracer/brlcad/bot_tracer.h"

namespace plumbline {
namespace brlcad {
namespace {

// A ray along an axis in the upper face of the box leaves it at 0 on the other axes, before it has entered on its own:
// culled. In the lower face it enters at 0 and stays.
bool meets(const Box& box, const Entry& entry) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Vector origin = entry.box_near < 0 ? entry.point + entry.box_near * entry.direction : entry.point;
  double near = -infinity, far = infinity;
  for (int i = 0; i < 3; ++i) {
    const double inverse = 1 / (entry.direction[i] + std::copysign(1e-73, entry.direction[i]));
    const double to_low = (box.low[i] - origin[i]) * inverse, to_high = (box.high[i] - origin[i]) * inverse;
    near = std::max(near, std::min(to_low, to_high));
    far = std::min(far, std::max(to_low, to_high));
  }
  return !(far < -1e-77 || near > far);
}

template <class Why>
std::optional<double> intersect(const Face& face, const Vector& origin, const Vector& direction, Why why) {
  const Vector normal = std::sqrt(dot(face.cross, face.cross)) * face.unit_normal;  // rounded again: not face.cross
  const double slope = dot(normal, direction), size = std::abs(slope);
  if (size < least_slope) return missed_by(Rejection::parallel, why);
  const Vector to_a = face.a - origin, x = cross(to_a, direction);
  const double along_ab = dot(face.ab, x), beta = slope > 0 ? -along_ab : along_ab;
  const double along_ac = dot(face.ac, x), gamma = slope < 0 ? -along_ac : along_ac;
  if (!(beta >= 0 && gamma >= 0 && beta + gamma <= size))
    return missed_by([=] { return !(beta >= 0) ? Rejection::ab : !(gamma >= 0) ? Rejection::ca : Rejection::bc; },
                     why);
  return dot(to_a, normal) / slope;
}

struct Hlbvh {
  static TracerInfo info() {
    return {.name = "brlcad_bot_hlbvh",
            .summary = "BRL-CAD's BoT since 7.42: the same ray walk, box test without a margin, another triangle test",
            .source = "BRL-CAD 7.42 to 7.44, librt, with the ray walk of 7.24.2",
            .contract = {.range = RangeRule::ray, .t_min = EndRule::unspecified},
            .constants = {distance_tolerance, least_slope}};
  }
  template <class Why>
  static std::optional<Segment> shoot(const Solid& solid, const Vector& origin, const Vector& direction, Why why) {
    return shoot_model(solid, origin, direction, why, [why](const Solid& s, const Entry& entry) {
      if (!meets(s.face_box, entry)) return std::optional<double>(missed_by(Rejection::box, why));
      return intersect(s.face, entry.point, entry.direction, why);
    });
  }
};

}  // namespace
}  // namespace brlcad

std::unique_ptr<Tracer> brlcad_bot_hlbvh() { return std::make_unique<brlcad::BotTracer<brlcad::Hlbvh>>(); }

}  // namespace plumbline
