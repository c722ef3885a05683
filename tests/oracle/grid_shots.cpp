#include "tests/oracle/grid_shots.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

namespace plumbline {
namespace {

__extension__ using Int = __int128;
using IntVec = std::array<Int, 3>;

// Towards zero, to the 53 bits of a double.
Int fit(Int x) {
  Int magnitude = x < 0 ? -x : x;
  int shift = 0;
  while (magnitude >> shift >= Int{1} << 53) ++shift;
  magnitude = magnitude >> shift << shift;
  return x < 0 ? -magnitude : magnitude;
}

Int extreme(Random& random, int bits) {
  const Int top = Int{1} << bits;
  Int x = 0;
  switch (random() % 8) {
    case 0:
    case 1:
      x = top - 1;
      break;
    case 2:
      x = top / 2;
      break;
    case 3:
      x = top / 2 + 1;
      break;
    case 4:
      x = 0x5555555555555555 & (top - 1);
      break;
    case 5:
      x = static_cast<Int>(random() % 3);
      break;
    default:
      x = static_cast<Int>(random()) & (top - 1);
  }
  x = std::min(x, top - 1);
  return fit(random() % 2 == 0 ? x : -x);
}

IntVec extreme_vector(Random& random, int bits) {
  IntVec v;
  for (Int& x : v) x = extreme(random, bits);
  return v;
}

template <class Combine>
IntVec each(Combine combine) {
  return {fit(combine(0u)), fit(combine(1u)), fit(combine(2u))};
}

bool below(const IntVec& v, int bits) {
  return std::ranges::all_of(v, [&](Int x) { return (x < 0 ? -x : x) < Int{1} << bits; });
}

struct Integers {
  IntVec o, d, a, b, c;
};

// The direction is a sum of the corners seen from the origin, with weights of which one or two may be zero.
void aim_by_weights(Random& random, Integers& s, int direction_bits, int point_bits) {
  const int room = std::clamp(direction_bits - point_bits - 3, 1, 31);
  std::array<Int, 3> k{};
  for (Int& weight : k) weight = uniform(random, 0, (std::int64_t{1} << room) - 1);
  k[random() % 3] = 0;
  if (random() % 2 == 0) k[random() % 3] = 0;
  s.d = each([&](auto i) { return k[0] * (s.a[i] - s.o[i]) + k[1] * (s.b[i] - s.o[i]) + k[2] * (s.c[i] - s.o[i]); });
}

// A and B lie on both sides of a point near the origin, as far apart as the width lets them.
void span_an_edge(Random& random, Integers& s, int point_bits, int direction_bits) {
  s.d = extreme_vector(random, direction_bits);
  const IntVec p = extreme_vector(random, std::max(1, point_bits - 2));
  s.o = each([&](auto i) { return p[i] - s.d[i]; });
  for (std::size_t i = 0; i < 3; ++i)
    if ((s.a[i] < 0) != (p[i] < 0)) s.a[i] = -s.a[i];
  s.b = each([&](auto i) { return 2 * p[i] - s.a[i]; });
}

Vec3 real(const IntVec& v) { return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])}; }

}  // namespace

void Width::add(const Vec3& v) {
  for (const double x : {v.x, v.y, v.z}) {
    if (x == 0) continue;
    int exponent;
    const double fraction = std::frexp(std::fabs(x), &exponent);
    const auto significand = static_cast<std::uint64_t>(std::ldexp(fraction, 53));
    high = std::max(high, exponent);
    low = std::min(low, exponent - 53 + std::countr_zero(significand));
  }
}

Width point_width(const Shot& shot) {
  Width w;
  for (const Vec3* v : {&shot.ray.origin, &shot.triangle.a, &shot.triangle.b, &shot.triangle.c}) w.add(*v);
  return w;
}

Width direction_width(const Shot& shot) {
  Width w;
  w.add(shot.ray.direction);
  return w;
}

Shot draw_on_grids(Random& random, int point_bits, int direction_bits) {
  const auto point = [&] { return extreme_vector(random, point_bits); };
  Integers s{point(), extreme_vector(random, direction_bits), point(), point(), point()};
  const Integers free = s;
  if (const auto kind = random() % 3; kind != 0) {
    if (kind == 1)
      aim_by_weights(random, s, direction_bits, point_bits);
    else
      span_an_edge(random, s, point_bits, direction_bits);
    if (random() % 3 == 0) (random() % 2 == 0 ? s.d : s.c)[random() % 3] += random() % 2 == 0 ? 1 : -1;
    if (!below(s.o, point_bits) || !below(s.b, point_bits) || !below(s.c, point_bits) || !below(s.d, direction_bits) ||
        s.d == IntVec{})
      s = free;
  }
  if (s.d == IntVec{}) s.d[random() % 3] = 1;
  const auto turn = random() % 3;
  const std::array<IntVec, 3> corner = {s.a, s.b, s.c};
  Shot shot{{real(corner[turn]), real(corner[(turn + 1) % 3]), real(corner[(turn + 2) % 3])}, {real(s.o), real(s.d)}};
  if (random() % 2 == 0) std::swap(shot.triangle.b, shot.triangle.c);
  for (Vec3* v : {&shot.triangle.a, &shot.triangle.b, &shot.triangle.c, &shot.ray.origin, &shot.ray.direction})
    for (double* x : {&v->x, &v->y, &v->z})
      if (*x == 0 && random() % 2 == 0) *x = -0.0;
  return shot;
}

Shot scaled(Shot shot, int points, int direction) {
  const auto scale = [](Vec3& v, int by) { v = {std::ldexp(v.x, by), std::ldexp(v.y, by), std::ldexp(v.z, by)}; };
  for (Vec3* v : {&shot.ray.origin, &shot.triangle.a, &shot.triangle.b, &shot.triangle.c}) scale(*v, points);
  scale(shot.ray.direction, direction);
  return shot;
}

}  // namespace plumbline
