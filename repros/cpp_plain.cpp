// The textbook kernels of float_tracer/, written out.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "case/input_error.h"
#include "repros/c_check.h"
#include "repros/forms.h"
#include "repros/text.h"

namespace plumbline {
namespace {

struct PlainKernel {
  std::string_view name, text;
};

constexpr std::array<PlainKernel, 4> kernels = {{
    {"moller_trumbore", R"(
// Moller and Trumbore, Fast, Minimum Storage Ray/Triangle Intersection, JGT 2(1), 1997: two-sided, no epsilon.
Answer intersect(Vec a, Vec b, Vec c, Vec origin, Vec direction, Real t_min, Real t_max) {
  const Vec ab = b - a, ac = c - a, p = cross(direction, ac);
  const Real det = dot(ab, p);
  if (det == 0) return miss;
  const Real inverse = 1 / det;
  const Vec from_a = origin - a;
  const Real u = dot(from_a, p) * inverse;
  if (!(u >= 0 && u <= 1)) return miss;
  const Vec q = cross(from_a, ab);
  const Real v = dot(direction, q) * inverse;
  if (!(v >= 0 && u + v <= 1)) return miss;
  const Real t = dot(ac, q) * inverse;
  if (!(t_min <= t && t <= t_max)) return miss;
  return {true, t, u, v};
}
)"},
    {"woop_watertight", R"(
// Woop, Benthin and Wald, Watertight Ray/Triangle Intersection, JCGT 2(1), 2013: two-sided.
template <class Wide>
Wide edge(Wide px, Wide py, Wide qx, Wide qy) { return px * qy - py * qx; }

Answer intersect(Vec a, Vec b, Vec c, Vec origin, Vec direction, Real t_min, Real t_max) {
  const int kz = largest_axis(direction), kx = (kz + 1) % 3, ky = (kx + 1) % 3;
  const Real sx = direction[kx] / direction[kz], sy = direction[ky] / direction[kz], sz = 1 / direction[kz];
  a = a - origin, b = b - origin, c = c - origin;
  const Real ax = a[kx] - sx * a[kz], ay = a[ky] - sy * a[kz];
  const Real bx = b[kx] - sx * b[kz], by = b[ky] - sy * b[kz];
  const Real cx = c[kx] - sx * c[kz], cy = c[ky] - sy * c[kz];
  Real wa = edge<Real>(cx, cy, bx, by), wb = edge<Real>(ax, ay, cx, cy), wc = edge<Real>(bx, by, ax, ay);
  if (sizeof(Real) == sizeof(float) && (wa == 0 || wb == 0 || wc == 0)) {  // once more in double, as the paper says
    wa = static_cast<Real>(edge<double>(cx, cy, bx, by));
    wb = static_cast<Real>(edge<double>(ax, ay, cx, cy));
    wc = static_cast<Real>(edge<double>(bx, by, ax, ay));
  }
  if (!(wa >= 0 && wb >= 0 && wc >= 0) && !(wa <= 0 && wb <= 0 && wc <= 0)) return miss;
  const Real det = wa + wb + wc;
  if (det == 0) return miss;
  const Real scaled = wa * (sz * a[kz]) + wb * (sz * b[kz]) + wc * (sz * c[kz]);  // t * det
  const Real scaled_t = det < 0 ? -scaled : scaled, scale = std::abs(det);
  if (!(scaled_t >= t_min * scale && scaled_t <= t_max * scale)) return miss;
  const Real inverse = 1 / det;
  return {true, scaled * inverse, wb * inverse, wc * inverse};
}
)"},
    {"plucker", R"(
// Lines in Plucker coordinates: Shoemake, RTN 11(1), 1998; Jones, RTN 13(1), 2000: two-sided, zeros included.
Real side(Vec p_direction, Vec p_moment, Vec from, Vec to) {
  return dot(p_direction, cross(from, to)) + dot(to - from, p_moment);
}

Answer intersect(Vec a, Vec b, Vec c, Vec origin, Vec direction, Real t_min, Real t_max) {
  const Vec moment = cross(origin, direction);
  const Real wa = side(direction, moment, b, c), wb = side(direction, moment, c, a);
  const Real wc = side(direction, moment, a, b);
  const bool front = wa >= 0 && wb >= 0 && wc >= 0, back = wa <= 0 && wb <= 0 && wc <= 0;
  if (front == back) return miss;  // outside; or all three zero: in the plane
  const Vec normal = cross(b - a, c - a);
  const Real slope = dot(normal, direction);
  if (slope == 0) return miss;
  const Real t = dot(normal, a - origin) / slope;
  if (!(t_min <= t && t <= t_max)) return miss;
  const Real sum = wa + wb + wc;
  return {true, t, wb / sum, wc / sum};
}
)"},
    {"baldwin_weber", R"(
// Baldwin and Weber, Fast Ray-Triangle Intersections by Coordinate Transformation, JCGT 5(3), 2016: two-sided.
struct Row {
  Vec linear;
  Real shift;
};

Answer intersect(Vec a, Vec b, Vec c, Vec origin, Vec direction, Real t_min, Real t_max) {
  const Vec ab = b - a, ac = c - a, n = cross(ab, ac), ca = cross(c, a), ba = cross(b, a);
  const int k = largest_axis(n), i = (k + 1) % 3, j = (i + 1) % 3;
  Row u = {}, v = {}, z = {};  // the map that takes a, b, c to (0,0,0), (1,0,0), (0,1,0)
  u.linear[i] = ac[j] / n[k], u.linear[j] = -ac[i] / n[k], u.shift = ca[k] / n[k];
  v.linear[i] = -ab[j] / n[k], v.linear[j] = ab[i] / n[k], v.shift = -ba[k] / n[k];
  z.linear[i] = n[i] / n[k], z.linear[j] = n[j] / n[k], z.linear[k] = 1, z.shift = -dot(n, a) / n[k];
  const Real t = -(dot(z.linear, origin) + z.shift) / dot(z.linear, direction);
  if (!(t_min <= t && t <= t_max)) return miss;
  const Real hit_u = (dot(u.linear, origin) + u.shift) + t * dot(u.linear, direction);
  const Real hit_v = (dot(v.linear, origin) + v.shift) + t * dot(v.linear, direction);
  if (!(hit_u >= 0 && hit_v >= 0 && hit_u + hit_v <= 1)) return miss;
  return {true, t, hit_u, hit_v};
}
)"},
}};

constexpr std::string_view command = "g++ -std=c++17 -O2 -ffp-contract=off repro.cpp -o repro && ./repro";

constexpr std::string_view text = R"(@STORY@
#include <cmath>
#include <cstdio>

using std::fabs;
using Real = @REAL@;

// volatile: so that it is computed when the program runs, by the processor, and not before, by the compiler.
@CASE@
@ANSWER@
struct Vec {
  Real x, y, z;
  Real& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  Real operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
};
inline Vec vec(const volatile Real* v) { return {v[0], v[1], v[2]}; }
inline Vec operator-(Vec p, Vec q) { return {p.x - q.x, p.y - q.y, p.z - q.z}; }
inline Real dot(Vec p, Vec q) { return p.x * q.x + p.y * q.y + p.z * q.z; }
inline Vec cross(Vec p, Vec q) {
  return {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
}
inline int largest_axis(Vec v) {
  const Real x = std::abs(v.x), y = std::abs(v.y), z = std::abs(v.z);
  return x >= y && x >= z ? 0 : y >= z ? 1 : 2;
}
constexpr Answer miss = {false, 0, 0, 0};
@KERNEL@
Answer ask() { return intersect(vec(a), vec(b), vec(c), vec(origin), vec(direction), t_min, t_max); }

@MAIN@)";

constexpr std::string_view binary32_suffix = "_f32", binary64_suffix = "_f64";

const PlainKernel* kernel_of(std::string_view tracer) {
  const auto* found = std::ranges::find_if(kernels, [tracer](const PlainKernel& k) {
    const bool named = tracer.starts_with(k.name);
    const std::string_view rest = named ? tracer.substr(k.name.size()) : "";
    return rest == binary32_suffix || rest == binary64_suffix;
  });
  return found == kernels.end() ? nullptr : found;
}

}  // namespace

std::string cpp_plain(const Case& what, std::string_view tracer) {
  const PlainKernel* kernel = kernel_of(tracer);
  if (!kernel)
    throw InputError(
        fmt::format("case '{}': cpp-plain has the source of moller_trumbore, woop_watertight, plucker and "
                    "baldwin_weber (_f32, _f64), not of {}; python-proof, obj, ply and asc tell any tracer's cases",
                    what.id, tracer));
  const Evidence e = gather_to_ask(what, tracer);
  constexpr std::string_view type = "const volatile Real";
  const bool single = e.contract.precision == Precision::binary32;
  return fill(text, {{"STORY", commented(story(e, command), "// ")},
                     {"REAL", single ? "float" : "double"},
                     {"CASE", c_triangle(e, type) + c_ray(e, type) + c_range(e, type)},
                     {"ANSWER", c_answer()},
                     {"KERNEL", std::string(kernel->text)},
                     {"MAIN", c_main(e, {.t = true, .uv = true})}});
}

}  // namespace plumbline
