// As float_tracer/adapters/bullet.cpp asks: the segment that its user has to make of a ray.
#include <fmt/format.h>

#include "case/input_error.h"
#include "float_tracer/adapters/segment.h"
#include "repros/c_check.h"
#include "repros/forms.h"
#include "repros/text.h"

namespace plumbline {
namespace {

constexpr std::string_view command =
    "g++ -std=c++17 -O2 repro.cpp $(pkg-config --cflags --libs bullet) -o "
    "repro && ./repro      # libbullet-dev";

constexpr std::string_view text = R"(@STORY@
#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>

@TRIANGLE@
// The ray:
@RAY@//
// A segment is what Bullet is asked for: from the ray's point at t_min to that at t_max, rounded; or, where t_max is
// infinite, to one that is surely past the triangle.
static const float from[3] = {@FROM@};  // @FROM_DECIMALS@
static const float to[3] = {@TO@};  // @TO_DECIMALS@

@ANSWER@
static btVector3 vec(const float* v) { return btVector3(v[0], v[1], v[2]); }

struct Nearest : btTriangleRaycastCallback {
  using btTriangleRaycastCallback::btTriangleRaycastCallback;
  btScalar reportHit(const btVector3&, btScalar fraction, int, int) override {
    answer = {true, fraction, 0, 0};
    return fraction;
  }
  Answer answer = {};
};

static Answer ask() {
  static_assert(sizeof(btScalar) == sizeof(float), "Debian's build is the single precision one");
  btVector3 corners[3] = {vec(a), vec(b), vec(c)};
  Nearest nearest(vec(from), vec(to));
  nearest.processTriangle(corners, 0, 0);
  return nearest.answer;  // t is the fraction of the segment
}

@MAIN@)";

}  // namespace

std::string cpp_bullet(const Case& what, std::string_view tracer) {
  const Evidence e = gather_to_ask(what, tracer);
  constexpr std::string_view type = "static const float";
  const auto ends = segment_of(e.ray(), largest_coordinate(e.what.bag), Precision::binary32);
  if (!ends)
    throw InputError(fmt::format("case '{}': no segment of floats is this ray; cpp-bullet needs one", what.id));
  const auto numbers = [](const Vec3& v) { return c_numbers(v, Precision::binary32); };
  return fill(text, {{"STORY", commented(story(e, command), "// ")},
                     {"TRIANGLE", c_triangle(e, type)},
                     {"RAY", commented(c_ray(e, "float") + c_range(e, "float"), "//   ")},
                     {"FROM", numbers(ends->from)},
                     {"FROM_DECIMALS", decimals(ends->from)},
                     {"TO", numbers(ends->to)},
                     {"TO_DECIMALS", decimals(ends->to)},
                     {"ANSWER", c_answer()},
                     {"MAIN", c_main(e, {.t = true})}});
}

}  // namespace plumbline
