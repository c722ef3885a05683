// How near a case is to another answer, fast: what a search climbs on.
//
// Signs and truth are exact, in any rounding mode, with FTZ and DAZ. The doubles are within a relative 2^-40 of
// the exact values (margins.cpp tells why), but for values that are subnormal or infinite; a finding itself is
// measured by severity.h. A quarter to half a microsecond, for full doubles over 72 binades and a range that
// begins and ends at 0 or nowhere; any other case by way of GMP, a hundred times slower, its doubles rounded
// correctly.
#pragma once
#include <limits>
#include <optional>

#include "case/case.h"
#include "case/query.h"
#include "oracle/severity.h"
#include "oracle/truth.h"

namespace plumbline {

struct Margins {
  Truth truth;                         ///< as classify says
  signed char ab = 0, bc = 0, ca = 0;  ///< signs of w_AB, w_BC, w_CA times that of det
  bool hit = false;                    ///< crosses(truth)
  double severity = 0;                 ///< S (severity.h) of the answer that contradicts the truth, a length
  double ulp = 0;            ///< at the precision asked for, of the largest coordinate of O, A, B, C: a length
  double severity_ulps = 0;  ///< in units of that
  // The numbers whose fall below 2^-10 severity.h calls grazing, sliver, far.
  double sine = 0;      ///< of the angle between ray and plane
  double altitude = 0;  ///< the least altitude / the longest edge
  double size = 0;      ///< the longest edge / the largest coordinate
  double t = std::numeric_limits<double>::quiet_NaN(), u = t, v = t, w = t;  ///< w: of a; NaN where det == 0
  // What an error of 1 in t, u, v, w is worth, as a length: how far it moves the point out of the plane, or how
  // far the ray has to be moved for u, v or w to change by 1. 0 where det == 0.
  double t_scale = 0, u_scale = 0, v_scale = 0, w_scale = 0;

  Condition condition() const {
    return {.grazing = sine < 0x1p-10, .sliver = altitude < 0x1p-10, .far = size < 0x1p-10};
  }
};

/// No value where the case is invalid, the triangle has no area, the range is empty, or the ray runs in the
/// plane and touches the triangle within its range (which is open: contact.h).
std::optional<Margins> margins(const Triangle& triangle, const Query& query, Precision precision);

}  // namespace plumbline
