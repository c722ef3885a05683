// How BRL-CAD's ray walk enters a model of one solid. The ray is moved to the model's box and 0.0005 beyond it, and
// every later test starts from the moved, rounded origin.
#pragma once
#include <optional>

#include "float_tracer/brlcad/solid.h"
#include "float_tracer/rejection.h"

namespace plumbline::brlcad {

struct Entry {
  Vector point;      ///< the moved origin
  Vector direction;  ///< as given, components of at most 1e-39 set to zero
  double moved;      ///< by this parameter along the direction
  double box_near;   ///< where the ray enters the model's box, as seen from `point`: mostly a little behind it
};

/// Empty if the walk ends before any triangle is tested: the ray misses the model's box, or the nudge of 0.0005 has
/// taken it out again. So every ray whose way through the box is shorter than that is lost, even if it hits squarely.
/// `why` is told which: Rejection::box or nudge.
std::optional<Entry> enter(const Box& model_box, const Vector& origin, const Vector& direction,
                           Rejection* why = nullptr);

}  // namespace plumbline::brlcad
