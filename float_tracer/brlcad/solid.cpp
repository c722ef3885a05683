#include "float_tracer/brlcad/solid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::brlcad {
namespace {

Vector unit_normal_of(const Vector& cross) {
  const double square = dot(cross, cross);
  if (std::abs(square - 1) < std::numeric_limits<float>::epsilon()) return cross;
  return (1 / std::sqrt(square)) * cross;
}

Box box_of(const Vector& a, const Vector& b, const Vector& c) {
  Box box{};
  for (int i = 0; i < 3; ++i) {
    box.low[i] = std::min({a[i], b[i], c[i]});
    box.high[i] = std::max({a[i], b[i], c[i]});
  }
  return box;
}

// A flat box is made a little thick.
Box thickened(Box box) {
  for (int i = 0; i < 3; ++i)
    if (box.high[i] - box.low[i] < distance_tolerance) {
      box.low[i] -= distance_tolerance;
      box.high[i] += distance_tolerance;
    }
  return box;
}

double half_longest_side(const Box& box) {
  return std::max({(box.high[0] - box.low[0]) / 2, (box.high[1] - box.low[1]) / 2, (box.high[2] - box.low[2]) / 2});
}

// Outwards to whole numbers. A coordinate that is a whole number already is not moved.
Box rounded(Box box) {
  for (int i = 0; i < 3; ++i) {
    box.low[i] = std::floor(box.low[i]);
    box.high[i] = std::ceil(box.high[i]);
  }
  return box;
}

}  // namespace

std::optional<Solid> prepare_solid(const Bag& bag) {
  const Triangle& triangle = bag.triangles.front();
  const Vector a = to_vec<double>(triangle.a), b = to_vec<double>(triangle.b), c = to_vec<double>(triangle.c);
  const Vector ab = b - a, ac = c - a, cb = b - c, ab_x_ac = cross(ab, ac);
  for (const Vector& v : {ab, ac, cb, ab_x_ac})
    if (dot(v, v) < distance_tolerance * distance_tolerance) return std::nullopt;

  const Box box = box_of(a, b, c), thick = thickened(box);
  const bool oriented_solid = bag.mode == BagMode::solid && bag.orientation != Orientation::none;
  return Solid{.face = {a, ab, ac, ab_x_ac, unit_normal_of(ab_x_ac)},
               .face_box = box,
               .margin = oriented_solid ? half_longest_side(thick) / 1e7 : 0,
               .model_box = rounded(thick),
               .mode = bag.mode,
               .orientation = bag.orientation,
               .thickness = bag.thickness,
               .position = bag.position,
               .cosine = bag.cosine};
}

}  // namespace plumbline::brlcad
