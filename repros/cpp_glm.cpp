// As float_tracer/adapters/glm.cpp asks.
#include "repros/c_check.h"
#include "repros/forms.h"
#include "repros/text.h"

namespace plumbline {
namespace {

constexpr std::string_view command =
    "g++ -std=c++17 -O2 -ffp-contract=off repro.cpp -o repro && ./repro      # libglm-dev";

constexpr std::string_view text = R"(@STORY@
#define GLM_ENABLE_EXPERIMENTAL
#include <glm/gtx/intersect.hpp>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>

using Real = @REAL@;
using Vec = glm::vec<3, Real, glm::defaultp>;

@CASE@
@ANSWER@
static Vec vec(const Real* v) { return {v[0], v[1], v[2]}; }

static Answer ask() {
  glm::vec<2, Real, glm::defaultp> uv(0);
  Real t = 0;
  if (!glm::intersectRayTriangle(vec(origin), vec(direction), vec(a), vec(b), vec(c), uv, t)) return {};
  if (!(t >= t_min && t <= t_max)) return {};  // it takes the line for the ray: its callers have to look
  return {true, t, uv.x, uv.y};
}

@MAIN@)";

}  // namespace

std::string cpp_glm(const Case& what, std::string_view tracer) {
  const Evidence e = gather_to_ask(what, tracer);
  constexpr std::string_view type = "static const Real";
  return fill(text, {{"STORY", commented(story(e, command), "// ")},
                     {"REAL", e.contract.precision == Precision::binary32 ? "float" : "double"},
                     {"CASE", c_triangle(e, type) + c_ray(e, type) + c_range(e, type)},
                     {"ANSWER", c_answer()},
                     {"MAIN", c_main(e, {.t = true, .uv = true})}});
}

}  // namespace plumbline
