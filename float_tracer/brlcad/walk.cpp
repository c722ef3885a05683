#include "float_tracer/brlcad/walk.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::brlcad {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double zero_component = 1e-39;  // of a direction: up to here it counts as zero
constexpr double zero_inverse = 1e-77;    // of a component: up to here the component counts as none
constexpr double largest_parameter = 1e73;

}  // namespace

Line::Line(const Vector& given_origin, const Vector& given_direction)
    : origin(given_origin), direction(given_direction), inverse{} {
  for (int i = 0; i < 3; ++i) {
    if (std::abs(direction[i]) <= zero_component) direction[i] = 0;
    inverse[i] = direction[i] == 0 ? infinity : 1 / direction[i];
  }
}

std::optional<Span> slab_test(const Box& box, const Vector& origin, const Vector& inverse) {
  double near = -largest_parameter, far = largest_parameter;
  for (int i = 0; i < 3; ++i) {
    if (std::abs(inverse[i]) <= zero_inverse) {
      if (box.low[i] > origin[i] || box.high[i] < origin[i]) return std::nullopt;
      continue;
    }
    double first = (box.low[i] - origin[i]) * inverse[i], last = (box.high[i] - origin[i]) * inverse[i];
    if (inverse[i] < 0) std::swap(first, last);
    if (first > near) near = first;
    if (last < far) far = last;
  }
  if (near > far) return std::nullopt;
  return Span{near, far};
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
