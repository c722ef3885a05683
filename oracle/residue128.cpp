#include "oracle/residue128.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "oracle/decoded.h"
#include "oracle/signs.h"

namespace plumbline {
namespace {

using Int = __int128;
using Word = unsigned __int128;  // modulo 2^128

// Differences and components of N fit their types up to here: differences below 2^(p+1), components of N below 2^(2p+3).
constexpr int max_point_bits = 61, max_direction_bits = 62;

enum class Sign : signed char { negative = -1, zero = 0, positive = 1, unknown = 2 };

// 2^n, -1022 <= n <= 1023, from its bits.
double power_of_two(int n) { return from_bits<double>(static_cast<std::uint64_t>(1023 + n) << 52); }

struct Span {
  int low = 1 << 16, high = -(1 << 16);
  void add(const Decoded& x) {
    if (x.significand == 0) return;
    low = std::min(low, x.low());
    high = std::max(high, x.high());
  }
  int bits() const { return high > low ? high - low : 0; }
};

std::int64_t scaled(const Decoded& x, int low) {
  if (x.significand == 0) return 0;
  const int shift = x.exponent - low;
  const auto magnitude = static_cast<std::int64_t>(shift >= 0 ? x.significand << shift : x.significand >> -shift);
  return x.negative ? -magnitude : magnitude;
}

struct Vec {
  std::int64_t x, y, z;
};
Vec operator-(const Vec& p, const Vec& q) { return {p.x - q.x, p.y - q.y, p.z - q.z}; }

// A cross product, exact, and in binary64.
struct Cross {
  Int x, y, z;
  double fx, fy, fz;
  Cross(const Vec& p, const Vec& q)
      : x(Int{p.y} * q.z - Int{p.z} * q.y),
        y(Int{p.z} * q.x - Int{p.x} * q.z),
        z(Int{p.x} * q.y - Int{p.y} * q.x) {
    const auto f = [](std::int64_t i) { return static_cast<double>(i); };
    fx = f(p.y) * f(q.z) - f(p.z) * f(q.y);
    fy = f(p.z) * f(q.x) - f(p.x) * f(q.z);
    fz = f(p.x) * f(q.y) - f(p.y) * f(q.x);
  }
};

// An integer by its residue, its binary64 value, and a bound of that value's error.
struct Known {
  Word residue;
  double value, error;
  Sign sign() const {
    if (std::fabs(value) > error) return value < 0 ? Sign::negative : Sign::positive;
    if (error > 0x1p+126) return Sign::unknown;
    // |exact| <= |value| + error <= 2^127; the bounds are twice the errors, so that equality cannot occur.
    const Int exact = static_cast<Int>(residue);
    return static_cast<Sign>((exact > 0) - (exact < 0));
  }
};
Known operator-(const Known& x, const Known& y) { return {x.residue - y.residue, x.value - y.value, x.error + y.error}; }
Known operator-(const Known& x) { return {-x.residue, -x.value, x.error}; }

// The error of a dot product of components below 2^p_bits with cross products of components below 2^q_bits and 2^r_bits:
// six terms; on each at most 3 conversions to binary64, 2 products and 3 sums, so 8 roundings of 2^-52 (the directed
// modes'): 48 * 2^-52 < 2^-46 of the largest term; doubled.
Known dot(const Vec& p, const Cross& q, int bits) {
  const auto wrap = [](std::int64_t i) { return static_cast<Word>(static_cast<Int>(i)); };
  return {wrap(p.x) * static_cast<Word>(q.x) + wrap(p.y) * static_cast<Word>(q.y) + wrap(p.z) * static_cast<Word>(q.z),
          static_cast<double>(p.x) * q.fx + static_cast<double>(p.y) * q.fy + static_cast<double>(p.z) * q.fz,
          power_of_two(bits - 45)};
}

// x * 2^shift, 0 <= shift <= 300.
Known shifted(const Known& x, int shift) {
  const double scale = power_of_two(shift);
  return {shift < 128 ? x.residue << shift : 0, x.value * scale, x.error * scale};
}

// x * m; the product of the values adds half a unit in the last place, 2^-52 in the directed modes, which is less than the
// half of x.error that is to spare (x.error >= 2^-45 of a bound of |x|).
Known times(const Known& x, std::int64_t m) {
  return {x.residue * static_cast<Word>(static_cast<Int>(m)), x.value * static_cast<double>(m),
          x.error * std::fabs(static_cast<double>(m))};
}

// sign(T - tau det), tau finite; T in units of 2^(3 low_p), det in 2^(2 low_p + low_d).
Sign versus(const Known& T, const Known& det, double tau, const Span& points, const Span& directions) {
  if (is_zero(tau)) return T.sign();
  const Decoded decoded(tau);
  const int trailing = std::countr_zero(decoded.significand);
  const auto m = static_cast<std::int64_t>(decoded.significand >> trailing) * (decoded.negative ? -1 : 1);
  // tau det = m det 2^shift in the unit of T; both terms are brought to the finer of the two units.
  const int shift = decoded.exponent + trailing + directions.low - points.low;
  if (shift > 300 || shift < -300) return Sign::unknown;
  return (shifted(T, std::max(-shift, 0)) - times(shifted(det, std::max(shift, 0)), m)).sign();
}

}  // namespace

std::optional<Truth> classify_residue128(const Triangle& triangle, const Ray& ray) {
  const auto decode = [](const Vec3& v) { return std::array{Decoded(v.x), Decoded(v.y), Decoded(v.z)}; };
  const auto o = decode(ray.origin), d = decode(ray.direction), a = decode(triangle.a), b = decode(triangle.b),
             c = decode(triangle.c);
  Span points, directions;
  for (std::size_t k = 0; k < 3; ++k) {
    for (const auto* v : {&o, &a, &b, &c}) points.add((*v)[k]);
    directions.add(d[k]);
  }
  const int p = points.bits(), n = directions.bits();
  if (p > max_point_bits || n > max_direction_bits) return std::nullopt;

  const auto integers = [](const std::array<Decoded, 3>& v, int low) {
    return Vec{scaled(v[0], low), scaled(v[1], low), scaled(v[2], low)};
  };
  const Vec O = integers(o, points.low), A = integers(a, points.low), B = integers(b, points.low),
            C = integers(c, points.low), D = integers(d, directions.low);
  const Vec to_a = A - O, e1 = B - A, e2 = C - A;
  const Cross normal(e1, e2), h(D, to_a);
  const int w_bits = 2 * (p + 1) + n, T_bits = 3 * (p + 1);
  const Known det = dot(D, normal, w_bits), T = dot(to_a, normal, T_bits);
  const Sign det_sign = det.sign();
  Truth truth;
  if (det_sign == Sign::unknown) return std::nullopt;
  truth.det_sign = static_cast<signed char>(det_sign);
  if (det_sign == Sign::zero) {
    const Sign T_sign = T.sign();
    if (normal.x == 0 && normal.y == 0 && normal.z == 0)
      truth.hit_class = HitClass::degenerate;
    else if (T_sign == Sign::unknown)
      return std::nullopt;
    else
      truth.hit_class = T_sign == Sign::zero ? HitClass::coplanar : HitClass::parallel;
    return truth;
  }
  const Known w_ab = dot(e1, h, w_bits), w_ca = -dot(e2, h, w_bits), w_bc = det - w_ca - w_ab;
  const Sign ab = w_ab.sign(), bc = w_bc.sign(), ca = w_ca.sign();
  if (ab == Sign::unknown || bc == Sign::unknown || ca == Sign::unknown) return std::nullopt;
  const int s = truth.det_sign;
  place(truth, static_cast<int>(ab) * s, static_cast<int>(bc) * s, static_cast<int>(ca) * s);
  if (truth.hit_class == HitClass::exterior) return truth;
  for (auto [tau, answer] : {std::pair{ray.t_min, &truth.versus_t_min}, std::pair{ray.t_max, &truth.versus_t_max}}) {
    if (!is_finite(tau)) {
      *answer = is_negative(tau) ? 1 : -1;
      continue;
    }
    const Sign v = versus(T, det, tau, points, directions);
    if (v == Sign::unknown) return std::nullopt;
    *answer = static_cast<signed char>(static_cast<int>(v) * s);
  }
  return truth;
}

}  // namespace plumbline
