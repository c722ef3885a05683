// What BRL-CAD's prep makes of a "bag of triangles" (BoT), and its constants. Lengths in millimetres.
//
// BRL-CAD 7.22 to 7.40.2 (the "classic" triangle arithmetic), checked bit for bit against answers recorded from 7.24.2
// (corpus/recorded) and, where one is found, against the library itself (float_tracer/adapters/brlcad.h). All of it is
// binary64 with one rounding per operation; the order of operations counts.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "case/case.h"
#include "float_tracer/vec.h"

namespace plumbline::brlcad {

using Vector = Vec<double>;

inline constexpr double distance_tolerance = 0.0005;  ///< the default that librt is run with
inline constexpr double least_slope = 1e-9;           ///< |direction . normal| below this is parallel

/// Whether two parameters of a ray, or two coordinates, count as one; never of a NaN.
inline bool near(double x, double y) { return std::abs(x - y) < distance_tolerance; }

struct Box {
  Vector low, high;
};

/// Around nothing: grows to whatever is added.
Box empty_box();
void add(Box& box, const Vector& point);
void add(Box& box, const Box& other);

/// Of all vertices, also of faces that are dropped.
Box box_of(std::span<const Triangle> triangles);
/// A flat box is made a little thick.
Box thickened(Box box);
/// What the ray walk starts from: outwards to whole numbers. A coordinate that is a whole number already isn't moved.
Box model_box_of(const Box& box);
double half_longest_side(const Box& box);

struct Face {
  Vector a, ab, ac;
  Vector cross;         ///< ab x ac, not normalised
  Vector unit_normal;   ///< nearly: a cross product of nearly unit length is kept as it is
  std::uint32_t index;  ///< in the bag
};

struct Solid {
  std::vector<Face> faces;  ///< in the bag's order, those that are left
  BagMode mode;
  Orientation orientation;
  double thickness;
  PlatePosition position;
  bool cosine;

  bool oriented() const { return mode == BagMode::solid && orientation != Orientation::none; }
  /// direction . normal, of the unit normal that points outwards: below 0 the ray enters.
  double slope(const Face& face, const Vector& direction) const {
    const double along = dot(face.unit_normal, direction);
    return orientation == Orientation::cw ? -along : along;
  }
};

/// BRL-CAD drops faces as degenerate, one by one: an edge shorter than the tolerance, or |ab x ac| (twice the area!)
/// less than the tolerance, so that any face of less than 0.00025 mm^2 is lost.
Solid prepare_solid(const Bag& bag);

}  // namespace plumbline::brlcad
