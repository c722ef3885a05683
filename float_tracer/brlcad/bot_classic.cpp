#include "float_tracer/brlcad/bot_classic.h"

#include <cmath>

#include "float_tracer/brlcad/bot_tracer.h"

namespace plumbline {
namespace brlcad {
namespace {

// The edges belong to the triangle. The normal isn't of unit length, so what counts as parallel depends on the area. A
// NaN, where huge numbers overflow, passes every comparison.
template <class Why>
std::optional<double> intersect(const Solid& solid, const Vector& origin, const Vector& direction, Why why) {
  const Face& face = solid.face;
  const double slope = dot(face.cross, direction), size = std::abs(slope);
  if (size < least_slope) return missed_by(Rejection::parallel, why);
  const double least = -solid.margin, most = solid.margin + size;
  const Vector to_a = face.a - origin, x = cross(to_a, direction);
  const double along_ac = dot(face.ac, x), alpha = slope < 0 ? -along_ac : along_ac;
  if (alpha < least || alpha > most)
    return missed_by([=] { return alpha < least ? Rejection::ca : Rejection::bc; }, why);
  const double along_ab = dot(face.ab, x), beta = slope > 0 ? -along_ab : along_ab;
  if (beta < least || beta > most)
    return missed_by([=] { return beta < least ? Rejection::ab : Rejection::bc; }, why);
  if (alpha + beta > most) return missed_by(Rejection::bc, why);
  return dot(to_a, face.cross) / slope;
}

constexpr std::string_view source = "BRL-CAD 7.22 to 7.40.2, librt; equal bit for bit to recordings of 7.24.2";

struct Classic {
  static TracerInfo info() {
    return {.name = "brlcad_bot_classic",
            .summary = "BRL-CAD's BoT up to 7.40: ray walk with the 0.0005 mm entry nudge, then the triangle test",
            .source = std::string(source),
            .contract = {.range = RangeRule::ray, .t_min = EndRule::unspecified},
            .constants = {distance_tolerance, least_slope}};
  }
  template <class Why>
  static std::optional<Segment> shoot(const Solid& solid, const Vector& origin, const Vector& direction, Why why) {
    return shoot_model(solid, origin, direction, why, [why](const Solid& s, const Entry& entry) {
      return intersect(s, entry.point, entry.direction, why);
    });
  }
};

struct ClassicKernel {
  static TracerInfo info() {
    return {.name = "brlcad_bot_classic_kernel",
            .summary = "the triangle test of brlcad_bot_classic alone, from the origin as given, on the whole line",
            .source = std::string(source),
            .contract = {.range = RangeRule::line, .t_min = EndRule::unspecified},
            .constants = {distance_tolerance, least_slope}};
  }
  template <class Why>
  static std::optional<Segment> shoot(const Solid& solid, const Vector& origin, const Vector& direction, Why why) {
    const std::optional<double> t = intersect(solid, origin, direction, why);
    if (!t) return std::nullopt;
    const std::optional<Segment> segment = segment_at(solid, direction, *t);
    if (!segment) missed_by(Rejection::segment, why);
    return segment;
  }
};

}  // namespace
}  // namespace brlcad

std::unique_ptr<Tracer> brlcad_bot_classic() { return std::make_unique<brlcad::BotTracer<brlcad::Classic>>(); }

std::unique_ptr<Tracer> brlcad_bot_classic_kernel() {
  return std::make_unique<brlcad::BotTracer<brlcad::ClassicKernel>>();
}

}  // namespace plumbline
