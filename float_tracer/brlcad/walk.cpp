#include "float_tracer/brlcad/walk.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::brlcad {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double zero_component = 1e-39;  // of a direction: up to here it counts as zero

}  // namespace

Line::Line(const Vector& given_origin, const Vector& given_direction)
    : origin(given_origin), direction(given_direction), inverse{} {
  for (int i = 0; i < 3; ++i) {
    if (std::abs(direction[i]) <= zero_component) direction[i] = 0;
    inverse[i] = direction[i] == 0 ? infinity : 1 / direction[i];
  }
}

bool left_behind(const Box& box, const Vector& point, const Vector& direction) {
  for (int i = 0; i < 3; ++i) {
    if (direction[i] >= 0 && point[i] > box.high[i]) return true;
    if (direction[i] <= 0 && point[i] < box.low[i]) return true;
  }
  return false;
}

std::optional<Entry> enter(const Box& model_box, const Vector& origin, const Vector& direction, Rejection* why) {
  const Line line(origin, direction);
  const auto model = slab_test(model_box, origin, line.inverse);
  if (!model || model->far < 0) return missed_by(Rejection::box, why);

  const double moved = std::max(model->near, -look_back) + distance_tolerance;
  const Vector point = origin + moved * line.direction;
  if (left_behind(model_box, point, line.direction)) return missed_by(Rejection::nudge, why);
  const auto cell = slab_test(model_box, point, line.inverse);
  if (!cell || cell->far < 0) return missed_by(Rejection::nudge, why);
  return Entry{point, line.direction, moved, cell->near};
}

}  // namespace plumbline::brlcad
