// How far off the numbers of a hit are, measured exactly: what stability tables and figures are made of.
#pragma once
#include <array>
#include <optional>

#include "case/case.h"
#include "case/query.h"

namespace plumbline {

/// What a tracer says of where a ray hits; no value where it tells none.
struct HitNumbers {
  std::optional<double> t;
  std::optional<std::array<double, 2>> uv;
};

/// NaN where there is no number to measure; infinite where the number isn't finite.
struct HitErrors {
  /// In ulps, at the precision, of the exact value; where that is 0, in units of the least normal number.
  double t, u, v;
  double t_off, u_off, v_off;  ///< the same, absolute
  // Lengths in ulps of the largest coordinate of origin and vertices, at the precision.
  double point;     ///< from a + u e1 + v e2 to where the ray meets the plane
  double residual;  ///< from origin + t direction to the plane
  /// The same of that point as a program has it, each product and sum rounded to the precision: so far from its own
  /// triangle begins a ray that goes on from there.
  double start;
};

/// Each correctly rounded to binary64 from its exact value. No value where det == 0 or the case is invalid.
std::optional<HitErrors> hit_errors(const Triangle& triangle, const Query& query, const HitNumbers& said,
                                    Precision precision);

}  // namespace plumbline
