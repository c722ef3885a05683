#include "oracle/margins.h"

#include <algorithm>
#include <cmath>

#include "oracle/exact_margins.h"
#include "oracle/largest.h"
#include "oracle/least_translation.h"
#include "oracle/signs.h"
#include "oracle/wide_case.h"

namespace plumbline {
namespace {

// A case as integers, which are made when they are first asked for.
class Integers {
 public:
  int point_unit, direction_unit;

  Integers(const Triangle& triangle, const Ray& ray)
      : point_unit(WideCase::unit(largest_coordinate(triangle, ray))),
        direction_unit(WideCase::unit(largest_magnitude(ray.direction))),
        triangle_(triangle),
        ray_(ray) {}

  /// Whether there are any, of finite coordinates. Seldom needs to make them: a double is a multiple of its
  /// ulp.
  bool exist() {
    const auto& [a, b, c] = triangle_;
    if (ulp_exponent(least_magnitude(ray_.origin, a, b, c)) >= point_unit &&
        ulp_exponent(least_magnitude(ray_.direction)) >= direction_unit)
      return true;
    made_ = WideCase::make(triangle_, ray_);
    return made_.has_value();
  }
  const WideCase& get() const {
    if (!made_) made_ = WideCase::make(triangle_, ray_);
    return *made_;
  }

 private:
  const Triangle& triangle_;
  const Ray& ray_;
  mutable std::optional<WideCase> made_;
};

// Rounded numbers beside the integers that they stand for, in units of the grids. So all that is not zero is at
// least 1 and below 2^512, and neither overflows nor underflows. u = 2^-52 in any rounding mode.
using Near = std::array<double, 3>;
double dot(const Near& x, const Near& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }
Near absolute(const Near& x) { return {std::abs(x[0]), std::abs(x[1]), std::abs(x[2])}; }

// A point, or the direction: rounding loses nothing.
struct Point {
  WideVec<2> WideCase::*integers;
  Near near;
  Point(WideVec<2> WideCase::*member, const Vec3& p, double scale)
      : integers(member), near{p.x * scale, p.y * scale, p.z * scale} {}
};

struct RoundedNumbers {
  // From one point to another, each component within u of it; or the direction.
  struct Vec {
    const Integers* integers;
    WideVec<2> WideCase::*from, WideCase::*to;
    Near near;
    double square;

    Vec(const Integers& of, const Point& p, const Point& q)
        : integers(&of),
          from(p.integers),
          to(q.integers),
          near{q.near[0] - p.near[0], q.near[1] - p.near[1], q.near[2] - p.near[2]},
          square(dot(near, near)) {}
    Vec(const Integers& of, const Point& direction)
        : integers(&of), from(nullptr), to(direction.integers), near(direction.near), square(dot(near, near)) {}

    WideVec<2> exact() const {
      const WideCase& x = integers->get();
      return from == nullptr ? x.*to : x.*to - x.*from;
    }
    Near bound() const { return absolute(near); }
  };
  // p x q, within 2^-42.9 of its length, each component within 4.1 u of its bound, the sum of the magnitudes of
  // its two products. As computed from rounded components it is that. Where the length is below 2^-7 of that of
  // the bounds the integers are asked, whose truncated components are within u; they are their own bounds then.
  struct Normal {
    const Vec *p, *q;
    Near near, bounds;
    double square;
    Normal(const Vec& first, const Vec& second) : p(&first), q(&second) {
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        const double plus = p->near[j] * q->near[k], minus = p->near[k] * q->near[j];
        near[i] = plus - minus;
        bounds[i] = std::abs(plus) + std::abs(minus);
      }
      square = dot(near, near);
      if (square >= 0x1p-14 * dot(bounds, bounds)) return;
      const WideVec<4>& n = exact();
      near = {truncated(n[0]), truncated(n[1]), truncated(n[2])};
      bounds = absolute(near);
      square = dot(near, near);
    }
    const WideVec<4>& exact() const {
      if (!exact_) exact_ = plumbline::cross(p->exact(), q->exact());
      return *exact_;
    }
    const Near& bound() const { return bounds; }

   private:
    mutable std::optional<WideVec<4>> exact_;
  };
  using Height = double;
  using Measure = double;
  static Normal cross(const Vec& x, const Vec& y) { return {x, y}; }
  static bool is_zero(const Normal& x) { return x.square == 0; }
  // A rounded product of two vectors, of either kind, is off by at most (2 * 4.1 + 3.1) u < 2^-48.4 of that of
  // their bounds.
  template <class Any>
  static int sign_of_dot(const Any& x, const Any& y) {
    const double product = dot(x.near, y.near);
    if (std::abs(product) > 0x1p-48 * dot(x.bound(), y.bound())) return product > 0 ? 1 : -1;
    return plumbline::dot(x.exact(), y.exact()).sign();
  }
  // x . y within 2^-41.9 and with its sign: off by at most (1 + 4.1 + 3.1) u < 2^-48.9 of the bounds. So the
  // quotient of two is within 2^-40.8, and that of one and a length within 2^-41.3.
  static double product(const Vec& x, const Normal& y) {
    const double product = dot(x.near, y.near);
    if (std::abs(product) > 0x1p-7 * dot(x.bound(), y.bound())) return product;
    return truncated(plumbline::dot(x.exact(), y.exact()));
  }
  static double length(const Vec& x) { return std::sqrt(x.square); }
  static double ratio(double x, const Normal& y) { return std::abs(x) / std::sqrt(y.square); }
  static double ratio(const Normal& x, const Vec& y) { return std::sqrt(x.square / y.square); }
};

int sign(double x) { return (x > 0 ? 1 : 0) - (x < 0 ? 1 : 0); }

double power_of_two(int n) {
  using F = FloatFormat<double>;
  return from_bits<double>(static_cast<std::uint64_t>(F::max_exponent + n) << F::fraction_bits);
}

// Where the largest coordinate is within 2^+-reach, no power of two below overflows or underflows, nor do t, u
// and v, whose integers are below 2^381 and whose units differ by at most 2^600.
constexpr int reach = 300;
bool in_reach(int unit) { return std::abs(unit + WideCase::bits) <= reach; }

// Bounds that are 0, or not there.
bool is_simple(const Ray& ray) {
  const bool low = is_zero(ray.t_min) || (std::isinf(ray.t_min) && is_negative(ray.t_min));
  return low && (is_zero(ray.t_max) || (std::isinf(ray.t_max) && !is_negative(ray.t_max)));
}

}  // namespace

