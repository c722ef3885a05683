// One ray and one triangle in exact numbers, with the determinants that decide everything. Private to the oracle.
#pragma once
#include <optional>

#include "case/query.h"
#include "oracle/dyadic.h"

namespace plumbline::exact {

/// With a = A-O, h = D x a: det = D.N, T = a.N, t = T/det, w_AB = e1.h, w_CA = -(e2.h), w_BC = det - w_CA - w_AB,
/// u = w_CA/det, v = w_AB/det.
struct ExactCase {
  /// The case is not invalid.
  ExactCase(const Triangle& triangle, const Query& query);

  Vec origin, direction, a, b, c;
  Vec e1, e2, normal;  ///< B-A, C-A, e1 x e2
  Dyadic det, T, w_ab, w_bc, w_ca;

  Quotient t() const { return {T, det}; }     ///< det != 0
  Quotient u() const { return {w_ca, det}; }  ///< det != 0
  Quotient v() const { return {w_ab, det}; }  ///< det != 0
};

/// A closed interval of t; no value = unbounded on that side.
struct Interval {
  std::optional<Quotient> low, high;
};

/// The finite t of [t_min, t_max]; no value where there are none.
std::optional<Interval> range(const Ray& ray);
bool contains(const Interval& interval, const Quotient& t);

/// For det == 0: the t at which the line is in the closed triangle, a point or a segment of the line; no value where it
/// nowhere is. Where the triangle has no area, it is the segment or point that its vertices span.
std::optional<Interval> contact(const ExactCase& exact);

/// contact, cut by the range.
std::optional<Interval> contact_in_range(const ExactCase& exact, const Ray& ray);

}  // namespace plumbline::exact
