#include "float_tracer/adapters/cglm.h"

#include <cglm/ray.h>
#include <cglm/version.h>

#include <algorithm>
#include <string>

#include "float_tracer/adapters/nearest.h"

namespace plumbline {
namespace {

struct Corners {
  vec3 a, b, c;
};

void put(const Vec3& v, vec3 to) {
  to[0] = static_cast<float>(v.x), to[1] = static_cast<float>(v.y), to[2] = static_cast<float>(v.z);
}

class PreparedCglm final : public PreparedBag {
 public:
  explicit PreparedCglm(const Bag& bag) : triangles_(bag.triangles.size()) {
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      put(bag.triangles[i].a, triangles_[i].a);
      put(bag.triangles[i].b, triangles_[i].b);
      put(bag.triangles[i].c, triangles_[i].c);
    }
  }

 private:
  void answer(std::span<const Ray> rays, std::span<Answer> answers) override {
    std::ranges::transform(rays, answers.begin(), [this](const Ray& ray) { return answer(ray); });
  }

  Answer answer(const Ray& ray) {
    if (!(ray.t_min >= 0)) return {.outcome = Outcome::fault};
    vec3 origin, direction;
    put(ray.origin, origin);
    put(ray.direction, direction);
    return nearest(triangles_, [&](Corners& t) -> Answer {
      float distance = 0;
      if (!glm_ray_triangle(origin, direction, t.a, t.b, t.c, &distance)) return {};
      if (!(distance >= ray.t_min && distance <= ray.t_max)) return {};
      return {.outcome = Outcome::hit, .has_t = true, .t = distance};
    });
  }

  std::vector<Corners> triangles_;  // it takes them by pointers to non-const, and doesn't write
};

std::string version() {
  return std::to_string(CGLM_VERSION_MAJOR) + '.' + std::to_string(CGLM_VERSION_MINOR) + '.' +
         std::to_string(CGLM_VERSION_PATCH);
}

class CglmTracer final : public Tracer {
 public:
  CglmTracer()
      : Tracer({.name = "cglm_f32",
                .summary = "cglm: Moller and Trumbore's test with an absolute epsilon on det and t",
                .source = "glm_ray_triangle",
                .package = "libcglm-dev " + version(),
                .contract = {
                    .precision = Precision::binary32, .t_min = EndRule::unspecified, .t_max = EndRule::unspecified}}) {}

  std::unique_ptr<PreparedBag> prepare(const Bag& bag) const override { return std::make_unique<PreparedCglm>(bag); }
};

}  // namespace

std::vector<std::unique_ptr<Tracer>> cglm_tracers() {
  std::vector<std::unique_ptr<Tracer>> list;
  list.push_back(std::make_unique<CglmTracer>());
  return list;
}

}  // namespace plumbline
