// Moller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", Journal of Graphics Tools 2(1), 1997: solves
// origin + t d = (1 - u - v) a + u b + v c by Cramer's rule.
//
// The paper's two-sided branch, with u >= 0, v >= 0, u + v <= 1. The paper rejects |det| < 1e-6, a length cubed, so
// that what counts as parallel depends on the unit of length; here only det == 0 is rejected.
#pragma once
#include <optional>
#include <string_view>

#include "float_tracer/kernel.h"

namespace plumbline::inline PLUMBLINE_KERNELS {

template <class Real>
struct MollerTrumbore {
  using Scalar = Real;
  static constexpr std::string_view name = "moller_trumbore";
  static constexpr std::string_view summary = "Cramer's rule, two-sided, no epsilon: only det == 0 is parallel";
  static constexpr std::string_view source =
      "Moller and Trumbore, Fast, Minimum Storage Ray/Triangle Intersection, JGT 2(1), 1997";

  struct PreparedTriangle {
    explicit PreparedTriangle(const KernelTriangle<Real>& t) : a(t.a), ab(t.b - t.a), ac(t.c - t.a) {}
    Vec<Real> a, ab, ac;
  };
  using PreparedRay = KernelRay<Real>;

  template <class Why = Unasked>
  static std::optional<KernelHit<Real>> intersect(const PreparedTriangle& triangle, const PreparedRay& ray,
                                                  Why why = {}) {
    const Vec<Real> p = cross(ray.direction, triangle.ac);
    const Real det = dot(triangle.ab, p);
    if (det == 0) return missed_by(Rejection::parallel, why);
    const Real inverse = 1 / det;

    const Vec<Real> from_a = ray.origin - triangle.a;
    const Real u = dot(from_a, p) * inverse;
    if (!(u >= 0 && u <= 1)) return missed_by([=] { return !(u >= 0) ? Rejection::ca : Rejection::bc; }, why);

    const Vec<Real> q = cross(from_a, triangle.ab);
    const Real v = dot(ray.direction, q) * inverse;
    if (!(v >= 0 && u + v <= 1)) return missed_by([=] { return !(v >= 0) ? Rejection::ab : Rejection::bc; }, why);

    const Real t = dot(triangle.ac, q) * inverse;
    if (!ray.holds(t)) return missed_by(Rejection::t, why);
    return KernelHit<Real>{t, u, v};
  }
};

}  // namespace plumbline::inline PLUMBLINE_KERNELS
