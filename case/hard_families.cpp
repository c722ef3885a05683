#include "case/hard_families.h"

#include <array>
#include <cmath>
#include <limits>

#include "case/float_bits.h"
#include "case/random_shots.h"

namespace plumbline {
namespace {

using namespace shots;

// Ranges that begin or end at the hit of a ray aimed at t = 1, or beside it.
void draw_range(Random& random, Ray& ray) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  constexpr std::array<std::array<double, 2>, 8> ranges = {
      {{0, 1}, {1, inf}, {0.5, 1}, {1, 1}, {-inf, 0.5}, {1.5, 4}, {-inf, inf}, {1, 0.5}}};
  if (random.chance(2)) return;
  const auto& [low, high] = ranges[random.bits() % ranges.size()];
  ray.t_min = low;
  ray.t_max = high;
}

Shot random_shot(Random& random) {
  const auto unit = [&] { return random.unit(); };
  return {{vector(unit), vector(unit), vector(unit)}, {vector(unit), vector(unit)}};
}

Shot small_far(Random& random) {
  const auto unit = [&] { return random.unit(); };
  const Vec3 centre = vector(unit), origin = vector(unit);
  const auto near = [&] { return add(centre, scale(0x1p-10, vector(unit))); };
  return {{near(), near(), near()}, {origin, subtract(add(centre, scale(0x1p-12, vector(unit))), origin)}};
}

Shot lattice_shot(Random& random) {
  const auto corner = [&] { return random.chance(2) ? 1.5 : 0.0; };
  Shot s{{vector(corner), vector(corner), vector(corner)}, {vector(corner), {}}};
  s.ray.direction = subtract(vector(corner), s.ray.origin);
  return s;
}

Shot one_ulp_off(Random& random, Shot s) {
  double& moved = *coordinates(s)[random.bits() % 15];
  moved = step_ulps(moved, random.chance(2) ? 1 : -1);
  return s;
}

// Small integers: O = A + i e1 + j e2 and D = k e1 + l e2 lie exactly in the plane.
Shot coplanar(Random& random) {
  const auto small = [&] { return static_cast<double>(random.integer(-8, 8)); };
  const Vec3 a = vector(small), e1 = vector(small), e2 = vector(small);
  const auto in_plane = [&] {
    const double along_e1 = 0.5 * small(), along_e2 = 0.5 * small();
    return add(scale(along_e1, e1), scale(along_e2, e2));
  };
  return {{a, add(a, e1), add(a, e2)}, {add(a, in_plane()), in_plane()}};
}

// Vertices A, A + i E, A + j E; the ray is aimed at a point of their line, runs along it, or goes anywhere.
Shot degenerate(Random& random) {
  const auto small = [&] { return static_cast<double>(random.integer(-4, 4)); };
  const Vec3 a = vector(small), e = vector(small), o = vector(small);
  const auto on_line = [&] { return add(a, scale(small(), e)); };
  Shot s{{a, on_line(), on_line()}, {o, subtract(on_line(), o)}};
  if (random.chance(4)) s.ray = {on_line(), scale(small(), e)};
  if (random.chance(8)) s.ray.direction = vector(small);
  if (random.chance(8)) s.triangle.b = s.triangle.c = a;
  return s;
}

Shot mixed40(Random& random) {
  const auto wide = [&] { return spread(random, 20); };
  Shot s{{vector(wide), vector(wide), vector(wide)}, {vector(wide), {}}};
  s.ray.direction = subtract(s.triangle.a, s.ray.origin);
  return s;
}

Shot wide(Random& random) {
  const auto any = [&] { return spread(random, 500); };
  return {{vector(any), vector(any), vector(any)}, {vector(any), vector(any)}};
}

Shot wide_edge(Random& random) {
  Shot s = exact_edge(random, 51);
  std::array<int, 3> axis{};
  for (int& k : axis) k = static_cast<int>(random.integer(-300, 300));
  const int along = static_cast<int>(random.integer(-300, 300));
  const auto all = coordinates(s);
  for (std::size_t i = 0; i < all.size(); ++i) *all[i] = std::ldexp(*all[i], axis[i % 3] + (i >= 12 ? along : 0));
  return s;
}

Shot full_range(Random& random) {
  const auto any = [&] {
    for (;;)
      if (const double x = from_bits<double>(random.bits()); is_finite(x)) return random.chance(16) ? 0.0 : x;
  };
  return {{vector(any), vector(any), vector(any)}, {vector(any), vector(any)}};
}

Shot sliver(Random& random) {
  Triangle t = random_triangle(random);
  const Vec3 aside = scale(0x1p-20, t.c);
  t.c = add(point(t, {0.5 + 0.5 * random.unit(), 0}), aside);
  return aimed(random, t);
}

Shot far(Random& random) {
  const Vec3 away = scale(0x1p+20, vector([&] { return random.chance(2) ? 1.0 : -1.0; }));
  Triangle t = random_triangle(random);
  for (Vec3* p : {&t.a, &t.b, &t.c}) *p = add(*p, away);
  const Target at = near_inside(random);
  return {t, from_to(add(random_origin(random), away), point(t, at))};
}

Shot grazing(Random& random) {
  const Triangle t = random_triangle(random);
  const Target at = near_inside(random), from = {4 * random.unit(), 4 * random.unit()};
  const Vec3 above = scale(0x1p-20, vector([&] { return random.unit(); }));
  return {t, from_to(add(point(t, from), above), point(t, at))};
}

Shot edge_ulps(Random& random) {
  const Triangle t = random_triangle(random);
  const Target at = {0.5 + 0.5 * random.unit(), 0};
  return {t, from_to(random_origin(random), point(t, at))};
}

Shot geometry(Family family, Random& random) {
  switch (family) {
    case Family::random: return random_shot(random);
    case Family::small_far: return small_far(random);
    case Family::lattice_points: return lattice_shot(random);
    case Family::exact_edge12: return exact_edge(random, 12);
    case Family::exact_edge23: return exact_edge(random, 23);
    case Family::exact_edge51: return exact_edge(random, 51);
    case Family::ulp12: return one_ulp_off(random, exact_edge(random, 12));
    case Family::ulp51: return one_ulp_off(random, exact_edge(random, 51));
    case Family::coplanar: return coplanar(random);
    case Family::degenerate: return degenerate(random);
    case Family::mixed40: return mixed40(random);
    case Family::wide: return wide(random);
    case Family::wide_edge: return wide_edge(random);
    case Family::full_range: return full_range(random);
    case Family::sliver: return sliver(random);
    case Family::far: return far(random);
    case Family::grazing: return grazing(random);
    case Family::tiny: return scaled(aimed(random, random_triangle(random)), 0x1p-66);
    case Family::huge: return scaled(aimed(random, random_triangle(random)), 0x1p+59);
    case Family::edge_ulps: return edge_ulps(random);
  }
  return {};
}

}  // namespace

Shot draw(Family family, std::uint64_t seed, std::uint64_t index) {
  Random random(seed, index);
  Shot s = geometry(family, random);
  draw_range(random, s.ray);
  return s;
}

}  // namespace plumbline
