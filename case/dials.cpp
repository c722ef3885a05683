#include "case/dials.h"

#include <cmath>

#include "case/precision.h"
#include "case/random_shots.h"

namespace plumbline {
namespace {

using namespace shots;

double power(int exponent) { return std::ldexp(1.0, exponent); }

Vec3 any_vector(Random& random) {
  return vector([&] { return random.unit(); });
}

double either_sign(Random& random) { return random.chance(2) ? 1.0 : -1.0; }

Shot needle(Random& random, int k) {
  Triangle t = random_triangle(random);
  t.c = add(t.a, scale(power(-k), t.c));
  return aimed(random, t);
}

Shot cap(Random& random, int k) {
  Triangle t = random_triangle(random);
  t.c = add(point(t, {0.5 + 0.25 * random.unit(), 0}), scale(power(-k), t.c));
  return aimed(random, t);
}

Shot grazing(Random& random, int k) {
  const Triangle t = random_triangle(random);
  const Target at = near_inside(random), from{4 * random.unit(), 4 * random.unit()};
  return {t, from_to(add(point(t, from), scale(power(-k), any_vector(random))), point(t, at))};
}

// Over the triangle, to a point in the plane below: the way along the plane, and 2^-k of the way down.
Shot parallel(Random& random, int k) {
  const Triangle t = random_triangle(random);
  const Vec3 up = any_vector(random);
  const Vec3 over = add(point(t, near_inside(random)), up);
  const Vec3 along = subtract(point(t, {random.unit(), random.unit()}), t.a);
  return {t, {over, subtract(along, scale(power(-k), up))}};
}

Shot far(Random& random, int k) {
  const Vec3 away = scale(power(k), vector([&] { return either_sign(random); }));
  Triangle t = random_triangle(random);
  for (Vec3* p : {&t.a, &t.b, &t.c}) *p = add(*p, away);
  const Target at = near_inside(random);
  return {t, from_to(add(random_origin(random), away), point(t, at))};
}

Shot near_start(Random& random, int k) {
  const Triangle t = random_triangle(random);
  const Vec3 at = point(t, near_inside(random)), along = any_vector(random);
  return {t, {add(at, scale(either_sign(random) * power(-k), along)), along}};
}

// Beside the point at weight u of edge AB: at 2^-k inside or outside.
Shot near_edge(Random& random, int k, double u) {
  const Triangle t = random_triangle(random);
  const Target at{u, either_sign(random) * power(-k)};
  return {t, from_to(random_origin(random), point(t, at))};
}

Shot direction_scale(Random& random, int k) {
  Shot s = aimed(random, random_triangle(random));
  s.ray.direction = scale(power(random.chance(2) ? k : -k), s.ray.direction);
  return s;
}

Shot mixed_exponents(Random& random, int k) {
  const auto mixed = [&] { return spread(random, k / 2); };
  Triangle t{vector(mixed), vector(mixed), vector(mixed)};
  return {t, from_to(vector(mixed), t.a)};
}

// The vertices in any order: no kernel treats all edges alike.
Shot turned(Random& random, Shot s) {
  const Triangle t = s.triangle;
  switch (random.below(3)) {
    case 0: s.triangle = {t.b, t.c, t.a}; break;
    case 1: s.triangle = {t.c, t.a, t.b}; break;
    default: break;
  }
  return s;
}

Shot geometry(Dial dial, int k, Random& random) {
  switch (dial) {
    case Dial::needle: return needle(random, k);
    case Dial::cap: return cap(random, k);
    case Dial::grazing: return grazing(random, k);
    case Dial::parallel: return parallel(random, k);
    case Dial::far: return far(random, k);
    case Dial::tiny: return scaled(aimed(random, random_triangle(random)), power(-k));
    case Dial::huge: return scaled(aimed(random, random_triangle(random)), power(k));
    case Dial::near_start: return near_start(random, k);
    case Dial::near_edge: return near_edge(random, k, 0.5 + 0.5 * random.unit());
    case Dial::near_vertex: return near_edge(random, k, power(-k));
    case Dial::lattice: return exact_edge(random, k);
    case Dial::direction_scale: return direction_scale(random, k);
    case Dial::mixed_exponents: return mixed_exponents(random, k);
  }
  return {};
}

std::vector<int> every(int step, int first, int last) {
  std::vector<int> list;
  for (int k = first; k <= last; k += step) list.push_back(k);
  return list;
}

}  // namespace

std::string_view meaning(Dial dial) {
  switch (dial) {
    case Dial::needle: return "longest edge over shortest, log2";
    case Dial::cap: return "longest edge over altitude, log2";
    case Dial::grazing: return "distance over height above the plane, log2";
    case Dial::parallel: return "way along the plane over way down, log2";
    case Dial::far: return "distance from 0 over size, log2";
    case Dial::tiny: return "1 over scale, log2";
    case Dial::huge: return "scale, log2";
    case Dial::near_start: return "size over distance from origin to plane, log2";
    case Dial::near_edge: return "size over distance from the edge, log2";
    case Dial::near_vertex: return "size over distance from the vertex, log2";
    case Dial::lattice: return "bits of a coordinate";
    case Dial::direction_scale: return "length of the direction or its inverse, log2";
    case Dial::mixed_exponents: return "binades that coordinates spread over";
  }
  return {};
}

std::vector<int> settings(Dial dial, Precision precision) {
  const bool single = precision == Precision::binary32;
  switch (dial) {
    // Half a precision further and all coordinates of a triangle are the same number.
    case Dial::needle:
    case Dial::cap:
    case Dial::grazing:
    case Dial::parallel:
    case Dial::far: return single ? every(2, 0, 20) : every(4, 0, 40);
    case Dial::tiny: return single ? every(10, 0, 140) : every(100, 0, 1000);
    case Dial::huge: return single ? every(10, 0, 120) : every(100, 0, 900);
    case Dial::near_start: return single ? every(2, 0, 26) : every(4, 0, 56);
    case Dial::near_edge:
    case Dial::near_vertex: return single ? every(2, 2, 26) : every(4, 4, 56);
    case Dial::lattice: return single ? every(2, 4, 22) : every(4, 4, 48);
    case Dial::direction_scale: return single ? every(6, 0, 60) : every(48, 0, 480);
    case Dial::mixed_exponents: return every(4, 0, 40);
  }
  return {};
}

Shot draw(Dial dial, int setting, Precision precision, std::uint64_t seed, std::uint64_t index) {
  Random random(seed, index);
  Shot s = turned(random, geometry(dial, setting, random));
  s.triangle = at_precision(s.triangle, precision);
  s.ray = at_precision(s.ray, precision);
  return s;
}

}  // namespace plumbline
