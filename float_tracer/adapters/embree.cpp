#include "float_tracer/adapters/embree.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>

namespace plumbline {
namespace {

constexpr double coordinate_limit = 1.844e18f;  // Embree's FLT_LARGE: beyond it a squared length overflows

struct ReleaseDevice {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseDevice>;
using Scene = std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseScene>;

// One for the process. One thread: a scene here is a few triangles, and its building must not wake a thread pool.
RTCDevice shared_device() {
  static const Device device(rtcNewDevice("threads=1"));
  return device.get();
}

bool within_limits(const Vec3& v) {
  return std::abs(v.x) < coordinate_limit && std::abs(v.y) < coordinate_limit && std::abs(v.z) < coordinate_limit;
}

bool within_limits(const Triangle& t) { return within_limits(t.a) && within_limits(t.b) && within_limits(t.c); }

bool within_limits(const Ray& r) {
  return within_limits(r.origin) && within_limits(r.direction) && r.t_min >= 0 && r.t_max >= 0;
}

void put(float*& to, const Vec3& v) {
  for (const double x : {v.x, v.y, v.z}) *to++ = static_cast<float>(x);
}

// Null if the bag is beyond the limits or Embree refuses it.
Scene build(const Bag& bag, RTCSceneFlags flags) {
  if (!std::ranges::all_of(bag.triangles, [](const Triangle& t) { return within_limits(t); })) return nullptr;
  const RTCDevice device = shared_device();
  if (!device) return nullptr;
  Scene scene(rtcNewScene(device));
  rtcSetSceneFlags(scene.get(), flags);

  const std::size_t count = bag.triangles.size();
  const RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertex = static_cast<float*>(
      rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 3 * count));
  auto* index = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), count));
  for (const Triangle& t : bag.triangles) {
    put(vertex, t.a);
    put(vertex, t.b);
    put(vertex, t.c);
  }
  for (unsigned i = 0; i < 3 * count; ++i) index[i] = i;
  rtcCommitGeometry(mesh);
  rtcAttachGeometry(scene.get(), mesh);
  rtcReleaseGeometry(mesh);
  rtcCommitScene(scene.get());
  return rtcGetDeviceError(device) == RTC_ERROR_NONE ? std::move(scene) : nullptr;
}

RTCRayHit to_embree(const Ray& r) {
  RTCRayHit query{};
  query.ray.org_x = static_cast<float>(r.origin.x);
  query.ray.org_y = static_cast<float>(r.origin.y);
  query.ray.org_z = static_cast<float>(r.origin.z);
  query.ray.dir_x = static_cast<float>(r.direction.x);
  query.ray.dir_y = static_cast<float>(r.direction.y);
  query.ray.dir_z = static_cast<float>(r.direction.z);
  query.ray.tnear = static_cast<float>(r.t_min);
  query.ray.tfar = static_cast<float>(r.t_max);
  query.ray.mask = ~0u;  // Debian's build has masks on: 0 would hide every triangle
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  return query;
}

class PreparedScene final : public PreparedBag {
 public:
  explicit PreparedScene(Scene scene) : scene_(std::move(scene)) {}

 private:
  void answer(std::span<const Ray> rays, std::span<Answer> answers) override {
    for (std::size_t i = 0; i < rays.size(); ++i) answers[i] = answer(rays[i]);
  }

  Answer answer(const Ray& ray) const {
    if (!scene_ || !within_limits(ray)) return {.outcome = Outcome::fault};
    RTCRayHit query = to_embree(ray);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene_.get(), &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    return {.outcome = Outcome::hit,
            .has_t = true,
            .has_uv = true,
            .triangle = query.hit.primID,
            .t = query.ray.tfar,
            .u = query.hit.u,
            .v = query.hit.v};
  }

  Scene scene_;  // null: beyond the limits
};

class EmbreeTracer final : public Tracer {
 public:
  EmbreeTracer(std::string name, std::string summary, RTCSceneFlags flags)
      : Tracer({.name = std::move(name),
                .summary = std::move(summary),
                .source = "rtcIntersect1",
                .package = "libembree-dev " RTC_VERSION_STRING,
                .contract = {.precision = Precision::binary32,
                             .edges = EdgeRule::unspecified,
                             .t_min = EndRule::unspecified,
                             .t_max = EndRule::unspecified,
                             .coplanar = TouchRule::unspecified,
                             .degenerate = TouchRule::unspecified}}),
        flags_(flags) {}

  std::unique_ptr<PreparedBag> prepare(const Bag& bag) const override {
    return std::make_unique<PreparedScene>(build(bag, flags_));
  }

 private:
  RTCSceneFlags flags_;
};

}  // namespace

std::vector<std::unique_ptr<Tracer>> embree_tracers() {
  std::vector<std::unique_ptr<Tracer>> list;
  list.push_back(
      std::make_unique<EmbreeTracer>("embree_default", "Embree 3 with its default scene flags", RTC_SCENE_FLAG_NONE));
  list.push_back(
      std::make_unique<EmbreeTracer>("embree_robust", "Embree 3 with its robust scene flag", RTC_SCENE_FLAG_ROBUST));
  return list;
}

}  // namespace plumbline
