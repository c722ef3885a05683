#include "analysis/bench/naive_scalar.h"

namespace plumbline {
namespace {

Vec3 minus(const Vec3& p, const Vec3& q) { return {p.x - q.x, p.y - q.y, p.z - q.z}; }
Vec3 cross(const Vec3& p, const Vec3& q) {
  return {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
}
double dot(const Vec3& p, const Vec3& q) { return p.x * q.x + p.y * q.y + p.z * q.z; }

}  // namespace

bool naive_scalar(const Triangle& triangle, const Ray& ray) {
  const Vec3 ab = minus(triangle.b, triangle.a), ac = minus(triangle.c, triangle.a), p = cross(ray.direction, ac);
  const double det = dot(ab, p);
  if (det == 0) return false;
  const double inverse = 1 / det;
  const Vec3 from_a = minus(ray.origin, triangle.a);
  const double u = dot(from_a, p) * inverse;
  if (!(u >= 0 && u <= 1)) return false;
  const Vec3 q = cross(from_a, ab);
  const double v = dot(ray.direction, q) * inverse;
  if (!(v >= 0 && u + v <= 1)) return false;
  const double t = dot(ac, q) * inverse;
  return t >= ray.t_min && t <= ray.t_max;
}

}  // namespace plumbline
