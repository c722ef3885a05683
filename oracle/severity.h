// How wrong a wrong answer is: the length of the least translation of the ray, direction fixed, after which the answer
// would be true.
//
// Answer hit, truth miss: the distance between the ray (its t range included) and the closed triangle.
// Answer miss, truth hit: the least of the distances to the three edge lines, w_i^2 / |e_i x D|^2, and, per finite end
// tau of the range, to the plane there, (T - tau det)^2 / |N|^2.
// S^2 is rational and kept exact; S is rounded correctly from it. A one-ulp quibble and a gross error never look alike,
// but naive maximisation drifts to grazing rays and slivers, so S comes with its condition.
#pragma once
#include <optional>

#include "case/case.h"
#include "case/query.h"

namespace plumbline {

/// Which of the three condition numbers are below 2^-10; none of them: nominal.
struct Condition {
  bool grazing = false;  ///< sin(ray, plane) < 2^-10
  bool sliver = false;   ///< least altitude / longest edge < 2^-10
  bool far = false;      ///< longest edge / largest coordinate of O, A, B, C < 2^-10
  bool nominal() const { return !grazing && !sliver && !far; }
  friend bool operator==(const Condition&, const Condition&) = default;
};

struct Severity {
  double length = 0;  ///< S in world units, correctly rounded to binary64
  double ulps = 0;    ///< S in units in the last place, at `precision`, of the largest coordinate of O, A, B, C
  Condition condition;
};

/// The severity of answering `answered_hit` where the truth is otherwise. No value where the triangle has no area, the
/// case is invalid, the range is empty, or the answer is true (also: where the truth is open, coplanar contact).
std::optional<Severity> severity(const Triangle& triangle, const Query& query, bool answered_hit, Precision precision);

/// Whether a translation of the ray by at most slack_absolute + slack_relative * longest edge makes it hit the closed
/// triangle, exactly; true of a ray that meets it as it is, false where the triangle has no area or the range no t. Both
/// slacks are finite and >= 0.
bool within_slack(const Triangle& triangle, const Query& query, double slack_absolute, double slack_relative);

}  // namespace plumbline
