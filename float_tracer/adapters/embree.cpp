#include "float_tracer/adapters/embree.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <mutex>
#include <string>
#include <string_view>
#include <type_traits>

namespace plumbline {
namespace {

/// The instruction set of a device; any: the one that Embree picks.
enum class Isa : unsigned char { any, sse2, avx2, avx512 };
constexpr std::array<std::string_view, 4> isa_names = {"any", "sse2", "avx2", "avx512"};

constexpr double coordinate_limit = 1.844e18f;  // Embree's FLT_LARGE: beyond it a squared length overflows

struct ReleaseDevice {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseDevice>;
using Scene = std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseScene>;

// One of each instruction set for the process. One thread: a scene here is a few triangles, and its building must not
// wake a thread pool.
RTCDevice shared_device(Isa isa) {
  static std::array<std::once_flag, isa_names.size()> once;
  static std::array<Device, isa_names.size()> devices;
  const auto i = static_cast<std::size_t>(isa);
  std::call_once(once[i], [i] {
    const std::string choice = i == 0 ? "" : ",isa=" + std::string(isa_names[i]);
    devices[i].reset(rtcNewDevice(("threads=1" + choice).c_str()));
  });
  return devices[i].get();
}

// What Embree asks of a processor for that instruction set.
bool supported(Isa isa) {
  switch (isa) {
    case Isa::any: return true;
#ifdef __x86_64__
    case Isa::sse2: return true;
    case Isa::avx2: return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    case Isa::avx512:
      return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
             __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512bw") &&
             __builtin_cpu_supports("avx512vl");
#endif
    default: return false;
  }
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
Scene build(const Bag& bag, RTCSceneFlags flags, Isa isa) {
  if (!std::ranges::all_of(bag.triangles, [](const Triangle& t) { return within_limits(t); })) return nullptr;
  const RTCDevice device = shared_device(isa);
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

RTCRay to_embree(const Ray& r) {
  RTCRay ray{};
  ray.org_x = static_cast<float>(r.origin.x);
  ray.org_y = static_cast<float>(r.origin.y);
  ray.org_z = static_cast<float>(r.origin.z);
  ray.dir_x = static_cast<float>(r.direction.x);
  ray.dir_y = static_cast<float>(r.direction.y);
  ray.dir_z = static_cast<float>(r.direction.z);
  ray.tnear = static_cast<float>(r.t_min);
  ray.tfar = static_cast<float>(r.t_max);
  ray.mask = ~0u;  // Debian's build has masks on: 0 would hide every triangle
  return ray;
}

// Each way of asking takes all rays of a span, of which those within the limits are to be answered.

void intersect_single(RTCScene scene, std::span<const Ray> rays, std::span<Answer> answers) {
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!within_limits(rays[i])) {
      answers[i] = {.outcome = Outcome::fault};
      continue;
    }
    RTCRayHit query{};
    query.ray = to_embree(rays[i]);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &query);
    answers[i] = {};
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;
    answers[i] = {.outcome = Outcome::hit,
                  .has_t = true,
                  .has_uv = true,
                  .triangle = query.hit.primID,
                  .t = query.ray.tfar,
                  .u = query.hit.u,
                  .v = query.hit.v};
  }
}

// Hit or miss, and no more.
void occluded_single(RTCScene scene, std::span<const Ray> rays, std::span<Answer> answers) {
  for (std::size_t i = 0; i < rays.size(); ++i) {
    answers[i] = {};
    if (!within_limits(rays[i])) {
      answers[i].outcome = Outcome::fault;
      continue;
    }
    RTCRay ray = to_embree(rays[i]);
    // By convention a ray that is blocked comes back with tfar = -inf; one that came so is within no limits.
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene, &context, &ray);
    if (ray.tfar < 0) answers[i].outcome = Outcome::hit;
  }
}

void intersect(const int* valid, RTCScene scene, RTCIntersectContext* context, RTCRayHit4* packet) {
  rtcIntersect4(valid, scene, context, packet);
}
void intersect(const int* valid, RTCScene scene, RTCIntersectContext* context, RTCRayHit8* packet) {
  rtcIntersect8(valid, scene, context, packet);
}
void intersect(const int* valid, RTCScene scene, RTCIntersectContext* context, RTCRayHit16* packet) {
  rtcIntersect16(valid, scene, context, packet);
}

// Neighbours share a packet; lanes beyond the end, and those of rays beyond the limits, are off.
template <class Packet, std::size_t width>
void intersect_packets(RTCScene scene, std::span<const Ray> rays, std::span<Answer> answers) {
  for (std::size_t first = 0; first < rays.size(); first += width) {
    alignas(64) int valid[width] = {};
    Packet packet{};
    for (std::size_t i = 0; i < width && first + i < rays.size(); ++i) {
      if (!within_limits(rays[first + i])) continue;
      valid[i] = -1;
      const RTCRay ray = to_embree(rays[first + i]);
      packet.ray.org_x[i] = ray.org_x, packet.ray.org_y[i] = ray.org_y, packet.ray.org_z[i] = ray.org_z;
      packet.ray.dir_x[i] = ray.dir_x, packet.ray.dir_y[i] = ray.dir_y, packet.ray.dir_z[i] = ray.dir_z;
      packet.ray.tnear[i] = ray.tnear, packet.ray.tfar[i] = ray.tfar, packet.ray.mask[i] = ray.mask;
      packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    }
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    intersect(valid, scene, &context, &packet);
    for (std::size_t i = 0; i < width && first + i < rays.size(); ++i) {
      Answer& answer = answers[first + i];
      answer = {};
      if (valid[i] == 0) {
        answer.outcome = Outcome::fault;
      } else if (packet.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID) {
        answer = {.outcome = Outcome::hit,
                  .has_t = true,
                  .has_uv = true,
                  .triangle = packet.hit.primID[i],
                  .t = packet.ray.tfar[i],
                  .u = packet.hit.u[i],
                  .v = packet.hit.v[i]};
      }
    }
  }
}

using Call = void (*)(RTCScene, std::span<const Ray>, std::span<Answer>);

class PreparedScene final : public PreparedBag {
 public:
  PreparedScene(Scene scene, Call call) : scene_(std::move(scene)), call_(call) {}

