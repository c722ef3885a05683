// Lines in Plucker coordinates: the ray passes the three directed edges on the same side exactly when it goes through
// the triangle. Shoemake, "Plucker Coordinate Tutorial", Ray Tracing News 11(1), 1998; Jones, "Intersecting a Ray and a
// Triangle with Plucker Coordinates", Ray Tracing News 13(1), 2000.
//
// The edges' coordinates are prepared once per triangle, in world coordinates: the products grow with the distance to
// the world's origin, and so do the errors. (Embree's robust kernel moves the triangle to the ray's origin instead:
// another algorithm.) An edge and its reverse get exactly opposite numbers. Two-sided, zeros included; t from the
// plane.
#pragma once
#include <optional>
#include <string_view>

#include "float_tracer/kernel.h"

namespace plumbline::inline PLUMBLINE_KERNELS {

template <class Real>
struct Plucker {
  using Scalar = Real;
  static constexpr std::string_view name = "plucker";
  static constexpr std::string_view summary =
      "side of the ray against the three edges in Plucker coordinates, two-sided";
  static constexpr std::string_view source =
      "Shoemake, Plucker Coordinate Tutorial, RTN 11(1), 1998; Jones, RTN 13(1), 2000";

  /// The directed line through two points.
  struct Line {
    Vec<Real> direction, moment;
  };
  static Line line(const Vec<Real>& p, const Vec<Real>& q) { return {q - p, cross(p, q)}; }

  struct PreparedTriangle {
    explicit PreparedTriangle(const KernelTriangle<Real>& t)
        : a(t.a), normal(cross(t.b - t.a, t.c - t.a)), ab(line(t.a, t.b)), bc(line(t.b, t.c)), ca(line(t.c, t.a)) {}
    Vec<Real> a, normal;
    Line ab, bc, ca;
  };

  struct PreparedRay {
    explicit PreparedRay(const KernelRay<Real>& r) : ray(r), line{r.direction, cross(r.origin, r.direction)} {}
    KernelRay<Real> ray;
    Line line;
  };

  template <class Why = Unasked>
  static std::optional<KernelHit<Real>> intersect(const PreparedTriangle& triangle, const PreparedRay& r,
                                                  Why why = {}) {
    const Real wa = side(r.line, triangle.bc), wb = side(r.line, triangle.ca), wc = side(r.line, triangle.ab);
    const bool front = wa >= 0 && wb >= 0 && wc >= 0, back = wa <= 0 && wb <= 0 && wc <= 0;
    if (front == back)  // outside; or all three zero: the ray runs in the plane
      return missed_by([=] { return edge_against(wa, wb, wc); }, why);

    const Real slope = dot(triangle.normal, r.ray.direction);
    if (slope == 0) return missed_by(Rejection::parallel, why);
    const Real t = dot(triangle.normal, triangle.a - r.ray.origin) / slope;
    if (!r.ray.holds(t)) return missed_by(Rejection::t, why);
    const Real sum = wa + wb + wc;
    return KernelHit<Real>{t, wb / sum, wc / sum};
  }

 private:
  /// The permuted inner product: its sign says on which side the lines pass each other.
  static Real side(const Line& p, const Line& q) { return dot(p.direction, q.moment) + dot(q.direction, p.moment); }
};

}  // namespace plumbline::inline PLUMBLINE_KERNELS
