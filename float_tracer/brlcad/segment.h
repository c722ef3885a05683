// From a hit on the face to the piece of the ray inside the solid that BRL-CAD reports.
#pragma once
#include <optional>

#include "float_tracer/brlcad/solid.h"

namespace plumbline::brlcad {

/// Parameters along the ray.
struct Segment {
  double in, out;
};

/// The piece around or behind a hit at t. A surface, or a solid without orientation, has no thickness: in = out = t. A
/// plate has; with `cosine`, the ray's way through it. Of an oriented solid a lone face is the entry without the exit,
/// or the exit without the entry, and is dropped; it is neither, and kept, if unit normal . direction is 0 (cancelled,
/// or a normal too long to be scaled to unit length) or a NaN.
std::optional<Segment> segment_at(const Solid& solid, const Vector& direction, double t);

/// What the weaving of segments into partitions leaves of one: an `in` within 0.0005 of the origin snaps to it, nearly
/// equal ends become equal, and what does not reach 0.0005 beyond the origin is dropped. A plate around the origin is
/// kept, with in < 0, a piece with a NaN dropped. (BRL-CAD snaps `out` as well, but whatever ends there is dropped
/// anyway.)
std::optional<Segment> weave(Segment segment);

}  // namespace plumbline::brlcad
