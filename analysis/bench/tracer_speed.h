// What a ray costs each tracer, through the tracers' interface: one triangle, as it is shot at in each of several ways.
// All tracers are given the same rays, which are binary32 numbers, and are timed in turns (interleaved.h), so that the
// ratio to the reference is of the same moments.
#pragma once
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "float_tracer/tracer.h"

namespace plumbline {

enum class Shooting : unsigned char {
  hits,    ///< 1024 rays in one call, all hit
  misses,  ///< all miss, most of them the triangle's edges narrowly enough to pass a box
  mixed,   ///< half of them hit, in no order that a processor could learn
  single,  ///< the mixed rays, a call for each
  bags,    ///< the mixed rays, each at a bag of its own: what it costs to prepare one
  memory,  ///< mixed rays, too many for any cache
};
inline constexpr std::array<std::string_view, 6> shooting_names = {"hits",   "misses", "mixed",
                                                                   "single", "bags",   "memory"};
constexpr std::string_view name(Shooting s) { return shooting_names[static_cast<unsigned>(s)]; }

struct SpeedPlan {
  std::vector<const Tracer*> tracers;  ///< the reference, moller_trumbore_f64, is timed beside them in any case
  std::size_t rounds = 11;
  double slice_seconds = 1e-3;  ///< of each tracer in each round
  std::size_t memory_rays = 400'000;
  std::uint64_t seed = 1;
};

/// Medians over the rounds.
struct Speed {
  double ns = 0;     ///< a ray; processor time of the thread, or wall-clock where the tracer runs in a child
  double ratio = 0;  ///< to the reference in the same round
};

/// By tracer, way.
using Speeds = std::vector<std::array<Speed, shooting_names.size()>>;

using SpeedProgress = std::function<void(Shooting)>;

/// When `stop` becomes true, throws std::runtime_error at the next way.
Speeds tracer_speeds(const SpeedPlan& plan, const std::atomic<bool>& stop, const SpeedProgress& progress = {});

}  // namespace plumbline
