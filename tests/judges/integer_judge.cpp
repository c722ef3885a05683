#include "tests/judges/integer_judge.h"

#include <algorithm>
#include <utility>

namespace plumbline::judges {
namespace {

using Int = std::int64_t;

IntVec sub(const IntVec& x, const IntVec& y) { return {x[0] - y[0], x[1] - y[1], x[2] - y[2]}; }
Int dot(const IntVec& x, const IntVec& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }
IntVec cross(const IntVec& x, const IntVec& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}
Int triple(const IntVec& x, const IntVec& y, const IntVec& z) { return dot(x, cross(y, z)); }
bool zero(const IntVec& x) { return x == IntVec{}; }
signed char sign(Int x) { return static_cast<signed char>((x > 0) - (x < 0)); }

// numerator / denominator >= quarters / 4, denominator > 0
bool at_least(Int numerator, Int denominator, Int quarters) { return 4 * numerator >= quarters * denominator; }
bool at_most(Int numerator, Int denominator, Int quarters) { return 4 * numerator <= quarters * denominator; }

// Point x = (4 o + quarters d) / 4 in the closed triangle or segment; everything times 4.
bool covers(const IntVec& a, const IntVec& b, const IntVec& c, const IntVec& n, const IntVec& x4) {
  const auto from = [&](const IntVec& p) { return IntVec{x4[0] - 4 * p[0], x4[1] - 4 * p[1], x4[2] - 4 * p[2]}; };
  if (!zero(n)) {
    return dot(n, from(a)) == 0 && triple(n, sub(b, a), from(a)) >= 0 && triple(n, sub(c, b), from(b)) >= 0 &&
           triple(n, sub(a, c), from(c)) >= 0;
  }
  const auto between = [&](const IntVec& p, const IntVec& q) {
    return zero(cross(sub(q, p), from(p))) && dot(from(p), from(q)) <= 0;
  };
  return between(a, b) || between(b, c) || between(c, a);
}

// The ray stays in the plane (or meets the segment): does the part within the range meet the figure? Either an end of
// the range lies in it, or the part crosses one of the sides.
bool touches(const IntVec& a, const IntVec& b, const IntVec& c, const IntVec& n, const IntVec& o, const IntVec& d,
             Int t_min, Int t_max) {
  if (t_min > t_max) return false;
  const auto at = [&](Int q) { return IntVec{4 * o[0] + q * d[0], 4 * o[1] + q * d[1], 4 * o[2] + q * d[2]}; };
  if (covers(a, b, c, n, at(t_min)) || covers(a, b, c, n, at(t_max))) return true;
  const std::array<std::pair<const IntVec*, const IntVec*>, 3> sides = {{{&a, &b}, {&b, &c}, {&c, &a}}};
  for (const auto& [p, q] : sides) {
    const IntVec to_p = sub(*p, o), side = sub(*q, *p), k = cross(d, side);
    const Int k2 = dot(k, k), d2 = dot(d, d);
    if (zero(cross(to_p, d)) && at_least(dot(to_p, d), d2, t_min) && at_most(dot(to_p, d), d2, t_max)) return true;
    if (k2 == 0 || dot(to_p, k) != 0) continue;
    const Int s = dot(cross(to_p, d), k), t = dot(cross(to_p, side), k);
    if (s >= 0 && s <= k2 && at_least(t, k2, t_min) && at_most(t, k2, t_max)) return true;
  }
  return false;
}

}  // namespace

Judged integer_judged(const IntVec& a, const IntVec& b, const IntVec& c, const IntVec& o, const IntVec& d, Int t_min,
                      Int t_max) {
  Judged judged;
  Truth& truth = judged.truth;
  if (zero(d)) {
    truth.invalid = Invalid::zero_direction;
    return judged;
  }
  const IntVec n = cross(sub(b, a), sub(c, a));
  const Int det = dot(d, n), T = dot(sub(a, o), n);
  truth.det_sign = sign(det);
  if (det == 0) {
    truth.hit_class = zero(n) ? HitClass::degenerate : T == 0 ? HitClass::coplanar : HitClass::parallel;
    judged.touches = truth.hit_class != HitClass::parallel && touches(a, b, c, n, o, d, t_min, t_max);
    return judged;
  }
  const IntVec pa = sub(a, o), pb = sub(b, o), pc = sub(c, o);
  const int ab = sign(triple(d, pa, pb)) * truth.det_sign, bc = sign(triple(d, pb, pc)) * truth.det_sign,
            ca = sign(triple(d, pc, pa)) * truth.det_sign;
  const int zeros = (ab == 0) + (bc == 0) + (ca == 0);
  if (std::min({ab, bc, ca}) < 0) {
    truth.hit_class = HitClass::exterior;
    return judged;
  }
  if (zeros == 0) {
    truth.hit_class = HitClass::interior;
  } else if (zeros == 1) {
    truth.hit_class = HitClass::edge;
    truth.feature = ab == 0 ? Feature::ab : bc == 0 ? Feature::bc : Feature::ca;
  } else {
    truth.hit_class = HitClass::vertex;
    truth.feature = bc != 0 ? Feature::a : ca != 0 ? Feature::b : Feature::c;
  }
  truth.versus_t_min = static_cast<signed char>(sign(4 * T - t_min * det) * truth.det_sign);
  truth.versus_t_max = static_cast<signed char>(sign(4 * T - t_max * det) * truth.det_sign);
  return judged;
}

}  // namespace plumbline::judges
