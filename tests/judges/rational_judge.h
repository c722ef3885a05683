// An independent judge: Boost's cpp_rational, and other formulas than the oracle's. The plane point comes first, then
// its barycentric coordinates in a coordinate plane; contact is decided by trying every t at which it could begin.
#pragma once
#include <boost/multiprecision/cpp_int.hpp>

#include "case/geometry.h"
#include "tests/judges/judged.h"

namespace plumbline::judges {

using Rational = boost::multiprecision::cpp_rational;

struct RationalMeeting : Judged {
  Rational t, u, v;  ///< where det_sign != 0
};

RationalMeeting rational_meeting(const Triangle& triangle, const Ray& ray);

/// Whether `rounded` is x rounded to nearest, ties to even, in Real's format: decided by comparing x with the midpoints
/// to both neighbours.
template <class Real>
bool is_rounded(const Rational& x, Real rounded);

/// Whether `rounded` (>= 0) is the correctly rounded square root of x2: the same comparison, squared.
bool is_rounded_sqrt(const Rational& x2, double rounded);

/// S^2 by brute force (see severity.h): the least over all pairs of features, each in exact rationals.
/// answered_hit: squared distance between the ray, its range included, and the closed triangle; otherwise the squared
/// depth of the hit. The triangle has area and the range is not empty.
Rational squared_severity(const Triangle& triangle, const Ray& ray, bool answered_hit);

}  // namespace plumbline::judges