std::optional<Margins> margins(const Triangle& triangle, const Query& query, Precision precision) {
  const Ray& ray = query.ray;
  if (query.has_tail() || !is_simple(ray)) return exact_margins(triangle, query, precision);
  Integers integers(triangle, ray);
  if (!in_reach(integers.point_unit) || !in_reach(integers.direction_unit) || !integers.exist())
    return exact_margins(triangle, query, precision);

  const double point_scale = power_of_two(-integers.point_unit);
  const Point o(&WideCase::origin, ray.origin, point_scale), a(&WideCase::a, triangle.a, point_scale),
      b(&WideCase::b, triangle.b, point_scale), c(&WideCase::c, triangle.c, point_scale),
      d(&WideCase::direction, ray.direction, power_of_two(-integers.direction_unit));
  using Numbers = RoundedNumbers;
  const Sight<Numbers> x{
      .direction = {integers, d},
      .to = {{{integers, o, a}, {integers, o, b}, {integers, o, c}}},
      .edge = {{{integers, a, b}, {integers, b, c}, {integers, c, a}}},
      .normal = {x.edge[2], x.edge[0]},  // (A-C) x (B-A) = (B-A) x (C-A)
      .across = {{{x.edge[0], x.direction}, {x.edge[1], x.direction}, {x.edge[2], x.direction}}},
      .w = {Numbers::product(x.to[0], x.across[0]), Numbers::product(x.to[1], x.across[1]),
            Numbers::product(x.to[2], x.across[2])}};
  const double det = Numbers::product(x.direction, x.normal), T = Numbers::product(x.to[0], x.normal);
  if (det == 0 && T == 0) return exact_margins(triangle, query, precision);  // coplanar, or no area

  Margins m;
  const bool ends_low = is_zero(ray.t_min), ends_high = is_zero(ray.t_max);
  const int det_sign = sign(det);
  m.truth.det_sign = static_cast<signed char>(det_sign);
  if (det_sign == 0) {
    m.truth.hit_class = HitClass::parallel;
  } else {
    const auto relative_sign = [det_sign](double k) { return static_cast<signed char>(sign(k) * det_sign); };
    m.ab = relative_sign(x.w[0]), m.bc = relative_sign(x.w[1]), m.ca = relative_sign(x.w[2]);
    place(m.truth, m.ab, m.bc, m.ca);
    if (m.truth.hit_class != HitClass::exterior) {
      m.truth.versus_t_min = ends_low ? relative_sign(T) : static_cast<signed char>(1);
      m.truth.versus_t_max = ends_high ? relative_sign(T) : static_cast<signed char>(-1);
    }
  }
  m.hit = crosses(m.truth);

  const RayEnd<Numbers> origin{.to = x.to, .height = T};
  const auto *low = ends_low ? &origin : nullptr, *high = ends_high ? &origin : nullptr;
  const double unit = power_of_two(integers.point_unit);
  m.severity = (m.hit ? depth(x, low, high) : distance(x, low, high)) * unit;

  const double largest = largest_coordinate(triangle, ray);
  const int ulp = ulp_exponent_at(largest, precision);
  m.ulp = power_of_two(ulp);
  m.severity_ulps = m.severity * power_of_two(-ulp);
  const double longest2 = std::max({x.edge[0].square, x.edge[1].square, x.edge[2].square});
  const double out_of_plane = Numbers::ratio(det, x.normal);
  m.sine = out_of_plane / std::sqrt(x.direction.square);
  m.altitude = std::sqrt(x.normal.square) / longest2;
  m.size = std::sqrt(longest2) / (largest * point_scale);
  if (det_sign == 0) return m;
  const double direction_unit = power_of_two(integers.direction_unit);
  m.t = T / det * (unit / direction_unit);
  m.u = x.w[2] / det;
  m.v = x.w[0] / det;
  m.w = x.w[1] / det;
  m.t_scale = out_of_plane * direction_unit;
  m.u_scale = Numbers::ratio(det, x.across[2]) * unit;
  m.v_scale = Numbers::ratio(det, x.across[0]) * unit;
  m.w_scale = Numbers::ratio(det, x.across[1]) * unit;
  return m;
}

}  // namespace plumbline
