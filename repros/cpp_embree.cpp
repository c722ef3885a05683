// As float_tracer/adapters/embree.cpp asks: a scene of one triangle.

#include "repros/c_check.h"
#include "repros/forms.h"
#include "repros/text.h"

namespace plumbline {
namespace {

constexpr std::string_view command = "g++ -std=c++17 repro.cpp -lembree3 -o repro && ./repro      # libembree-dev";

constexpr std::string_view text = R"(@STORY@
#include <embree3/rtcore.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

@CASE@
@ANSWER@
static void put(float* to, const float* v) { to[0] = v[0], to[1] = v[1], to[2] = v[2]; }

static Answer ask(void) {
  RTCDevice device = rtcNewDevice("threads=1@ISA@");
  if (!device) {
    fprintf(stderr, "no device\n");
    exit(2);
  }
  RTCScene scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_@FLAG@);
  RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  float* vertex = (float*)rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, 3);
  unsigned* index = (unsigned*)rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, 1);
  put(vertex, a), put(vertex + 3, b), put(vertex + 6, c);
  index[0] = 0, index[1] = 1, index[2] = 2;
  rtcCommitGeometry(mesh);
  rtcAttachGeometry(scene, mesh);
  rtcCommitScene(scene);
  if (rtcGetDeviceError(device) != RTC_ERROR_NONE) {
    fprintf(stderr, "no scene\n");
    exit(2);
  }
  struct RTCIntersectContext context;
  rtcInitIntersectContext(&context);
@CALL@}

@MAIN@)";

// mask: a build with masks hides what has no bit in common with it.
constexpr std::string_view ray_text =
    R"(  @RAY@.org_x@I@ = origin[0], @RAY@.org_y@I@ = origin[1], @RAY@.org_z@I@ = origin[2];
  @RAY@.dir_x@I@ = direction[0], @RAY@.dir_y@I@ = direction[1], @RAY@.dir_z@I@ = direction[2];
  @RAY@.tnear@I@ = t_min, @RAY@.tfar@I@ = t_max, @RAY@.mask@I@ = ~0u;
)";

constexpr std::string_view single_text = R"(  struct RTCRayHit query = {};
@RAY@  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene, &context, &query);
  const Answer answer = {query.hit.geomID != RTC_INVALID_GEOMETRY_ID, query.ray.tfar, query.hit.u, query.hit.v};
  return answer;
)";

constexpr std::string_view packet_text =
    R"(  alignas(64) int valid[@WIDTH@] = {-1};  // the first ray of the packet; the others are off
  struct RTCRayHit@WIDTH@ query = {};
@RAY@  query.hit.geomID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect@WIDTH@(valid, scene, &context, &query);
  const Answer answer = {query.hit.geomID[0] != RTC_INVALID_GEOMETRY_ID, query.ray.tfar[0], query.hit.u[0],
                         query.hit.v[0]};
  return answer;
)";

constexpr std::string_view occluded_text = R"(  struct RTCRay ray = {};
@RAY@  rtcOccluded1(scene, &context, &ray);
  const Answer answer = {ray.tfar < 0, 0, 0, 0};  // by convention -inf where the ray is blocked
  return answer;
)";

std::string call_text(std::string_view tracer) {
  const auto ray = [](std::string name, std::string index) { return fill(ray_text, {{"RAY", name}, {"I", index}}); };
  for (const std::string width : {"4", "8", "16"})
    if (tracer.ends_with("_w" + width))
      return fill(packet_text, {{"RAY", ray("query.ray", "[0]")}, {"WIDTH", width}});
  if (tracer.ends_with("_occluded")) return fill(occluded_text, {{"RAY", ray("ray", "")}});
  return fill(single_text, {{"RAY", ray("query.ray", "")}});
}

std::string isa_of(std::string_view tracer) {
  for (const std::string isa : {"sse2", "avx2", "avx512"})
    if (tracer.ends_with("_" + isa)) return ",isa=" + isa;
  return "";
}

}  // namespace

std::string cpp_embree(const Case& what, std::string_view tracer) {
  const Evidence e = gather_to_ask(what, tracer);
  constexpr std::string_view type = "static const float";
  const bool numbers = !tracer.ends_with("_occluded");
  return fill(text, {{"STORY", commented(story(e, command), "// ")},
                     {"CASE", c_triangle(e, type) + c_ray(e, type) + c_range(e, type)},
                     {"ANSWER", c_answer()},
                     {"ISA", isa_of(tracer)},
                     {"FLAG", tracer.starts_with("embree_robust") ? "ROBUST" : "NONE"},
                     {"CALL", call_text(tracer)},
                     {"MAIN", c_main(e, {.t = numbers, .uv = numbers})}});
}

}  // namespace plumbline
