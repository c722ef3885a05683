#include "oracle/program_point.h"

namespace plumbline {
namespace {

// This file is compiled without contraction.
template <class Real>
double advanced(double origin, double direction, double t) {
  return static_cast<Real>(origin) + static_cast<Real>(t) * static_cast<Real>(direction);
}

template <class Real>
double mixed(double a, double b, double c, double u, double v) {
  const Real at = static_cast<Real>(a), e1 = static_cast<Real>(b) - at, e2 = static_cast<Real>(c) - at;
  return at + static_cast<Real>(u) * e1 + static_cast<Real>(v) * e2;
}

}  // namespace

Vec3 point_at(const Ray& ray, double t, Precision precision) {
  const auto at = precision == Precision::binary32 ? advanced<float> : advanced<double>;
  const Vec3 &o = ray.origin, &d = ray.direction;
  return {at(o.x, d.x, t), at(o.y, d.y, t), at(o.z, d.z, t)};
}

Vec3 point_at(const Triangle& triangle, double u, double v, Precision precision) {
  const auto at = precision == Precision::binary32 ? mixed<float> : mixed<double>;
  const auto& [a, b, c] = triangle;
  return {at(a.x, b.x, c.x, u, v), at(a.y, b.y, c.y, u, v), at(a.z, b.z, c.z, u, v)};
}

}  // namespace plumbline
