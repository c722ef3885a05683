// The numbers of a meeting: t, u, v as exact fractions and correctly rounded.
#pragma once
#include <array>
#include <optional>
#include <string>

#include "case/query.h"

namespace plumbline {

/// Rounded once, straight from the exact rational, to nearest, ties to even. A value beyond the format's range is an
/// infinity.
template <class Real>
struct Coordinates {
  Real t, u, v;  ///< u: barycentric weight of b; v: of c
};

/// No value where det == 0 (parallel, coplanar, degenerate) or the case is invalid. Real is float or double.
template <class Real>
std::optional<Coordinates<Real>> measure(const Triangle& triangle, const Query& query);

/// origin + t * direction, each component rounded once, straight from its exact rational (not from the rounded t). There
/// where measure is.
template <class Real>
std::optional<std::array<Real, 3>> hit_point(const Triangle& triangle, const Query& query);

/// t as "p/q" in lowest terms, q > 0.
std::optional<std::string> exact_t(const Triangle& triangle, const Query& query);

}  // namespace plumbline
