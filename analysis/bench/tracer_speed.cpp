#include "analysis/bench/tracer_speed.h"

#include <memory>
#include <span>
#include <stdexcept>

#include "analysis/bench/interleaved.h"
#include "analysis/tracers.h"
#include "case/precision.h"
#include "case/random.h"
#include "oracle/classify.h"

namespace plumbline {
namespace {

const Triangle target{{0, 0, 0}, {1, 0, 0.125}, {0.25, 1, 0.25}};

enum class Meets : unsigned char { all, none, half };

// Towards the triangle's bounding box; which of them hit is the oracle's to say.
std::vector<Ray> draw_rays(Meets meets, std::size_t count, std::uint64_t seed) {
  Random random(seed, static_cast<std::uint64_t>(meets));
  const auto between = [&random](double low, double high) { return low + (high - low) * 0.5 * (1 + random.unit()); };
  std::vector<Ray> rays;
  std::size_t hits = 0;
  while (rays.size() < count) {
    const double px = between(0, 1), py = between(0, 1), pz = between(0, 0.25);
    const double ox = between(-1, 2), oy = between(-1, 2), oz = between(1, 4);
    const Ray ray =
        at_precision(Ray{.origin = {ox, oy, oz}, .direction = {px - ox, py - oy, pz - oz}}, Precision::binary32);
    const bool hit = crosses(classify(target, ray));
    if ((meets == Meets::all && !hit) || (meets == Meets::none && hit)) continue;
    const bool enough = meets == Meets::half && (hit ? 2 * hits >= count : 2 * (rays.size() - hits) >= count);
    if (enough) continue;
    hits += hit;
    rays.push_back(ray);
  }
  return rays;
}

std::vector<Ray> rays_of(Shooting way, const SpeedPlan& plan) {
  constexpr std::size_t in_cache = 1024;
  switch (way) {
    case Shooting::hits:
      return draw_rays(Meets::all, in_cache, plan.seed);
    case Shooting::misses:
      return draw_rays(Meets::none, in_cache, plan.seed);
    case Shooting::memory:
      return draw_rays(Meets::half, plan.memory_rays, plan.seed);
    default:
      return draw_rays(Meets::half, in_cache, plan.seed);
  }
}

void shoot(Shooting way, const Tracer& tracer, PreparedBag& prepared, const Bag& bag, std::span<const Ray> rays,
           std::span<Answer> answers) {
  switch (way) {
    case Shooting::single:
      for (std::size_t i = 0; i < rays.size(); ++i) prepared.trace(rays.subspan(i, 1), answers.subspan(i, 1));
      break;
    case Shooting::bags:
      for (std::size_t i = 0; i < rays.size(); ++i)
        tracer.prepare(bag)->trace(rays.subspan(i, 1), answers.subspan(i, 1));
      break;
    default:
      prepared.trace(rays, answers);
  }
}

}  // namespace

Speeds tracer_speeds(const SpeedPlan& plan, const std::atomic<bool>& stop, const SpeedProgress& progress) {
  Bag bag;
  bag.triangles = {target};
  std::vector<const Tracer*> tracers = plan.tracers;
  tracers.push_back(&find_tracer("moller_trumbore_f64"));
  std::vector<std::unique_ptr<PreparedBag>> prepared;
  for (const Tracer* tracer : tracers) prepared.push_back(tracer->prepare(bag));

  Speeds speeds(plan.tracers.size());
  for (std::size_t w = 0; w < shooting_names.size(); ++w) {
    const auto way = static_cast<Shooting>(w);
    if (progress) progress(way);
    if (stop) throw std::runtime_error("interrupted: nothing was written; run it again, --quick is faster");
    const std::vector<Ray> rays = rays_of(way, plan);
    std::vector<Answer> answers(rays.size());
    std::vector<Timed> methods;
    for (std::size_t i = 0; i < tracers.size(); ++i)
      methods.push_back({.pass = [&, i] { shoot(way, *tracers[i], *prepared[i], bag, rays, answers); },
                         .cases = rays.size(),
                         .elsewhere = tracers[i]->info().isolation == Isolation::process});
    const auto ns = interleaved_ns(methods, plan.rounds, plan.slice_seconds);
    for (std::size_t i = 0; i < plan.tracers.size(); ++i) {
      std::vector<double> ratios;
      for (std::size_t round = 0; round < plan.rounds; ++round) ratios.push_back(ns[i][round] / ns.back()[round]);
      speeds[i][w] = {.ns = median(ns[i]), .ratio = median(ratios)};
    }
  }
  return speeds;
}

}  // namespace plumbline
