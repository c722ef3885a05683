// Rays that leave a hit: whether they meet their own triangle again, by the tracer and in truth, and what it takes
// that they don't.
//
// A secondary ray starts where the first one hit. That point is rounded, so that it may lie behind the plane, seen
// from where the ray goes: then the ray does meet the triangle again, and any tracer has to say so. Where it lies
// before the plane and the tracer still says hit, the tracer is at fault. The exact truth of the leaving ray keeps
// the two apart.
//
// Units. A shift of k ulps moves the origin along the exact normal, to the side where the ray goes, by k units in the
// last place, at the tracer's precision, of the hit point's largest coordinate (oracle/offset.h: in the coordinate
// that moves most). A t_min of k ulps is k units in the last place of the first ray's t.
#pragma once
#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "float_tracer/tracer.h"

namespace plumbline {

/// Which point the ray leaves from.
enum class HitPoint : unsigned char {
  t,        ///< origin + t * direction, with the tracer's t
  uv,       ///< a + u * (b - a) + v * (c - a), with the tracer's u and v
  rounded,  ///< the exact point, each coordinate rounded once: as good as the precision has it
};
inline constexpr std::array<std::string_view, 3> hit_point_names = {"t", "uv", "rounded"};
constexpr std::string_view name(HitPoint p) { return hit_point_names[static_cast<unsigned>(p)]; }

/// What keeps a ray from its own triangle.
enum class Remedy : unsigned char { origin, t_min };
inline constexpr std::array<std::string_view, 2> remedy_names = {"origin", "t_min"};
constexpr std::string_view name(Remedy r) { return remedy_names[static_cast<unsigned>(r)]; }

/// Where the leaving ray, as it is asked, meets the closed triangle.
enum class Return : unsigned char {
  none,    ///< nowhere: a hit is the tracer's fault
  start,   ///< at its start, or along it, in the plane: hit or not is a matter of convention
  beyond,  ///< after its start, so the start is behind the plane: a hit is the point's fault
};

/// The least k of 0, 1, 2, ... from which on there is no hit: none at any greater power of two up to the last that is
/// tried, and between two powers by bisection. Infinite where the last is still hit; NaN where the remedy isn't
/// asked.
struct Need {
  double tracer = 0;
  double exact = 0;  ///< for a tracer that does just what the contract asks for
};

struct Departure {
  HitPoint point = HitPoint::t;
  Ray ray;  ///< as it leaves without a remedy, with the range [0, inf]
  Return truth = Return::none;
  bool hit = false;  ///< what the tracer says
  std::array<Need, remedy_names.size()> need{};  ///< by Remedy; t_min of tracers that read it
};

struct Departures {
  Outcome arrival = Outcome::miss;  ///< the tracer's, of the first ray
  bool finite = true;               ///< whether the t, u, v it gives are; what isn't is not left
  std::vector<Departure> list;      ///< by point, but for those that the tracer doesn't tell; by direction
};

/// 2 to this power is the last k that is tried: a quarter of the hit point's largest coordinate, about.
constexpr int last_power(Precision precision) { return precision == Precision::binary32 ? 21 : 50; }

/// Of a ray with the range [0, inf] that crosses the triangle, and directions to leave it in, all of the tracer's
/// precision. Of a tracer that searches the whole line it counts as a hit where t > 0, as its callers do.
Departures depart(const Tracer& tracer, PreparedBag& bag, const Triangle& triangle, const Ray& ray,
                  std::span<const Vec3> directions);

}  // namespace plumbline
