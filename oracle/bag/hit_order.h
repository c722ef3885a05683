// Which of two triangles a ray meets first, exactly.
#pragma once
#include <compare>

#include "case/query.h"
#include "oracle/truth.h"

namespace plumbline {

/// A triangle that the line through a ray crosses: its class is interior, edge or vertex.
struct Crossed {
  const Triangle& triangle;
  const Truth& truth;
};

/// The order of the exact t; equal where they are exactly equal.
std::strong_ordering compare_t(const Crossed& x, const Crossed& y, const Query& query);

/// An interval that holds t: centre +- radius. Not known where the binary64 arithmetic can't tell: radius is infinite.
struct RoughT {
  double centre, radius;
};

/// Of a triangle that the line crosses. Round to nearest, no FTZ or DAZ.
RoughT rough_t(const Triangle& triangle, const Query& query);

}  // namespace plumbline
