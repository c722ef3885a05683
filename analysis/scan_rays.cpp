#include "analysis/scan_rays.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "case/float_bits.h"
#include "case/input_error.h"
#include "case/precision.h"
#include "case/random.h"

namespace plumbline {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Vec3 plus(const Vec3& p, const Vec3& q) { return {p.x + q.x, p.y + q.y, p.z + q.z}; }
Vec3 minus(const Vec3& p, const Vec3& q) { return {p.x - q.x, p.y - q.y, p.z - q.z}; }
Vec3 times(double k, const Vec3& p) { return {k * p.x, k * p.y, k * p.z}; }
double dot(const Vec3& p, const Vec3& q) { return p.x * q.x + p.y * q.y + p.z * q.z; }
Vec3 cross(const Vec3& p, const Vec3& q) {
  return {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
}

double largest(const Vec3& v) { return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}); }

// By the power of two that makes `size` one, nearly: squares of it neither over- nor underflow.
Vec3 near_one(const Vec3& v, double size) {
  const int down = size == 0 ? 0 : -std::ilogb(size);
  return {std::ldexp(v.x, down), std::ldexp(v.y, down), std::ldexp(v.z, down)};
}

double length(const Vec3& v) {
  const double size = largest(v);
  const Vec3 near = near_one(v, size);
  return size == 0 ? 0 : std::ldexp(std::sqrt(dot(near, near)), std::ilogb(size));
}

void check_room(const Mesh& mesh) {
  const auto beyond =
      std::ranges::find_if_not(mesh.vertices, [&](const Vec3& v) { return has_room(v, mesh.precision); });
  if (beyond == mesh.vertices.end()) return;
  throw InputError(fmt::format("vertex {} of the mesh is so far out that rays around it overflow {}; scale it down",
                               beyond - mesh.vertices.begin(), name(mesh.precision)));
}

// |N|^2 / (longest edge)^4: the square of twice the area over that of the longest edge, and so of altitude / edge.
double thinness(const Triangle& t) {
  Vec3 e1 = minus(t.b, t.a), e2 = minus(t.c, t.a), e3 = minus(t.c, t.b);
  const double size = std::max({largest(e1), largest(e2), largest(e3)});
  for (Vec3* e : {&e1, &e2, &e3}) *e = near_one(*e, size);
  const Vec3 n = cross(e1, e2);
  const double longest2 = std::max({dot(e1, e1), dot(e2, e2), dot(e3, e3)});
  return size == 0 ? 0 : dot(n, n) / longest2 / longest2;
}

double turned(Random& random, double x, Precision precision) { return step_ulps(x, random.integer(-1, 1), precision); }

// In degrees; exact where they are whole quarters.
struct Turn {
  double cosine, sine;
  explicit Turn(double degrees) {
    const double quarters = degrees / 90;
    if (quarters == std::floor(quarters)) {
      constexpr std::array<double, 4> cosines = {1, 0, -1, 0};
      const auto turn = static_cast<std::size_t>(((std::fmod(quarters, 4)) + 4)) % 4;
      cosine = cosines[turn];
      sine = cosines[(turn + 3) % 4];
    } else {
      cosine = std::cos(degrees * std::numbers::pi / 180);
      sine = std::sin(degrees * std::numbers::pi / 180);
    }
  }
};

}  // namespace

// Origins lie in a box twice as large as the mesh's, at most 3 times the limit away; directions are at most 4 times it.
bool has_room(const Vec3& point, Precision precision) {
  return largest(point) <= (precision == Precision::binary32 ? 0x1p+125 : 0x1p+1021);
}

ScanRays::ScanRays(const Mesh& mesh, std::uint64_t seed)
    : mesh_(mesh), seed_(seed), low_{infinity, infinity, infinity}, high_{-infinity, -infinity, -infinity} {
  check_room(mesh);
  for (const Corners& corners : mesh.triangles) {
    for (const std::uint32_t corner : corners) {
      const Vec3& v = mesh.vertices[corner];
      low_ = {std::min(low_.x, v.x), std::min(low_.y, v.y), std::min(low_.z, v.z)};
      high_ = {std::max(high_.x, v.x), std::max(high_.y, v.y), std::max(high_.z, v.z)};
    }
  }
  std::vector<std::pair<double, std::uint32_t>> by_thinness;
  by_thinness.reserve(mesh.triangles.size());
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i)
    if (const double thin = thinness(triangle_at(mesh, i)); thin > 0) by_thinness.emplace_back(thin, i);
  const std::size_t thinnest =
      std::max<std::size_t>(by_thinness.size() / 64, std::min<std::size_t>(by_thinness.size(), 1));
  std::ranges::partial_sort(by_thinness, by_thinness.begin() + static_cast<std::ptrdiff_t>(thinnest));
  for (std::size_t i = 0; i < thinnest; ++i) slivers_.push_back(by_thinness[i].second);
}

