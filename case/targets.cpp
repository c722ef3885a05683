#include "case/targets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "case/input_error.h"

namespace plumbline {
namespace {

Vec3 operator+(const Vec3& p, const Vec3& q) { return {p.x + q.x, p.y + q.y, p.z + q.z}; }
Vec3 operator-(const Vec3& p, const Vec3& q) { return {p.x - q.x, p.y - q.y, p.z - q.z}; }
Vec3 operator*(double s, const Vec3& p) { return {s * p.x, s * p.y, s * p.z}; }
Vec3 operator/(const Vec3& p, double s) { return {p.x / s, p.y / s, p.z / s}; }

Vec3 cross(const Vec3& p, const Vec3& q) {
  return {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
}
double length(const Vec3& p) { return std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z); }

Vec3 middle(const Vec3& p, const Vec3& q) { return (p + q) / 2; }

Vec3 towards(const Vec3& p, const Vec3& q, double n) {
  const double m = length(q - p) - n;
  return (m * p + n * q) / (m + n);
}

Vec3 beyond(const Vec3& p, const Vec3& q, double n) {
  const double m = length(q - p) + n;
  return (m * p - n * q) / (m - n);
}

Vec3 direction_of(const Triangle& t, Normal normal) {
  const Vec3 w = cross(t.b - t.a, t.c - t.a);
  switch (normal) {
    case Normal::divide: return w / length(w);
    case Normal::reciprocal: return (1 / length(w)) * w;
    case Normal::none: break;
  }
  return w;
}

}  // namespace

void check(const Aiming& aiming) {
  if (!(aiming.standoff > 0) || !std::isfinite(aiming.standoff))
    throw InputError(fmt::format("standoff {}: not positive and finite; give a distance such as 5", aiming.standoff));
  for (const double n : aiming.tolerances)
    if (!(n > 0) || !std::isfinite(n))
      throw InputError(fmt::format("tolerance {}: not positive and finite; give a distance such as 0.001", n));
}

std::vector<Aim> aims(const Aiming& aiming) {
  std::vector<Aim> list;
  const auto add = [&](std::size_t count, TargetKind target, std::optional<double> tolerance, Wish wish) {
    std::fill_n(std::back_inserter(list), count, Aim{target, tolerance, aiming.standoff, wish});
  };
  add(4, TargetKind::interior, {}, Wish::hit);
  add(6, TargetKind::vertex_edge, {}, Wish::hit);
  for (const double n : aiming.tolerances) {
    add(6, TargetKind::tolerance, n, Wish::hit);
    add(6, TargetKind::tolerance, n, Wish::miss);
    add(3, TargetKind::tolerance, n, Wish::hit);
    add(3, TargetKind::tolerance, n, Wish::miss);
  }
  return list;
}

void aim_rays(const Triangle& triangle, const Aiming& aiming, std::span<Ray> rays) {
  const auto& [a, b, c] = triangle;
  const Vec3 ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
  const Vec3 direction = direction_of(triangle, aiming.normal);
  std::size_t next = 0;
  const auto aim_at = [&](const Vec3& target) {
    rays[next++] = {.origin = target - aiming.standoff * direction, .direction = direction};
  };

  aim_at((a + b + c) / 3);
  for (const Vec3& median : {middle(a, bc), middle(b, ca), middle(c, ab)}) aim_at(median);
  for (const Vec3& target : {a, b, c, ab, bc, ca}) aim_at(target);

  struct Line {
    const Vec3 &from, &to;
  };
  const std::array<Line, 6> edges = {{{a, b}, {a, c}, {b, a}, {b, c}, {c, a}, {c, b}}};
  const std::array<Line, 3> medians = {{{bc, a}, {ca, b}, {ab, c}}};
  for (const double n : aiming.tolerances) {
    for (const Line& edge : edges) aim_at(towards(edge.from, edge.to, n));
    for (const Line& edge : edges) aim_at(beyond(edge.from, edge.to, n));
    for (const Line& median : medians) aim_at(towards(median.from, median.to, n));
    for (const Line& median : medians) aim_at(beyond(median.from, median.to, n));
  }
}

}  // namespace plumbline
