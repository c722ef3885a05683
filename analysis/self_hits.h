// Self-intersection: how often rays that leave a hit meet their own triangle again, whose fault that is, and by how
// many ulps the origin has to move, or t_min to grow, that they don't; of each tracer on families of hits.
//
// Every first ray crosses its triangle in truth. From each point of its hit (departure.h) four rays leave, two to
// each side of the plane by the exact sign of direction . normal: a pair of opposite ones in a direction uniform over
// the sphere, and a grazing pair. A direction's largest component has the exponent of the first ray's. All numbers
// are of the tracer's precision. Same plan, same result.
#pragma once
#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "analysis/departure.h"
#include "analysis/spread.h"
#include "case/dials.h"

namespace plumbline {

/// Hits of a dialled family at one setting: those of its shots whose ray truly crosses the triangle.
struct SelfHitFamily {
  std::string_view name, meaning;
  Dial dial = Dial::tiny;
  int setting = 0;
};
inline constexpr std::array<SelfHitFamily, 6> self_hit_families = {
    {{"near", "triangles of size 1 near 0", Dial::tiny, 0},
     {"small", "the same scaled by 2^-10", Dial::tiny, 10},
     {"far10", "size 1, 2^10 away from 0", Dial::far, 10},
     {"far20", "size 1, 2^20 away from 0", Dial::far, 20},
     {"sliver", "an altitude 2^-10 of the longest edge", Dial::cap, 10},
     {"grazing", "first rays that start 2^-10 above the plane, a length away", Dial::grazing, 10}}};

/// How a ray leaves the plane.
enum class Leaving : unsigned char {
  steep,    ///< uniform over the hemisphere
  grazing,  ///< along the plane, and away from it by about 2^-10 of its way
};
inline constexpr std::array<std::string_view, 2> leaving_names = {"steep", "grazing"};
constexpr std::string_view name(Leaving l) { return leaving_names[static_cast<unsigned>(l)]; }

struct SelfHitPlan {
  std::vector<const Tracer*> tracers;
  std::vector<SelfHitFamily> families;
  std::uint64_t rays = 500;  ///< first rays of each family
  std::uint64_t seed = 1;
  unsigned jobs = 1;  ///< threads; the result doesn't depend on them
};

/// Ulps, of all leaving rays; 0 for those that need nothing.
struct NeedSpread {
  Spread tracer, exact;
  Spread excess;              ///< tracer - exact: what the tracer, not the point, needs
  std::uint64_t nothing = 0;  ///< rays that need nothing: who moves all of them moves these too far
  std::uint64_t never = 0;    ///< rays that nothing tried keeps from the triangle
};

/// One kind of leaving ray from one kind of point.
struct SelfHitCell {
  std::uint64_t rays = 0;
  std::uint64_t beyond = 0, start = 0;            ///< by truth, see Return; the rest meets nothing
  std::uint64_t beyond_hits = 0, start_hits = 0;  ///< of these, said to hit
  std::uint64_t false_hits = 0;                   ///< of the rest
  std::array<NeedSpread, remedy_names.size()> need;  ///< by Remedy
};

/// One tracer on one family.
struct SelfHitScore {
  std::uint64_t hits = 0, misses = 0, faults = 0;  ///< of first rays
  std::uint64_t not_finite = 0;                    ///< hits with a point that isn't, which no ray leaves
  std::array<std::array<SelfHitCell, leaving_names.size()>, hit_point_names.size()> cells;  ///< by point, leaving
};

struct SelfHitResult {
  SelfHitPlan plan;
  std::vector<std::vector<SelfHitScore>> scores;  ///< by tracer, family; without first rays where it was stopped
  std::vector<Conduct> conduct;                   ///< by tracer
  std::uint64_t done = 0;                         ///< pairs of tracer and family
};

/// Of one first ray and its index among the shots of the family: where the rays of its hit go.
struct LeavingRay {
  Vec3 direction;
  Leaving kind = Leaving::steep;
};
std::vector<LeavingRay> leaving_rays(const Shot& shot, Precision precision, std::uint64_t seed, std::uint64_t index);

using SelfHitProgress = std::function<void(std::uint64_t done, std::uint64_t planned)>;

/// Throws InputError where there is nothing to do. When `stop` becomes true, what was finished is the result.
SelfHitResult measure_self_hits(const SelfHitPlan& plan, const std::atomic<bool>& stop = false,
                                const SelfHitProgress& progress = {});

}  // namespace plumbline
