#include "float_tracer/brlcad/bot_classic.h"

#include <cmath>

#include "float_tracer/brlcad/bot_tracer.h"

namespace plumbline {
namespace brlcad {
namespace {

// The edges belong to the triangle. The normal isn't of unit length, so what counts as parallel depends on the area. A
// NaN, where huge numbers overflow, passes every comparison.
std::optional<double> intersect(const Solid& solid, const Vector& origin, const Vector& direction) {
  const Face& face = solid.face;
  const double slope = dot(face.cross, direction), size = std::abs(slope);
  if (size < least_slope) return std::nullopt;
  const double least = -solid.margin, most = solid.margin + size;
  const Vector to_a = face.a - origin, x = cross(to_a, direction);
  const double along_ac = dot(face.ac, x), alpha = slope < 0 ? -along_ac : along_ac;
  if (alpha < least || alpha > most) return std::nullopt;
  const double along_ab = dot(face.ab, x), beta = slope > 0 ? -along_ab : along_ab;
  if (beta < least || beta > most) return std::nullopt;
  if (alpha + beta > most) return std::nullopt;
  return dot(to_a, face.cross) / slope;
}

constexpr std::string_view source = "BRL-CAD 7.22 to 7.40.2, librt; equal bit for bit to recordings of 7.24.2";

struct Classic {
  static TracerInfo info() {
    return {.name = "brlcad_bot_classic",
            .summary = "BRL-CAD's BoT up to 7.40: ray walk with the 0.0005 mm entry nudge, then the triangle test",
            .source = std::string(source),
            .contract = {.range = RangeRule::ray, .t_min = EndRule::unspecified}};
  }
  static std::optional<Segment> shoot(const Solid& solid, const Vector& origin, const Vector& direction) {
    return shoot_model(solid, origin, direction,
                       [](const Solid& s, const Entry& entry) { return intersect(s, entry.point, entry.direction); });
  }
};

struct ClassicKernel {
  static TracerInfo info() {
    return {.name = "brlcad_bot_classic_kernel",
            .summary = "the triangle test of brlcad_bot_classic alone, from the origin as given, on the whole line",
            .source = std::string(source),
            .contract = {.range = RangeRule::line, .t_min = EndRule::unspecified}};
  }
  static std::optional<Segment> shoot(const Solid& solid, const Vector& origin, const Vector& direction) {
    const std::optional<double> t = intersect(solid, origin, direction);
    if (!t) return std::nullopt;
    return segment_at(solid, direction, *t);
  }
};

}  // namespace
}  // namespace brlcad

std::unique_ptr<Tracer> brlcad_bot_classic() { return std::make_unique<brlcad::BotTracer<brlcad::Classic>>(); }

std::unique_ptr<Tracer> brlcad_bot_classic_kernel() {
  return std::make_unique<brlcad::BotTracer<brlcad::ClassicKernel>>();
}

}  // namespace plumbline
