// What BRL-CAD's prep makes of a "bag of triangles" (BoT) of one face, and its constants. Lengths in millimetres.
//
// BRL-CAD 7.22 to 7.40.2 (the "classic" triangle arithmetic), checked bit for bit against answers recorded from 7.24.2
// (corpus/recorded) and, where one is found, against the library itself (float_tracer/adapters/brlcad.h). All of it is
// binary64 with one rounding per operation; the order of operations counts.
#pragma once
#include <optional>

#include "case/case.h"
#include "float_tracer/vec.h"

namespace plumbline::brlcad {

using Vector = Vec<double>;

inline constexpr double distance_tolerance = 0.0005;  ///< the default that librt is run with
inline constexpr double least_slope = 1e-9;           ///< |direction . normal| below this is parallel

struct Box {
  Vector low, high;
};

struct Face {
  Vector a, ab, ac;
  Vector cross;        ///< ab x ac, not normalised
  Vector unit_normal;  ///< nearly: a cross product of nearly unit length is kept as it is
};

/// A BoT of one face. Of the orientation only whether there is one counts: it turns the normals' signs, on which no
/// answer for one face depends.
struct Solid {
  Face face;
  Box face_box;   ///< of the vertices
  double margin;  ///< of the classic triangle test. An oriented solid's: a 1e7th of half its box's longest side
  Box model_box;  ///< what the ray walk starts from: whole numbers, a thickness not counted
  BagMode mode;
  Orientation orientation;
  double thickness;
  PlatePosition position;
  bool cosine;
};

/// Empty if BRL-CAD drops the face as degenerate: an edge shorter than the tolerance, or |ab x ac| (twice the area!)
/// less than the tolerance, so that any face of less than 0.00025 mm^2 is lost. `bag` holds one triangle.
std::optional<Solid> prepare_solid(const Bag& bag);

}  // namespace plumbline::brlcad
