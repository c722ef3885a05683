#include "float_tracer/brlcad/solid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace plumbline::brlcad {
namespace {

Vector unit_normal_of(const Vector& cross) {
  const double square = dot(cross, cross);
  if (std::abs(square - 1) < std::numeric_limits<float>::epsilon()) return cross;
  return (1 / std::sqrt(square)) * cross;
}

std::optional<Face> face_of(const Triangle& triangle, std::uint32_t index) {
  const Vector a = to_vec<double>(triangle.a), b = to_vec<double>(triangle.b), c = to_vec<double>(triangle.c);
  const Vector ab = b - a, ac = c - a, cb = b - c, ab_x_ac = cross(ab, ac);
  for (const Vector& v : {ab, ac, cb, ab_x_ac})
    if (dot(v, v) < distance_tolerance * distance_tolerance) return std::nullopt;
  return Face{a, ab, ac, ab_x_ac, unit_normal_of(ab_x_ac), index};
}

}  // namespace

Box empty_box() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
}

void add(Box& box, const Vector& point) {
  for (int i = 0; i < 3; ++i) {
    box.low[i] = std::min(box.low[i], point[i]);
    box.high[i] = std::max(box.high[i], point[i]);
  }
}

void add(Box& box, const Box& other) {
  add(box, other.low);
  add(box, other.high);
}

Box box_of(std::span<const Triangle> triangles) {
  Box box = empty_box();
  for (const Triangle& t : triangles)
    for (const Vec3& v : {t.a, t.b, t.c}) add(box, to_vec<double>(v));
  return box;
}

Box thickened(Box box) {
  for (int i = 0; i < 3; ++i)
    if (box.high[i] - box.low[i] < distance_tolerance) {
      box.low[i] -= distance_tolerance;
      box.high[i] += distance_tolerance;
    }
  return box;
}

Box model_box_of(const Box& box) {
  Box rounded{};
  for (int i = 0; i < 3; ++i) {
    rounded.low[i] = std::floor(box.low[i]);
    rounded.high[i] = std::ceil(box.high[i]);
  }
  return rounded;
}

double half_longest_side(const Box& box) {
  return std::max({(box.high[0] - box.low[0]) / 2, (box.high[1] - box.low[1]) / 2, (box.high[2] - box.low[2]) / 2});
}

Solid prepare_solid(const Bag& bag) {
  Solid solid{.faces = {},
              .mode = bag.mode,
              .orientation = bag.orientation,
              .thickness = bag.thickness,
              .position = bag.position,
              .cosine = bag.cosine};
  for (std::uint32_t i = 0; i < bag.triangles.size(); ++i)
    if (const auto face = face_of(bag.triangles[i], i)) solid.faces.push_back(*face);
  return solid;
}

}  // namespace plumbline::brlcad
