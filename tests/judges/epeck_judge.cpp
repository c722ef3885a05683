#include "tests/judges/epeck_judge.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include <cmath>

namespace plumbline::judges {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;

Point point(const Vec3& v) { return {v.x, v.y, v.z}; }

signed char versus(const Point& o, const Vector& d, const Point& a, const Point& b, const Point& c, int det, double bound) {
  if (std::isinf(bound)) return bound > 0 ? -1 : 1;
  // The plane lies before the point at t = bound, or behind it.
  return static_cast<signed char>(det * CGAL::orientation(o + Kernel::FT(bound) * d, a, b, c));
}

template <class Target>
bool meets(const Point& o, const Vector& d, const Ray& ray, const Target& target) {
  const bool starts = std::isfinite(ray.t_min), ends = std::isfinite(ray.t_max);
  const auto at = [&](double t) { return o + Kernel::FT(t) * d; };
  if (starts && ends) {
    if (ray.t_min > ray.t_max) return false;
    if (ray.t_min == ray.t_max) return CGAL::do_intersect(at(ray.t_min), target);
    return CGAL::do_intersect(Kernel::Segment_3(at(ray.t_min), at(ray.t_max)), target);
  }
  if ((!starts && ray.t_min > 0) || (!ends && ray.t_max < 0)) return false;
  if (starts) return CGAL::do_intersect(Kernel::Ray_3(at(ray.t_min), d), target);
  if (ends) return CGAL::do_intersect(Kernel::Ray_3(at(ray.t_max), -d), target);
  return CGAL::do_intersect(Kernel::Line_3(o, d), target);
}

bool meets_degenerate(const Point& o, const Vector& d, const Ray& ray, const Point& a, const Point& b, const Point& c) {
  if (a == b && b == c) {
    const Kernel::Line_3 line(o, d);
    if (!line.has_on(a)) return false;
    const Kernel::FT t = CGAL::scalar_product(a - o, d) / d.squared_length();
    return !(std::isfinite(ray.t_min) ? t < Kernel::FT(ray.t_min) : ray.t_min > 0) &&
           !(std::isfinite(ray.t_max) ? t > Kernel::FT(ray.t_max) : ray.t_max < 0);
  }
  // The longest side is the one that the third vertex lies on.
  const Point &p = CGAL::collinear_are_ordered_along_line(a, c, b) || CGAL::collinear_are_ordered_along_line(a, b, c) ? a : b;
  const Point& q = CGAL::collinear_are_ordered_along_line(a, c, b) ? b : c;
  return meets(o, d, ray, Kernel::Segment_3(p, q));
}

}  // namespace

Judged epeck_judged(const Triangle& triangle, const Ray& ray) {
  Judged judged;
  Truth& truth = judged.truth;
  const Point a = point(triangle.a), b = point(triangle.b), c = point(triangle.c), o = point(ray.origin);
  const Vector d(ray.direction.x, ray.direction.y, ray.direction.z);
  const Point q = o + d;
  const int det = CGAL::orientation(a, b, c, a + d);
  truth.det_sign = static_cast<signed char>(det);
  if (CGAL::collinear(a, b, c)) {
    truth.hit_class = HitClass::degenerate;
    judged.touches = meets_degenerate(o, d, ray, a, b, c);
    return judged;
  }
  if (det == 0) {
    truth.hit_class = CGAL::coplanar(o, a, b, c) ? HitClass::coplanar : HitClass::parallel;
    judged.touches = truth.hit_class == HitClass::coplanar && meets(o, d, ray, Kernel::Triangle_3(a, b, c));
    return judged;
  }
  const int ab = det * CGAL::orientation(o, q, a, b), bc = det * CGAL::orientation(o, q, b, c),
            ca = det * CGAL::orientation(o, q, c, a);
  if (ab < 0 || bc < 0 || ca < 0) {
    truth.hit_class = HitClass::exterior;
    return judged;
  }
  if (ab == 0 && bc == 0) {
    truth.hit_class = HitClass::vertex, truth.feature = Feature::b;
  } else if (bc == 0 && ca == 0) {
    truth.hit_class = HitClass::vertex, truth.feature = Feature::c;
  } else if (ca == 0 && ab == 0) {
    truth.hit_class = HitClass::vertex, truth.feature = Feature::a;
  } else if (ab == 0 || bc == 0 || ca == 0) {
    truth.hit_class = HitClass::edge;
    truth.feature = ab == 0 ? Feature::ab : bc == 0 ? Feature::bc : Feature::ca;
  } else {
    truth.hit_class = HitClass::interior;
  }
  truth.versus_t_min = versus(o, d, a, b, c, det, ray.t_min);
  truth.versus_t_max = versus(o, d, a, b, c, det, ray.t_max);
  return judged;
}

}  // namespace plumbline::judges