Ray ScanRays::ray(ScanAim aim, std::uint64_t index) const {
  Random random(seed_, index * scan_aim_names.size() + static_cast<unsigned>(aim));
  const auto fraction = [&] { return 0.5 + 0.5 * random.unit(); };
  // In the box, or in one twice as large around it.
  const auto anywhere = [&](double size) {
    const auto between = [&](double low, double high) {
      const double middle = 0.5 * low + 0.5 * high, half = 0.5 * high - 0.5 * low;
      return middle + size * half * random.unit();
    };
    const double x = between(low_.x, high_.x), y = between(low_.y, high_.y), z = between(low_.z, high_.z);
    return Vec3{x, y, z};
  };
  const auto any_triangle = [&] {
    return triangle_at(mesh_, static_cast<std::uint32_t>(random.below(mesh_.triangles.size())));
  };
  Vec3 origin = anywhere(2), target;
  bool turn = false;
  switch (aim) {
    case ScanAim::uniform:
      target = anywhere(1);
      break;
    case ScanAim::edge: {
      const Triangle t = any_triangle();
      target = plus(t.a, times(fraction(), minus(t.b, t.a)));
      turn = random.chance(2);
      break;
    }
    case ScanAim::vertex:
      target = any_triangle().c;
      turn = random.chance(2);
      break;
    case ScanAim::sliver: {
      if (slivers_.empty()) {
        target = anywhere(1);
        break;
      }
      const Triangle t = triangle_at(mesh_, slivers_[random.below(slivers_.size())]);
      const double u = fraction(), v = fraction() * (1 - u);
      target = plus(t.a, plus(times(u, minus(t.b, t.a)), times(v, minus(t.c, t.a))));
      break;
    }
    case ScanAim::silhouette: {
      const Triangle t = any_triangle();
      target = plus(t.a, times(fraction(), minus(t.b, t.a)));
      // From within the plane: a combination of two sides, as long as the mesh is large.
      const Vec3 along = plus(times(random.unit(), minus(t.b, t.a)), times(random.unit(), minus(t.c, t.a)));
      const double size = length(along), reach = length(minus(high_, low_));
      if (size > 0) origin = minus(target, times(reach / size, along));
      break;
    }
  }
  const Precision precision = mesh_.precision;
  target = at_precision(target, precision);
  origin = at_precision(origin, precision);
  Vec3 direction = at_precision(minus(target, origin), precision);
  if (turn) {
    direction.x = turned(random, direction.x, precision);
    direction.y = turned(random, direction.y, precision);
    direction.z = turned(random, direction.z, precision);
  }
  if (direction == Vec3{}) direction.z = 1;  // the origin is the target
  return {.origin = origin, .direction = direction};
}

ShotlineGrid::ShotlineGrid(const Mesh& mesh, double azimuth, double elevation, double cell)
    : precision_(mesh.precision), cell_(cell) {
  check_room(mesh);
  if (!(cell > 0) || !is_finite(cell))
    throw InputError(fmt::format("a grid of shotlines with cells of {}: name a positive length", cell));
  if (!is_finite(azimuth) || !is_finite(elevation))
    throw InputError(
        fmt::format("a grid of shotlines from azimuth {}, elevation {}: name angles in degrees", azimuth, elevation));
  const Turn a(azimuth), e(elevation);
  eye_ = {a.cosine * e.cosine, a.sine * e.cosine, e.sine};
  across_ = {-a.sine, a.cosine, 0};
  up_ = {-a.cosine * e.sine, -a.sine * e.sine, e.cosine};
  double right = -infinity, top = -infinity;
  left_ = bottom_ = infinity;
  front_ = -infinity;
  for (const Corners& corners : mesh.triangles) {
    for (const std::uint32_t corner : corners) {
      const Vec3& v = mesh.vertices[corner];
      left_ = std::min(left_, dot(v, across_));
      right = std::max(right, dot(v, across_));
      bottom_ = std::min(bottom_, dot(v, up_));
      top = std::max(top, dot(v, up_));
      front_ = std::max(front_, dot(v, eye_));
    }
  }
  front_ += std::max({right - left_, top - bottom_, cell});
  const double columns = std::max(1.0, std::ceil((right - left_) / cell)),
               rows = std::max(1.0, std::ceil((top - bottom_) / cell));
  if (!(columns * rows <= 1e9))
    throw InputError(
        fmt::format("a grid of {:.0f} x {:.0f} shotlines with cells of {}: take larger cells", columns, rows, cell));
  left_ = 0.5 * (left_ + right) - 0.5 * columns * cell;  // what the cells have over is shared between both sides
  bottom_ = 0.5 * (bottom_ + top) - 0.5 * rows * cell;
  columns_ = static_cast<std::uint64_t>(columns);
  rows_ = static_cast<std::uint64_t>(rows);
}

Ray ShotlineGrid::ray(std::uint64_t index) const {
  const double h = left_ + (static_cast<double>(index % columns_) + 0.5) * cell_;
  const double v = bottom_ + (static_cast<double>(index / columns_) + 0.5) * cell_;
  const Vec3 origin = plus(times(front_, eye_), plus(times(h, across_), times(v, up_)));
  return {.origin = at_precision(origin, precision_), .direction = at_precision(times(-1, eye_), precision_)};
}

}  // namespace plumbline
