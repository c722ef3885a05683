// CGAL's interval arithmetic switches the rounding mode: this file alone is compiled with -frounding-math.
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include <cmath>

#include "analysis/bench/rivals/direct_formula.h"
#include "analysis/bench/rivals/rivals.h"

namespace plumbline {
namespace {

using Inexact = CGAL::Exact_predicates_inexact_constructions_kernel;
using Exact = CGAL::Exact_predicates_exact_constructions_kernel;

template <class Kernel>
typename Kernel::Point_3 point(const Vec3& v) {
  return {v.x, v.y, v.z};
}

template <class Kernel>
typename Kernel::Vector_3 vector(const Vec3& v) {
  return {v.x, v.y, v.z};
}

}  // namespace

// The signs of three volumes, exact ones of a line through the rounded point O + D.
Truth ask_epick_orientations(const Triangle& triangle, const Ray& ray) {
  const auto a = point<Inexact>(triangle.a), b = point<Inexact>(triangle.b), c = point<Inexact>(triangle.c);
  const auto o = point<Inexact>(ray.origin), q = o + vector<Inexact>(ray.direction);
  const int ab = CGAL::orientation(o, q, a, b), bc = CGAL::orientation(o, q, b, c), ca = CGAL::orientation(o, q, c, a);
  const bool some_left = ab > 0 || bc > 0 || ca > 0, some_right = ab < 0 || bc < 0 || ca < 0;
  Truth truth{.hit_class = HitClass::exterior};
  if (some_left != some_right) set_crossing(truth, ab == 0, bc == 0, ca == 0);
  return truth;
}

Truth ask_epeck_do_intersect(const Triangle& triangle, const Ray& ray) {
  const Exact::Triangle_3 closed(point<Exact>(triangle.a), point<Exact>(triangle.b), point<Exact>(triangle.c));
  const auto o = point<Exact>(ray.origin);
  const auto d = vector<Exact>(ray.direction);
  if (std::isinf(ray.t_max)) return hit_or_miss(CGAL::do_intersect(Exact::Ray_3(o, d), closed));
  return hit_or_miss(CGAL::do_intersect(Exact::Segment_3(o, o + Exact::FT(ray.t_max) * d), closed));
}

Truth ask_epeck_ft(const Triangle& triangle, const Ray& ray) { return direct_formula<Exact::FT>(triangle, ray); }

}  // namespace plumbline
