// Baldwin and Weber, "Fast Ray-Triangle Intersections by Coordinate Transformation", Journal of Computer Graphics
// Techniques 5(3), 2016: per triangle the affine map that takes a, b, c to (0,0,0), (1,0,0), (0,1,0); per ray t where
// the mapped ray meets z = 0, and the mapped hit point is (u, v).
//
// The map's third basis vector is the coordinate axis of the normal's largest component, as in the paper, so that the
// column of that axis is (0, 0, 1). Two-sided; u >= 0, v >= 0, u + v <= 1. The paper has no test for a parallel ray or
// a triangle without area: a division by zero gives an infinity or a NaN, and the comparisons fail.
#pragma once
#include <optional>
#include <string_view>

#include "float_tracer/kernel.h"

namespace plumbline::inline PLUMBLINE_KERNELS {

template <class Real>
struct BaldwinWeber {
  using Scalar = Real;
  static constexpr std::string_view name = "baldwin_weber";
  static constexpr std::string_view summary = "per-triangle transformation to barycentric coordinates, two-sided";
  static constexpr std::string_view source =
      "Baldwin and Weber, Fast Ray-Triangle Intersections by Coordinate Transformation, JCGT 5(3), 2016";

  /// A row of the affine map.
  struct Row {
    Vec<Real> linear;
    Real shift;
    Real of_point(const Vec<Real>& p) const { return dot(linear, p) + shift; }
    Real of_direction(const Vec<Real>& d) const { return dot(linear, d); }
  };

  struct PreparedTriangle {
    explicit PreparedTriangle(const KernelTriangle<Real>& t) {
      const Vec<Real> ab = t.b - t.a, ac = t.c - t.a, n = cross(ab, ac);
      const int k = largest_axis(n), i = next_axis(k), j = next_axis(i);
      u.linear[i] = ac[j] / n[k];
      u.linear[j] = -ac[i] / n[k];
      u.linear[k] = 0;
      u.shift = cross(t.c, t.a)[k] / n[k];
      v.linear[i] = -ab[j] / n[k];
      v.linear[j] = ab[i] / n[k];
      v.linear[k] = 0;
      v.shift = -cross(t.b, t.a)[k] / n[k];
      z.linear[i] = n[i] / n[k];
      z.linear[j] = n[j] / n[k];
      z.linear[k] = 1;
      z.shift = -dot(n, t.a) / n[k];
    }
    Row u, v, z;
  };
  using PreparedRay = KernelRay<Real>;

  template <class Why = Unasked>
  static std::optional<KernelHit<Real>> intersect(const PreparedTriangle& map, const PreparedRay& ray,
                                                  Why why = {}) {
    const Real t = -map.z.of_point(ray.origin) / map.z.of_direction(ray.direction);
    if (!ray.holds(t)) return missed_by(Rejection::t, why);
    const Real u = map.u.of_point(ray.origin) + t * map.u.of_direction(ray.direction);
    const Real v = map.v.of_point(ray.origin) + t * map.v.of_direction(ray.direction);
    if (!(u >= 0 && v >= 0 && u + v <= 1))
      return missed_by([=] { return !(u >= 0) ? Rejection::ca : !(v >= 0) ? Rejection::ab : Rejection::bc; }, why);
    return KernelHit<Real>{t, u, v};
  }
};

}  // namespace plumbline::inline PLUMBLINE_KERNELS
