#include "analysis/bench/bench_interface.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "analysis/text_table.h"
#include "analysis/tracers.h"
#include "float_tracer/isolated.h"
#include "float_tracer/kernel_tracer.h"
#include "float_tracer/moller_trumbore.h"

namespace plumbline {
namespace {

Vec3 minus(const Vec3& p, const Vec3& q) { return {p.x - q.x, p.y - q.y, p.z - q.z}; }
Vec3 cross(const Vec3& p, const Vec3& q) {
  return {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
}
double dot(const Vec3& p, const Vec3& q) { return p.x * q.x + p.y * q.y + p.z * q.z; }

Answer answer_by_hand(const Vec3& a, const Vec3& ab, const Vec3& ac, const Ray& ray) {
  const Vec3 p = cross(ray.direction, ac);
  const double det = dot(ab, p);
  if (det == 0) return {};
  const double inverse = 1 / det;
  const Vec3 from_a = minus(ray.origin, a);
  const double u = dot(from_a, p) * inverse;
  if (!(u >= 0 && u <= 1)) return {};
  const Vec3 q = cross(from_a, ab);
  const double v = dot(ray.direction, q) * inverse;
  if (!(v >= 0 && u + v <= 1)) return {};
  const double t = dot(ac, q) * inverse;
  if (!(ray.t_min <= t && t <= ray.t_max)) return {};
  return {.outcome = Outcome::hit, .has_t = true, .has_uv = true, .t = t, .u = u, .v = v};
}

void trace_by_hand(const Triangle& triangle, std::span<const Ray> rays, std::span<Answer> answers) {
  const Vec3 ab = minus(triangle.b, triangle.a), ac = minus(triangle.c, triangle.a);
  for (std::size_t i = 0; i < rays.size(); ++i) answers[i] = answer_by_hand(triangle.a, ab, ac, rays[i]);
}

// Half of them hit, in no order that a processor could learn.
std::vector<Ray> rays_at(std::size_t n) {
  std::vector<Ray> rays;
  std::uint64_t state = 1;
  const auto random = [&state] {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state >> 11) * 0x1p-53;
  };
  while (rays.size() < n) {
    const Vec3 target{random(), random(), random() * 0.25}, from{random(), random(), 4};
    rays.push_back({.origin = from, .direction = minus(target, from)});
  }
  return rays;
}

double ns_of(const std::function<void()>& pass) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  pass();
  return std::chrono::duration<double, std::nano>(Clock::now() - begin).count();
}

}  // namespace

std::string bench_interface(const InterfacePlan& plan) {
  const Bag bag{.triangles = {{{0, 0, 0}, {1, 0, 0.125}, {0, 1, 0.25}}}};
  const Tracer& tracer = find_tracer("moller_trumbore_f64");
  const auto in_child = isolated(std::make_unique<KernelTracer<MollerTrumbore<double>>>());
  const auto prepared = tracer.prepare(bag), prepared_in_child = in_child->prepare(bag);

  TextTable table{.columns = {{"rays", true}, {"way"}, {"ns/ray", true}, {"ratio", true}, {"us/batch", true}},
                  .rows = {}};
  for (const std::size_t n : {std::size_t{1}, std::size_t{64}, std::size_t{1024}, std::size_t{65536}}) {
    const auto rays = rays_at(n);
    std::vector<Answer> answers(n);
    struct Way {
      std::string name;
      std::function<void()> pass;
      double least = std::numeric_limits<double>::infinity();
    };
    std::vector<Way> ways = {
        {"by hand", [&] { trace_by_hand(bag.triangles[0], rays, answers); }},
        {"trace", [&] { prepared->trace(rays, answers); }},
        {"prepare, trace", [&] { tracer.prepare(bag)->trace(rays, answers); }},
        {"child: trace", [&] { prepared_in_child->trace(rays, answers); }},
        {"child: prepare, trace", [&] { in_child->prepare(bag)->trace(rays, answers); }},
    };
    for (std::size_t round = 0; round < plan.rounds; ++round)
      for (Way& way : ways) way.least = std::min(way.least, ns_of(way.pass));
    for (const Way& way : ways)
      table.rows.push_back({fmt::format("{}", n), way.name, fmt::format("{:.2f}", way.least / static_cast<double>(n)),
                            fmt::format("{:.2f}", way.least / ways[0].least),
                            fmt::format("{:.1f}", way.least / 1e3)});
  }
  return to_terminal(table);
}

}  // namespace plumbline
