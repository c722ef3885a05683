#include "tests/judges/mpq_judge.h"

#include <array>
#include <cmath>

namespace plumbline::judges {
namespace {

using Vec = std::array<mpq_class, 3>;

Vec exact(const Vec3& v) { return {mpq_class(v.x), mpq_class(v.y), mpq_class(v.z)}; }
Vec add(const Vec& x, const Vec& y) { return {x[0] + y[0], x[1] + y[1], x[2] + y[2]}; }
Vec sub(const Vec& x, const Vec& y) { return {x[0] - y[0], x[1] - y[1], x[2] - y[2]}; }
mpq_class dot(const Vec& x, const Vec& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }
Vec cross(const Vec& x, const Vec& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}

signed char versus(const Determinants& x, double tau) {
  if (std::isinf(tau)) return tau > 0 ? -1 : 1;
  return static_cast<signed char>(sgn(x.T - mpq_class(tau) * x.det) * sgn(x.det));
}

}  // namespace

Determinants mpq_determinants(const Triangle& triangle, const Query& query) {
  const Vec o = exact(query.ray.origin), corner = exact(triangle.a);
  const Vec d = add(exact(query.ray.direction), exact(query.direction_tail));
  const Vec a = sub(corner, o), b = sub(exact(triangle.b), o), c = sub(exact(triangle.c), o);
  const Vec n = cross(sub(b, a), sub(c, a));
  Determinants x;
  x.det = dot(d, n);
  x.T = dot(a, n);
  x.w_ab = dot(d, cross(a, b));
  x.w_bc = dot(d, cross(b, c));
  x.w_ca = dot(d, cross(c, a));
  x.flat = n[0] == 0 && n[1] == 0 && n[2] == 0;
  return x;
}

Truth mpq_truth(const Triangle& triangle, const Query& query) {
  const Determinants x = mpq_determinants(triangle, query);
  const int s = sgn(x.det), ab = s * sgn(x.w_ab), bc = s * sgn(x.w_bc), ca = s * sgn(x.w_ca);
  Truth truth;
  truth.det_sign = static_cast<signed char>(s);
  if (s == 0) {
    truth.hit_class = x.flat ? HitClass::degenerate : x.T == 0 ? HitClass::coplanar : HitClass::parallel;
    return truth;
  }
  if (ab < 0 || bc < 0 || ca < 0) {
    truth.hit_class = HitClass::exterior;
    return truth;
  }
  truth.versus_t_min = versus(x, query.ray.t_min);
  truth.versus_t_max = versus(x, query.ray.t_max);
  const int zeros = (ab == 0) + (bc == 0) + (ca == 0);
  truth.hit_class = zeros == 0 ? HitClass::interior : zeros == 1 ? HitClass::edge : HitClass::vertex;
  if (zeros == 1) truth.feature = ab == 0 ? Feature::ab : bc == 0 ? Feature::bc : Feature::ca;
  if (zeros == 2) truth.feature = bc > 0 ? Feature::a : ca > 0 ? Feature::b : Feature::c;
  return truth;
}

}  // namespace plumbline::judges
