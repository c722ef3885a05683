// The truth by the formulas as they stand (classify.h), in a number type that is exact: +, -, * and comparison with 0.
#pragma once
#include <array>
#include <cmath>
#include <cstddef>

#include "case/geometry.h"
#include "oracle/truth.h"

namespace plumbline {

/// Class and feature of a line that crosses the closed triangle, by which of the edges' lines it meets: at most two.
inline void set_crossing(Truth& truth, bool ab, bool bc, bool ca) {
  constexpr std::array features = {Feature::none, Feature::ab, Feature::bc, Feature::b,
                                   Feature::ca,   Feature::a,  Feature::c};
  static_assert(static_cast<int>(HitClass::edge) == 1 && static_cast<int>(HitClass::vertex) == 2);
  truth.hit_class = static_cast<HitClass>(ab + bc + ca);
  truth.feature = features[static_cast<std::size_t>(ab + 2 * bc + 4 * ca)];
}

template <class Number>
struct DirectVec {
  Number x, y, z;

  explicit DirectVec(const Vec3& v) : x(v.x), y(v.y), z(v.z) {}
  DirectVec(const Number& i, const Number& j, const Number& k) : x(i), y(j), z(k) {}
  friend DirectVec operator-(const DirectVec& p, const DirectVec& q) { return {p.x - q.x, p.y - q.y, p.z - q.z}; }
  bool is_zero() const { return x == 0 && y == 0 && z == 0; }
};

template <class Number>
DirectVec<Number> cross(const DirectVec<Number>& p, const DirectVec<Number>& q) {
  return {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
}

template <class Number>
Number dot(const DirectVec<Number>& p, const DirectVec<Number>& q) {
  return p.x * q.x + p.y * q.y + p.z * q.z;
}

/// All coordinates are finite, and no bound of the range is a NaN.
template <class Number>
Truth direct_formula(const Triangle& triangle, const Ray& ray) {
  using Vec = DirectVec<Number>;
  const auto sign = [](const Number& x) { return (x > 0) - (x < 0); };
  const Vec d(ray.direction), pa(triangle.a);
  Truth truth;
  if (d.is_zero()) {
    truth.invalid = Invalid::zero_direction;
    return truth;
  }
  const Vec a = pa - Vec(ray.origin), e1 = Vec(triangle.b) - pa, e2 = Vec(triangle.c) - pa, n = cross(e1, e2);
  const Number det = dot(d, n);
  const int side = sign(det);
  truth.det_sign = static_cast<signed char>(side);
  if (side == 0) {
    truth.hit_class = n.is_zero() ? HitClass::degenerate : dot(a, n) == 0 ? HitClass::coplanar : HitClass::parallel;
    return truth;
  }
  const Vec h = cross(d, a);
  const Number w_ab = dot(e1, h), w_ca = -dot(e2, h), w_bc = det - w_ca - w_ab;
  const int ab = side * sign(w_ab), bc = side * sign(w_bc), ca = side * sign(w_ca);
  if (ab < 0 || bc < 0 || ca < 0) {
    truth.hit_class = HitClass::exterior;
    return truth;
  }
  set_crossing(truth, ab == 0, bc == 0, ca == 0);

  const Number T = dot(a, n);
  const auto versus = [&](double tau) {
    if (std::isinf(tau)) return static_cast<signed char>(tau > 0 ? -1 : 1);
    const Number v = T - Number(tau) * det;
    return static_cast<signed char>(side * sign(v));
  };
  truth.versus_t_min = versus(ray.t_min);
  truth.versus_t_max = versus(ray.t_max);
  return truth;
}

}  // namespace plumbline
