#include "float_tracer/adapters/graphene.h"

#include <graphene.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "case/float_bits.h"
#include "float_tracer/adapters/nearest.h"

namespace plumbline {
namespace {

graphene_vec3_t to_graphene(const Vec3& v) {
  graphene_vec3_t r;
  graphene_vec3_init(&r, static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z));
  return r;
}

Vec3 from_graphene(const graphene_vec3_t& v) {
  return {graphene_vec3_get_x(&v), graphene_vec3_get_y(&v), graphene_vec3_get_z(&v)};
}

bool is_a_direction(const Vec3& v) { return v != Vec3{} && is_finite(v.x) && is_finite(v.y) && is_finite(v.z); }

struct Asked {
  graphene_ray_t ray;
  Ray effective;

  // No value for what it can't take.
  static std::optional<Asked> from(const Ray& given) {
    if (!(given.t_min >= 0)) return std::nullopt;
    Asked r;
    const graphene_vec3_t origin = to_graphene(given.origin), direction = to_graphene(given.direction);
    graphene_ray_init_from_vec3(&r.ray, &origin, &direction);
    graphene_vec3_t unit;
    graphene_ray_get_direction(&r.ray, &unit);
    r.effective = {.origin = given.origin, .direction = from_graphene(unit)};
    if (!is_a_direction(r.effective.direction)) return std::nullopt;
    const double length = std::hypot(given.direction.x, given.direction.y, given.direction.z);
    r.effective.t_min = given.t_min * length;
    r.effective.t_max = given.t_max * length;
    return r;
  }
};

class PreparedGraphene final : public PreparedBag {
 public:
  explicit PreparedGraphene(const Bag& bag) {
    for (const Triangle& t : bag.triangles) {
      const graphene_vec3_t a = to_graphene(t.a), b = to_graphene(t.b), c = to_graphene(t.c);
      graphene_triangle_init_from_vec3(&triangles_.emplace_back(), &a, &b, &c);
    }
  }

  Query asked(const Ray& ray) override {
    const auto asked = Asked::from(ray);
    return asked ? asked->effective : ray;
  }

 private:
  void answer(std::span<const Ray> rays, std::span<Answer> answers) override {
    std::ranges::transform(rays, answers.begin(), [this](const Ray& ray) { return answer(ray); });
  }

  Answer answer(const Ray& ray) const {
    const auto asked = Asked::from(ray);
    if (!asked) return {.outcome = Outcome::fault};
    return nearest(triangles_, [&](const graphene_triangle_t& t) -> Answer {
      float distance = 0;
      const auto kind = graphene_ray_intersect_triangle(&asked->ray, &t, &distance);
      if (kind == GRAPHENE_RAY_INTERSECTION_KIND_NONE) return {};
      if (!(distance >= asked->effective.t_min && distance <= asked->effective.t_max)) return {};
      return {.outcome = Outcome::hit, .has_t = true, .t = distance};
    });
  }

  std::vector<graphene_triangle_t> triangles_;
};

std::string version() {
  return std::to_string(GRAPHENE_MAJOR_VERSION) + '.' + std::to_string(GRAPHENE_MINOR_VERSION) + '.' +
         std::to_string(GRAPHENE_MICRO_VERSION);
}

class GrapheneTracer final : public Tracer {
 public:
  GrapheneTracer()
      : Tracer({.name = "graphene_f32",
                .summary = "graphene: GTEngine's signed barycentrics, with a normalized direction",
                .source = "graphene_ray_intersect_triangle",
                .package = "libgraphene-1.0-dev " + version(),
                .contract = {.precision = Precision::binary32,
                             .edges = EdgeRule::unspecified,
                             .t_min = EndRule::unspecified,
                             .t_max = EndRule::unspecified,
                             .degenerate = TouchRule::unspecified},
                .own_queries = true}) {}

  std::unique_ptr<PreparedBag> prepare(const Bag& bag) const override {
    return std::make_unique<PreparedGraphene>(bag);
  }
};

}  // namespace

std::vector<std::unique_ptr<Tracer>> graphene_tracers() {
  std::vector<std::unique_ptr<Tracer>> list;
  list.push_back(std::make_unique<GrapheneTracer>());
  return list;
}

}  // namespace plumbline
