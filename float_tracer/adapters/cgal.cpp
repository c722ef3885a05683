#include "float_tracer/adapters/cgal.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Intersections_3/Ray_3_Triangle_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/version_macros.h>

#include <optional>
#include <type_traits>

#include "case/float_bits.h"

namespace plumbline {
namespace {

bool all_finite(const Vec3& v) { return is_finite(v.x) && is_finite(v.y) && is_finite(v.z); }
bool all_finite(const Triangle& t) { return all_finite(t.a) && all_finite(t.b) && all_finite(t.c); }

/// Whether a Ray_3 holds origin and direction as they are.
template <class Kernel>
constexpr bool holds_rays = std::is_same_v<Kernel, CGAL::Exact_predicates_exact_constructions_kernel>;

// What a Ray_3 of that origin and direction is. No value where it would be no ray.
template <class Kernel>
std::optional<Query> held(const Ray& ray) {
  const auto& [o, d, t_min, t_max] = ray;
  if (!all_finite(o) || !all_finite(d)) return std::nullopt;
  if constexpr (holds_rays<Kernel>) {
    return is_zero(d.x) && is_zero(d.y) && is_zero(d.z) ? std::nullopt : std::optional<Query>(ray);
  } else {
    const Vec3 second{o.x + d.x, o.y + d.y, o.z + d.z};
    if (!all_finite(second) || second == o) return std::nullopt;
    return query_through(o, second, t_min, t_max);
  }
}

template <class Kernel>
class PreparedTriangles final : public PreparedBag {
 public:
  explicit PreparedTriangles(const Bag& bag) {
    triangles_.reserve(bag.triangles.size());
    for (std::uint32_t i = 0; i < bag.triangles.size(); ++i) {
      const Triangle& t = bag.triangles[i];
      finite_ = finite_ && all_finite(t);
      if (!finite_) return;
      typename Kernel::Triangle_3 triangle(point(t.a), point(t.b), point(t.c));
      if (!triangle.is_degenerate()) triangles_.push_back({i, std::move(triangle)});
    }
  }

  Query asked(const Ray& ray) override { return held<Kernel>(ray).value_or(ray); }

 private:
  struct Indexed {
    std::uint32_t index;
    typename Kernel::Triangle_3 triangle;
  };

  static typename Kernel::Point_3 point(const Vec3& v) { return {v.x, v.y, v.z}; }

  void answer(std::span<const Ray> rays, std::span<Answer> answers) override {
    for (std::size_t i = 0; i < rays.size(); ++i) answers[i] = answer(rays[i]);
  }

  Answer answer(const Ray& ray) const {
    if (!finite_ || !held<Kernel>(ray)) return {.outcome = Outcome::fault};
    const Vec3& d = ray.direction;
    const typename Kernel::Ray_3 shot(point(ray.origin), typename Kernel::Vector_3(d.x, d.y, d.z));
    for (const auto& [index, triangle] : triangles_)
      if (CGAL::do_intersect(shot, triangle)) return {.outcome = Outcome::hit, .triangle = index};
    return {};
  }

  std::vector<Indexed> triangles_;  // those with area
  bool finite_ = true;              // all of them
};

template <class Kernel>
class CgalTracer final : public Tracer {
 public:
  CgalTracer(std::string name, std::string summary, std::string kernel)
      : Tracer({.name = std::move(name),
                .summary = std::move(summary),
                .source = "CGAL::do_intersect(Ray_3, Triangle_3) of " + kernel,
                .package = "libcgal-dev " CGAL_VERSION_STR,
                .contract = {.range = RangeRule::ray,
                             .coplanar = TouchRule::hit,
                             .degenerate = TouchRule::unspecified},
                .own_queries = !holds_rays<Kernel>}) {}

  std::unique_ptr<PreparedBag> prepare(const Bag& bag) const override {
    return std::make_unique<PreparedTriangles<Kernel>>(bag);
  }
};

}  // namespace

std::vector<std::unique_ptr<Tracer>> cgal_tracers() {
  std::vector<std::unique_ptr<Tracer>> list;
  list.push_back(std::make_unique<CgalTracer<CGAL::Simple_cartesian<double>>>(
      "cgal_cartesian_f64", "CGAL with plain double arithmetic", "Simple_cartesian<double>"));
  list.push_back(std::make_unique<CgalTracer<CGAL::Exact_predicates_inexact_constructions_kernel>>(
      "cgal_epick", "CGAL: exact signs, the ray's second point rounded",
      "Exact_predicates_inexact_constructions_kernel"));
  list.push_back(std::make_unique<CgalTracer<CGAL::Exact_predicates_exact_constructions_kernel>>(
      "cgal_epeck", "CGAL: exact numbers throughout", "Exact_predicates_exact_constructions_kernel"));
  return list;
}

}  // namespace plumbline