 private:
  void answer(std::span<const Ray> rays, std::span<Answer> answers) override {
    if (scene_) return call_(scene_.get(), rays, answers);
    std::ranges::fill(answers, Answer{.outcome = Outcome::fault});
  }

  Scene scene_;  // null: beyond the limits
  Call call_;
};

struct Way {
  std::string suffix;   ///< of the name
  std::string summary;  ///< what is special, after a comma
  std::string source;
  Call call;
  Isa isa = Isa::any;
};

class EmbreeTracer final : public Tracer {
 public:
  EmbreeTracer(bool robust, const Way& way)
      : Tracer({.name = (robust ? "embree_robust" : "embree_default") + way.suffix,
                .summary = std::string("Embree 3 with its ") + (robust ? "robust scene flag" : "default scene flags") +
                           way.summary,
                .source = way.source,
                .package = "libembree-dev " RTC_VERSION_STRING,
                .contract = {.precision = Precision::binary32,
                             .edges = EdgeRule::unspecified,
                             .t_min = EndRule::unspecified,
                             .t_max = EndRule::unspecified,
                             .coplanar = TouchRule::unspecified,
                             .degenerate = TouchRule::unspecified},
                .has_tree = true}),
        flags_(robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE),
        call_(way.call),
        isa_(way.isa) {}

  std::unique_ptr<PreparedBag> prepare(const Bag& bag) const override {
    return std::make_unique<PreparedScene>(build(bag, flags_, isa_), call_);
  }

 private:
  RTCSceneFlags flags_;
  Call call_;
  Isa isa_;
};

}  // namespace

std::vector<std::unique_ptr<Tracer>> embree_tracers() {
  std::vector<Way> ways = {{"", "", "rtcIntersect1", intersect_single}};
  for (const Isa isa : {Isa::sse2, Isa::avx2, Isa::avx512}) {
    const std::string name(isa_names[static_cast<std::size_t>(isa)]);
    ways.push_back({"_" + name, ", on " + name, "rtcIntersect1, isa=" + name, intersect_single, isa});
  }
  ways.push_back({"_w4", ", in packets of 4", "rtcIntersect4", intersect_packets<RTCRayHit4, 4>});
  ways.push_back({"_w8", ", in packets of 8", "rtcIntersect8", intersect_packets<RTCRayHit8, 8>});
  ways.push_back({"_w16", ", in packets of 16", "rtcIntersect16", intersect_packets<RTCRayHit16, 16>});
  ways.push_back({"_occluded", ", hit or miss only", "rtcOccluded1", occluded_single});

  std::vector<std::unique_ptr<Tracer>> list;
  for (const Way& way : ways)
    for (const bool robust : {false, true})
      if (supported(way.isa)) list.push_back(std::make_unique<EmbreeTracer>(robust, way));
  return list;
}

}  // namespace plumbline
