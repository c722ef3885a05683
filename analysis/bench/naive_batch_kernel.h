// The kernel of naive_batch.h, W cases at a time. Included only by the files that compile it for an instruction set.
#pragma once
#include "analysis/bench/naive_batch.h"
#include "oracle/lanes.h"

namespace plumbline {
namespace {

template <int W>
class NaiveKernel {
  using L = Lanes<W>;
  using Real = typename L::Real;
  struct Vec {
    Real x, y, z;
  };

  static Vec minus(const Vec& p, const Vec& q) { return {p.x - q.x, p.y - q.y, p.z - q.z}; }
  static Vec cross(const Vec& p, const Vec& q) {
    return {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
  }
  static Real dot(const Vec& p, const Vec& q) { return p.x * q.x + p.y * q.y + p.z * q.z; }

  struct Corners {
    Vec a, ab, ac;
  };
  struct Rays {
    Vec origin, direction;
    Real t_min, t_max;
  };

  // det == 0 makes u, v and t infinite or NaN: a comparison fails.
  static unsigned hits(const Corners& triangle, const Rays& ray) {
    const Vec p = cross(ray.direction, triangle.ac), from_a = minus(ray.origin, triangle.a);
    const Vec q = cross(from_a, triangle.ab);
    const Real inverse = 1.0 / dot(triangle.ab, p);
    const Real u = dot(from_a, p) * inverse, v = dot(ray.direction, q) * inverse, t = dot(triangle.ac, q) * inverse;
    return L::bits((u >= 0.0) & (v >= 0.0) & (u + v <= 1.0) & (t >= ray.t_min) & (t <= ray.t_max));
  }

  template <class Column>
  static Corners corners(Column column) {
    const Vec a{column(0), column(1), column(2)};
    return {a, minus({column(3), column(4), column(5)}, a), minus({column(6), column(7), column(8)}, a)};
  }

  template <class TriangleAt>
  static void run(const Batch& batch, TriangleAt triangle_at, std::uint8_t* out) {
    for (std::size_t i = 0; i < batch.size; i += W) {
      const auto ray = [&](std::size_t k) { return L::load(batch.ray[k] + i); };
      const Rays rays{{ray(0), ray(1), ray(2)}, {ray(3), ray(4), ray(5)}, ray(6), ray(7)};
      *out++ = static_cast<std::uint8_t>(hits(triangle_at(i), rays));
    }
  }

 public:
  static void run(const Batch& batch, std::uint8_t* out) {
    if (batch.one_triangle) {
      const Corners one = corners([&](std::size_t k) { return L::all(batch.triangle[k][0]); });
      run(
          batch, [&](std::size_t) { return one; }, out);
    } else {
      run(
          batch, [&](std::size_t i) { return corners([&](std::size_t k) { return L::load(batch.triangle[k] + i); }); },
          out);
    }
  }
};

}  // namespace
}  // namespace plumbline
