// How BRL-CAD's ray walk enters a model. The ray is moved to the box of the cell it enters and 0.0005 beyond, and every
// later test starts from the moved, rounded origin. A model of one solid is one cell, its box the model's, unless the
// solid comes in pieces (cells.h).
#pragma once
#include <cmath>
#include <optional>
#include <utility>

#include "float_tracer/brlcad/solid.h"
#include "float_tracer/rejection.h"

namespace plumbline::brlcad {

inline constexpr double look_back = 2.0;  ///< a ray that starts inside the box is moved back by no more

/// A ray as the walk takes it.
struct Line {
  Vector origin;
  Vector direction;  ///< as given, components of at most 1e-39 set to zero
  Vector inverse;    ///< of the components; infinity for zero

  Line(const Vector& origin, const Vector& direction);
};

/// The ray's way through a box, as parameters.
struct Span {
  double near, far;
};

/// Of the whole line; the NaN of 0 * infinity changes nothing.
inline std::optional<Span> slab_test(const Box& box, const Vector& origin, const Vector& inverse) {
  constexpr double zero_inverse = 1e-77;  // of a component: up to here the component counts as none
  constexpr double largest_parameter = 1e73;
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

/// Whether the point lies past the box, seen along the ray.
bool left_behind(const Box& box, const Vector& point, const Vector& direction);

struct Entry {
  Vector point;      ///< the moved origin
  Vector direction;  ///< Line::direction
  double moved;      ///< by this parameter along the direction
  double box_near;   ///< where the ray enters the box, as seen from `point`: mostly a little behind it
};

/// Into a model of one cell. Empty if the walk ends before any triangle is tested: the ray misses the model's box, or
/// the nudge of 0.0005 has taken it out again. So every ray whose way through the box is shorter than that is lost,
/// even if it hits squarely. `why` is told which: Rejection::box or nudge.
std::optional<Entry> enter(const Box& model_box, const Vector& origin, const Vector& direction,
                           Rejection* why = nullptr);

}  // namespace plumbline::brlcad
