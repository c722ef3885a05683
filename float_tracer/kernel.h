// What a ray/triangle kernel reads and says, in its own precision Real (float or double).
//
// A kernel is a class template over Real with
//   Scalar                           Real itself;
//   name, summary, source            the tracer's name without its precision, one sentence, the paper;
//   PreparedTriangle                 made from KernelTriangle<Real> once per triangle;
//   PreparedRay                      made from KernelRay<Real> once per ray;
//   intersect(triangle, ray, why)    std::optional<KernelHit<Real>>, empty for a miss, by a test that `why` is told:
//                                    a Rejection* or, by default, Unasked (rejection.h);
//   contract                         optional: where its promises are others than kernel_tracer.h's.
// Comparisons are written so that a NaN fails them: a kernel never hits because of a NaN.
#pragma once
#include "float_tracer/rejection.h"
#include "float_tracer/vec.h"

namespace plumbline::inline PLUMBLINE_KERNELS {

template <class Real>
struct KernelTriangle {
  Vec<Real> a, b, c;
};

template <class Real>
struct KernelRay {
  Vec<Real> origin, direction;
  Real t_min, t_max;

  /// Whether t lies in the closed range.
  constexpr bool holds(Real t) const { return t_min <= t && t <= t_max; }
};

template <class Real>
struct KernelHit {
  Real t;     ///< parameter along the ray
  Real u, v;  ///< weights of b and c
};

/// By which edge a kernel misses that tests the signs of bc, ca and ab all at once and finds them mixed, or a NaN
/// among them: the first of the three whose number is against their sum, the kernel's determinant. A zero is against
/// nothing, a NaN against all, and a sum of zero counts as positive. All zero: parallel.
template <class Real>
constexpr Rejection edge_against(Real bc, Real ca, Real ab) {
  const bool back = bc + ca + ab < 0;
  const auto against = [back](Real w) { return back ? !(w <= 0) : !(w >= 0); };
  return against(bc)   ? Rejection::bc
         : against(ca) ? Rejection::ca
         : against(ab) ? Rejection::ab
                       : Rejection::parallel;
}

}  // namespace plumbline::inline PLUMBLINE_KERNELS
