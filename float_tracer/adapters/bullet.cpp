#include "float_tracer/adapters/bullet.h"

#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

#include <array>
#include <string>

#include "float_tracer/adapters/segment.h"

namespace plumbline {
namespace {

static_assert(sizeof(btScalar) == sizeof(float), "Debian's libBulletCollision is the single precision one");

using Corners = std::array<btVector3, 3>;

btVector3 to_bullet(const Vec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

// Returning the fraction narrows the search to what is nearer.
class Nearest final : public btTriangleRaycastCallback {
 public:
  using btTriangleRaycastCallback::btTriangleRaycastCallback;

  btScalar reportHit(const btVector3&, btScalar fraction, int, int index) override {
    answer = {.outcome = Outcome::hit, .has_t = true, .triangle = static_cast<std::uint32_t>(index), .t = fraction};
    return fraction;
  }

  Answer answer;
};

class PreparedBullet final : public PreparedBag {
 public:
  explicit PreparedBullet(const Bag& bag) : largest_(largest_coordinate(bag)) {
    for (const Triangle& t : bag.triangles) triangles_.push_back({to_bullet(t.a), to_bullet(t.b), to_bullet(t.c)});
  }

  Query asked(const Ray& ray) override {
    const auto ends = segment(ray);
    return ends ? ends->query : ray;
  }

 private:
  std::optional<Segment> segment(const Ray& ray) const { return segment_of(ray, largest_, Precision::binary32); }

  void answer(std::span<const Ray> rays, std::span<Answer> answers) override {
    for (std::size_t i = 0; i < rays.size(); ++i) answers[i] = answer(rays[i]);
  }

  Answer answer(const Ray& ray) {
    const auto ends = segment(ray);
    if (!ends) return {.outcome = Outcome::fault};
    Nearest nearest(to_bullet(ends->from), to_bullet(ends->to));
    for (std::size_t i = 0; i < triangles_.size(); ++i)
      nearest.processTriangle(triangles_[i].data(), 0, static_cast<int>(i));
    return nearest.answer;
  }

  double largest_;
  std::vector<Corners> triangles_;  // it takes them by a pointer to non-const, and doesn't write
};

class BulletTracer final : public Tracer {
 public:
  BulletTracer()
      : Tracer({.name = "bullet_f32",
                .summary = "Bullet: a segment against the plane, then three edges with a relative tolerance",
                .source = "btTriangleRaycastCallback::processTriangle",
                .package = "libbullet-dev " + std::to_string(BT_BULLET_VERSION / 100) + '.' +
                           std::to_string(BT_BULLET_VERSION % 100),
                .contract = {.precision = Precision::binary32,
                             .t_min = EndRule::unspecified,
                             .t_max = EndRule::unspecified,
                             .coplanar = TouchRule::unspecified,
                             .degenerate = TouchRule::unspecified,
                             .slack_relative = 2e-4},
                .own_queries = true}) {}

  std::unique_ptr<PreparedBag> prepare(const Bag& bag) const override { return std::make_unique<PreparedBullet>(bag); }
};

}  // namespace

std::vector<std::unique_ptr<Tracer>> bullet_tracers() {
  std::vector<std::unique_ptr<Tracer>> list;
  list.push_back(std::make_unique<BulletTracer>());
  return list;
}

}  // namespace plumbline
