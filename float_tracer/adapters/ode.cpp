#include "float_tracer/adapters/ode.h"

#include <ode/ode.h>
#include <ode/version.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>
#include <type_traits>

#include "case/float_bits.h"
#include "float_tracer/adapters/segment.h"

namespace plumbline {
namespace {

static_assert(std::is_same_v<dReal, double>, "Debian's libode is the double precision one");

// For all of ODE, which the first lock initializes; a build with a cache for each thread wants to hear of each one.
std::unique_lock<std::mutex> lock_ode() {
  static std::mutex mutex;
  std::unique_lock lock(mutex);
  static const bool initialized = dInitODE2(0) != 0;
  thread_local const bool allocated = initialized && dAllocateODEDataForThread(dAllocateMaskAll) != 0;
  static_cast<void>(allocated);
  return lock;
}

struct DestroyGeom {
  void operator()(dGeomID geom) const { dGeomDestroy(geom); }
};
struct DestroyData {
  void operator()(dTriMeshDataID data) const { dGeomTriMeshDataDestroy(data); }
};
using Geom = std::unique_ptr<std::remove_pointer_t<dGeomID>, DestroyGeom>;
using Data = std::unique_ptr<std::remove_pointer_t<dTriMeshDataID>, DestroyData>;

constexpr double infinity = std::numeric_limits<double>::infinity();

bool within_float(const Vec3& v) {
  constexpr double limit = std::numeric_limits<float>::max();
  return std::abs(v.x) <= limit && std::abs(v.y) <= limit && std::abs(v.z) <= limit;
}

double length(const Vec3& v) { return std::hypot(v.x, v.y, v.z); }

class PreparedMesh final : public PreparedBag {
 public:
  explicit PreparedMesh(const Bag& bag) : largest_(largest_coordinate(bag)) {
    for (const Triangle& t : bag.triangles)
      for (const Vec3& v : {t.a, t.b, t.c}) {
        if (!within_float(v)) return;
        indices_.push_back(static_cast<dTriIndex>(indices_.size()));
        vertices_.insert(vertices_.end(), {v.x, v.y, v.z});
      }
    const auto lock = lock_ode();
    if (!indices_.empty()) {
      data_.reset(dGeomTriMeshDataCreate());
      const int count = static_cast<int>(indices_.size());
      dGeomTriMeshDataBuildDouble(data_.get(), vertices_.data(), 3 * sizeof(double), count, indices_.data(), count,
                                  3 * sizeof(dTriIndex));
      mesh_.reset(dCreateTriMesh(nullptr, data_.get(), nullptr, nullptr, nullptr));
    }
    ray_.reset(dCreateRay(nullptr, 1));
    dGeomRaySetClosestHit(ray_.get(), 1);
    dGeomRaySetBackfaceCull(ray_.get(), 0);
    dGeomRaySetFirstContact(ray_.get(), 0);
  }

  ~PreparedMesh() override {
    const auto lock = lock_ode();
    ray_.reset(), mesh_.reset(), data_.reset();
  }

  Query asked(const Ray& ray) override {
    const auto lock = lock_ode();
    return set(ray).value_or(ray);
  }

 private:
  // Puts the ray to ODE and reads back what it became. No value, and ODE left alone, for what it can't take. Under
  // its lock.
  std::optional<Ray> set(const Ray& ray) {
    const Vec3 &o = ray.origin, &d = ray.direction;
    const double given_length = length(d);
    if (!ray_ || !within_float(o) || !(ray.t_min >= 0)) return std::nullopt;
    if (!std::isnormal(given_length)) return std::nullopt;
    dGeomRaySet(ray_.get(), o.x, o.y, o.z, d.x, d.y, d.z);
    dVector3 start, unit;
    dGeomRayGet(ray_.get(), start, unit);
    Ray r{.origin = {start[0], start[1], start[2]}, .direction = {unit[0], unit[1], unit[2]}};
    r.t_min = ray.t_min * given_length;
    r.t_max = ray.t_max == infinity ? reach(r.origin, r.direction, largest_) : ray.t_max * given_length;
    if (!(r.t_max > 0) || !is_finite(r.t_max)) return std::nullopt;
    dGeomRaySetLength(ray_.get(), r.t_max);
    return r;
  }

  void answer(std::span<const Ray> rays, std::span<Answer> answers) override {
    const auto lock = lock_ode();
    std::ranges::transform(rays, answers.begin(), [this](const Ray& ray) { return answer(ray); });
  }

  Answer answer(const Ray& ray) {
    const auto asked = set(ray);
    if (!asked) return {.outcome = Outcome::fault};
    dContactGeom contact;
    if (!mesh_ || dCollide(ray_.get(), mesh_.get(), 1, &contact, sizeof contact) == 0) return {};
    if (!(contact.depth >= asked->t_min && contact.depth <= asked->t_max)) return {};
    return {.outcome = Outcome::hit,
            .has_t = true,
            .triangle = static_cast<std::uint32_t>(contact.g1 == mesh_.get() ? contact.side1 : contact.side2),
            .t = contact.depth};
  }

  double largest_;
  std::vector<double> vertices_;  // ODE keeps pointers to both
  std::vector<dTriIndex> indices_;
  Data data_;  // null without triangles
  Geom mesh_;
  Geom ray_;  // null: a vertex is beyond the limits
};

class OdeTracer final : public Tracer {
 public:
  OdeTracer()
      : Tracer({.name = "ode_f64",
                .summary = "ODE: a ray against a triangle mesh, doubles outside and floats inside",
                .source = "dCollide",
                .package = "libode-dev " dODE_VERSION,
                .contract = {.edges = EdgeRule::unspecified,
                             .t_min = EndRule::unspecified,
                             .t_max = EndRule::unspecified,
                             .coplanar = TouchRule::unspecified,
                             .degenerate = TouchRule::unspecified},
                .has_tree = true,
                .own_queries = true,
                .isolation = Isolation::process}) {}

  std::unique_ptr<PreparedBag> prepare(const Bag& bag) const override { return std::make_unique<PreparedMesh>(bag); }
};

}  // namespace

std::vector<std::unique_ptr<Tracer>> ode_tracers() {
  std::vector<std::unique_ptr<Tracer>> list;
  list.push_back(std::make_unique<OdeTracer>());
  return list;
}

}  // namespace plumbline
