#include "float_tracer/adapters/glm.h"

#define GLM_ENABLE_EXPERIMENTAL  // its gtx headers refuse to be included without
#include <glm/gtx/intersect.hpp>
#include <string>
#include <type_traits>

#include "float_tracer/adapters/nearest.h"

namespace plumbline {
namespace {

template <class Real>
using GlmVec = glm::vec<3, Real, glm::defaultp>;

template <class Real>
GlmVec<Real> to_glm(const Vec3& v) {
  return {static_cast<Real>(v.x), static_cast<Real>(v.y), static_cast<Real>(v.z)};
}

template <class Real>
class PreparedGlm final : public PreparedBag {
 public:
  explicit PreparedGlm(const Bag& bag) {
    for (const Triangle& t : bag.triangles)
      triangles_.push_back({to_glm<Real>(t.a), to_glm<Real>(t.b), to_glm<Real>(t.c)});
  }

 private:
  struct Corners {
    GlmVec<Real> a, b, c;
  };

  void answer(std::span<const Ray> rays, std::span<Answer> answers) override {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const GlmVec<Real> origin = to_glm<Real>(rays[i].origin), direction = to_glm<Real>(rays[i].direction);
      answers[i] = nearest(triangles_, [&](const Corners& t) { return answer(origin, direction, rays[i], t); });
    }
  }

  static Answer answer(const GlmVec<Real>& origin, const GlmVec<Real>& direction, const Ray& ray, const Corners& t) {
    glm::vec<2, Real, glm::defaultp> uv{};
    Real distance{};
    if (!glm::intersectRayTriangle(origin, direction, t.a, t.b, t.c, uv, distance)) return {};
    if (!(distance >= ray.t_min && distance <= ray.t_max)) return {};
    return {.outcome = Outcome::hit, .has_t = true, .has_uv = true, .t = distance, .u = uv.x, .v = uv.y};
  }

  std::vector<Corners> triangles_;
};

std::string version() {
  return std::to_string(GLM_VERSION_MAJOR) + '.' + std::to_string(GLM_VERSION_MINOR) + '.' +
         std::to_string(GLM_VERSION_PATCH) + '.' + std::to_string(GLM_VERSION_REVISION);
}

template <class Real>
class GlmTracer final : public Tracer {
 public:
  static constexpr bool single = std::is_same_v<Real, float>;

  GlmTracer()
      : Tracer({.name = single ? "glm_f32" : "glm_f64",
                .summary = std::string("GLM in ") + (single ? "float" : "double") +
                           "; the distance is tested by the caller, as it has to be",
                .source = "glm::intersectRayTriangle",
                .package = "libglm-dev " + version(),
                .contract = {.precision = single ? Precision::binary32 : Precision::binary64,
                             .t_min = EndRule::unspecified,
                             .t_max = EndRule::unspecified}}) {}

  std::unique_ptr<PreparedBag> prepare(const Bag& bag) const override {
    return std::make_unique<PreparedGlm<Real>>(bag);
  }
};

}  // namespace

std::vector<std::unique_ptr<Tracer>> glm_tracers() {
  std::vector<std::unique_ptr<Tracer>> list;
  list.push_back(std::make_unique<GlmTracer<float>>());
  list.push_back(std::make_unique<GlmTracer<double>>());
  return list;
}

}  // namespace plumbline
