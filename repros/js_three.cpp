// three.js, Ray.intersectTriangle: no tracer of this project, so its contract is told here. Its documentation says
// that a ray and a triangle are intersected, and is silent on edges, ends, contact in the plane and triangles without
// area.

#include "case/float_bits.h"
#include "repros/evidence.h"
#include "repros/forms.h"
#include "repros/text.h"

namespace plumbline {
namespace {

constexpr Contract contract = {.edges = EdgeRule::unspecified,
                               .range = RangeRule::ray,
                               .t_min = EndRule::unspecified,
                               .coplanar = TouchRule::unspecified,
                               .degenerate = TouchRule::unspecified};

constexpr std::string_view command = "npm install three && node repro.mjs";

constexpr std::string_view text = R"(@STORY@
import { Ray, REVISION, Vector3 } from "three";

const a = new Vector3(@A@);
const b = new Vector3(@B@);
const c = new Vector3(@C@);
const ray = new Ray(new Vector3(@ORIGIN@), new Vector3(@DIRECTION@));

const got = ray.intersectTriangle(a, b, c, false, new Vector3());

let right = @RIGHT@;
console.log(`three r${REVISION}: expected @EXPECTED@, got ${got ? "a hit" : "a miss"}${right ? "" : ": WRONG"}`);
@POINT@process.exitCode = right ? 0 : 1;
)";

constexpr std::string_view point_text = R"(if (got) {
  // The exact point, rounded. A hit may be off by 2^-10 of the longest edge.
  const exact = new Vector3(@EXACT@);
  const edge = Math.max(a.distanceTo(b), b.distanceTo(c), c.distanceTo(a));
  const near = got.distanceTo(exact) <= edge / 1024; // a NaN isn't
  console.log(`  at ${got.toArray()}, expected ${exact.toArray()}${near ? "" : ": WRONG"}`);
  right = right && near;
}
)";

std::string point_check(const Evidence& e) {
  if (!e.has_numbers()) return "";
  const auto point = hit_point<double>(e.triangle(), e.query);
  if (!point) return "";
  const Vec3 exact{(*point)[0], (*point)[1], (*point)[2]};
  if (!is_finite(exact.x) || !is_finite(exact.y) || !is_finite(exact.z)) return "";
  return fill(point_text, {{"EXACT", decimals(exact)}});
}

}  // namespace

std::string js_three(const Case& what) {
  const Evidence e = gather(what, "three.js", contract);
  constexpr std::string_view expected[] = {"a hit", "a miss", "either (nothing is promised here)"};
  constexpr std::string_view right[] = {"got !== null", "got === null", "true"};
  const auto duty = static_cast<unsigned>(e.duty);
  const Triangle& t = e.triangle();
  return fill(text, {{"STORY", commented(story(e, command), "// ")},
                     {"A", decimals(t.a)},
                     {"B", decimals(t.b)},
                     {"C", decimals(t.c)},
                     {"ORIGIN", decimals(e.ray().origin)},
                     {"DIRECTION", decimals(e.ray().direction)},
                     {"RIGHT", std::string(right[duty])},
                     {"EXPECTED", std::string(expected[duty])},
                     {"POINT", point_check(e)}});
}

}  // namespace plumbline
