// From the hits on a BoT's faces to the pieces of the ray inside it: what BRL-CAD's shot function makes of its mode
// and orientation. The same rules from 7.22 to 7.44.
#pragma once
#include <cstdint>
#include <vector>

#include "case/answer.h"
#include "float_tracer/brlcad/solid.h"

namespace plumbline::brlcad {

struct Hit {
  double t;
  double slope;        ///< Solid::slope: the ray enters below 0, and leaves above
  std::uint32_t face;  ///< in the bag
};

/// Appends to `passages` what these hits, which are sorted by t, make up; `hits` is used up. "Together" is: nearer than
/// 0.0005.
/// - A surface has no thickness: a passage for each hit, in = out = t.
/// - A plate: a passage for each hit, around or behind it; with `cosine`, as long as the ray's way through the plate.
/// - A solid without orientation: a single hit is a passage without length. Otherwise, of hits together only the last
/// is
///   kept; if one is left, it's a miss; if an odd number is left and some were together, the last that stands for such
///   a group goes as well. Then they are paired in order, and an odd last one is dropped: on an edge inside the
///   object's silhouette, what should be entry and exit turns inside out from there.
/// - An oriented solid: of two together that both enter or both leave, the second is kept; of more, entries and exits
/// are
///   put in turn where their numbers up to there allow that, and otherwise one that goes on from the hit before and one
///   opposite are kept, or one of all alike. Then of consecutive entries the last is kept, of consecutive exits the
///   first (its own comment says the opposite); leading exits and trailing entries are dropped, so a lone face is never
///   hit. A hit of no slope (cancelled, or a normal too long to be scaled to unit length) or a NaN for it is neither
///   entry nor exit; if the number is odd for that, the last hit stands for entry and exit.
void add_passages(const Solid& solid, std::vector<Hit>& hits, std::vector<Passage>& passages);

}  // namespace plumbline::brlcad
