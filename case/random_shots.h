// What random shots are put together from. Private to the families (hard_families.cpp, dials.cpp): the sequence of random
// numbers is part of their contracts.
#pragma once
#include <array>
#include <cmath>
#include <cstdint>

#include "case/hard_families.h"
#include "case/random.h"

namespace plumbline::shots {

template <class Draw>
inline Vec3 vector(Draw draw) {
  const double x = draw(), y = draw(), z = draw();
  return {x, y, z};
}

// Exact for small multiples of one grid.
inline Vec3 add(const Vec3& p, const Vec3& q) { return {p.x + q.x, p.y + q.y, p.z + q.z}; }
inline Vec3 subtract(const Vec3& p, const Vec3& q) { return {p.x - q.x, p.y - q.y, p.z - q.z}; }
inline Vec3 scale(double k, const Vec3& p) { return {k * p.x, k * p.y, k * p.z}; }

inline std::array<double*, 15> coordinates(Shot& s) {
  Triangle& t = s.triangle;
  Ray& r = s.ray;
  return {&t.a.x, &t.a.y, &t.a.z, &t.b.x, &t.b.y, &t.b.z, &t.c.x, &t.c.y, &t.c.z,
          &r.origin.x, &r.origin.y, &r.origin.z, &r.direction.x, &r.direction.y, &r.direction.z};
}

// P is the midpoint of AB (or A itself, one in four), the ray goes from O to P: |coordinates| < 2^bits grid units.
inline Shot exact_edge(Random& random, int bits) {
  const std::int64_t reach = (std::int64_t{1} << (bits - 2)) - 1;
  const double grid = std::ldexp(1.0, -bits);
  const auto coordinate = [&] { return static_cast<double>(random.integer(-reach, reach)) * grid; };
  const Vec3 a = vector(coordinate), p = vector(coordinate), c = vector(coordinate), o = vector(coordinate);
  const Vec3 b = subtract(add(p, p), a);
  const std::array<Vec3, 3> corner = {a, b, c};
  const std::uint64_t turn = random.bits();
  return {{corner[turn % 3], corner[(turn + 1) % 3], corner[(turn + 2) % 3]}, {o, subtract(random.chance(4) ? a : p, o)}};
}

// In this order: that of a call's arguments is the compiler's choice.
inline double spread(Random& random, int binades) {
  const double significand = random.unit();
  return std::ldexp(significand, static_cast<int>(random.integer(-binades, binades)));
}

// The weights of b and c in the point that a ray is aimed at.
struct Target {
  double u, v;
};

inline Target near_inside(Random& random) { return {0.25 + 0.5 * random.unit(), 0.25 + 0.5 * random.unit()}; }

inline Vec3 point(const Triangle& t, const Target& at) {
  return add(t.a, add(scale(at.u, subtract(t.b, t.a)), scale(at.v, subtract(t.c, t.a))));
}

inline Triangle random_triangle(Random& random) {
  const auto unit = [&] { return random.unit(); };
  const Vec3 a = vector(unit), b = vector(unit), c = vector(unit);
  return {a, b, c};
}

inline Ray from_to(const Vec3& origin, const Vec3& target) { return {origin, subtract(target, origin)}; }

inline Vec3 random_origin(Random& random) {
  return scale(2, vector([&] { return random.unit(); }));
}

inline Shot aimed(Random& random, const Triangle& triangle) {
  const Target at = near_inside(random);
  return {triangle, from_to(random_origin(random), point(triangle, at))};
}

inline Shot scaled(Shot s, double factor) {
  for (Vec3* p : {&s.triangle.a, &s.triangle.b, &s.triangle.c, &s.ray.origin}) *p = scale(factor, *p);
  return s;
}

}  // namespace plumbline::shots
