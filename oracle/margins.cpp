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

// Rounded numbers beside the integers that they stand for, in units of the grids. So all that is not zero is at
// least 1 and below 2^1016, and neither overflows nor underflows. u = 2^-52 in any rounding mode.
using Near = std::array<double, 3>;
double near_dot(const Near& x, const Near& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }
Near near_cross(const Near& x, const Near& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}

struct RoundedNumbers {
  // Each component within u.
  struct Vec {
    WideVec<2> integers;
    Near near;
    double square;
    const WideVec<2>& exact() const { return integers; }
  };
  // p x q, within 2^-42.4 of its length. A component as computed from rounded ones is off by at most 4 u (1 +
  // u) times the sum of the magnitudes of its two products; all three by 4 sqrt(2) u |p| |q| < 2^-49.4 |p| |q|.
  // Where the length is below 2^-7 |p| |q| the integers are asked, whose components come within 2^-52.
  struct Normal {
    const Vec *p = nullptr, *q = nullptr;
    Near near{};
    double square = 0;
    Normal() = default;
    Normal(const Vec& first, const Vec& second)
        : p(&first), q(&second), near(near_cross(first.near, second.near)), square(near_dot(near, near)) {
      if (square >= 0x1p-14 * (p->square * q->square)) return;
      const WideVec<4> n = exact();
      near = {truncated(n[0]), truncated(n[1]), truncated(n[2])};
      square = near_dot(near, near);
    }
    WideVec<4> exact() const { return plumbline::cross(p->integers, q->integers); }
  };
  using Height = double;
  using Measure = double;
  static Normal cross(const Vec& x, const Vec& y) { return {x, y}; }
  static bool is_zero(const Normal& x) { return x.square == 0; }
  // The rounded product is off by at most (2^-41.4 + 3 u) |x| |y|.
  template <class Any>
  static int sign_of_dot(const Any& x, const Any& y) {
    const double product = near_dot(x.near, y.near);
    if (product * product > 0x1p-80 * (x.square * y.square)) return product > 0 ? 1 : -1;
    return plumbline::dot(x.exact(), y.exact()).sign();
  }
  static double length(const Vec& x) { return std::sqrt(x.square); }
  static double ratio(double x, const Normal& y) { return std::abs(x) / std::sqrt(y.square); }
  static double ratio(const Normal& x, const Vec& y) { return std::sqrt(x.square / y.square); }
};

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
  using Vec = RoundedNumbers::Vec;
  const Ray& ray = query.ray;
  if (query.has_tail() || !is_simple(ray)) return exact_margins(triangle, query, precision);
  const auto grid = WideCase::make(triangle, ray);
  if (!grid || !in_reach(grid->point_unit) || !in_reach(grid->direction_unit))
    return exact_margins(triangle, query, precision);

  // The determinants, exact.
  const WideVec<2> to_a = grid->a - grid->origin, e1 = grid->b - grid->a, e2 = grid->c - grid->a;
  const WideVec<4> n = cross(e1, e2), e1_d = cross(e1, grid->direction), e2_d = cross(e2, grid->direction);
  const WideInt<6> det = dot(grid->direction, n), T = dot(to_a, n), w_ab = dot(to_a, e1_d),
                   w_ca = -dot(to_a, e2_d), w_bc = det - w_ca - w_ab;
  const int sign = det.sign();
  if (sign == 0 && T.sign() == 0)
    return exact_margins(triangle, query, precision);  // no area, no direction, coplanar
  Margins m;
  m.truth.det_sign = static_cast<signed char>(sign);
  const bool ends_low = is_zero(ray.t_min), ends_high = is_zero(ray.t_max);
  if (sign == 0) {
    m.truth.hit_class = HitClass::parallel;
  } else {
    const auto times_sign = [sign](const WideInt<6>& x) { return static_cast<signed char>(x.sign() * sign); };
    m.ab = times_sign(w_ab), m.bc = times_sign(w_bc), m.ca = times_sign(w_ca);
    place(m.truth, m.ab, m.bc, m.ca);
    if (m.truth.hit_class != HitClass::exterior) {
      m.truth.versus_t_min = ends_low ? times_sign(T) : static_cast<signed char>(1);
      m.truth.versus_t_max = ends_high ? times_sign(T) : static_cast<signed char>(-1);
    }
  }
  m.hit = crosses(m.truth);

  // The lengths, rounded. Differences of rounded coordinates would be off; those of the coordinates themselves
  // are not.
  const double point_scale = power_of_two(-grid->point_unit),
               direction_scale = power_of_two(-grid->direction_unit);
  const auto scaled = [](const Vec3& p, double scale) { return Near{p.x * scale, p.y * scale, p.z * scale}; };
  const Near o = scaled(ray.origin, point_scale), d = scaled(ray.direction, direction_scale),
             a = scaled(triangle.a, point_scale), b = scaled(triangle.b, point_scale),
             c = scaled(triangle.c, point_scale);
  const auto between = [](const WideVec<2>& integers, const Near& to, const Near& from) {
    const Near near = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
    return Vec{integers, near, near_dot(near, near)};
  };
  Sight<RoundedNumbers> x{
      .direction = {grid->direction, d, near_dot(d, d)},
      .to = {between(to_a, a, o), between(grid->b - grid->origin, b, o), between(grid->c - grid->origin, c, o)},
      .edge = {between(e1, b, a), between(grid->c - grid->b, c, b), between(grid->a - grid->c, a, c)},
      .normal = {},
      .across = {},
      .w = {truncated(w_ab), truncated(w_bc), truncated(w_ca)}};
  x.normal = {x.edge[2], x.edge[0]};  // (A-C) x (B-A) = (B-A) x (C-A)
  for (std::size_t k = 0; k < 3; ++k) x.across[k] = {x.edge[k], x.direction};
  const double height = truncated(T);
  const RayEnd<RoundedNumbers> origin{.to = x.to, .height = height};
  const auto *low = ends_low ? &origin : nullptr, *high = ends_high ? &origin : nullptr;
  const double unit = power_of_two(grid->point_unit);
  m.severity = (m.hit ? depth(x, low, high) : distance(x, low, high)) * unit;

  const double largest = largest_coordinate(triangle, ray);
  m.severity_ulps = m.severity * power_of_two(-ulp_exponent_at(largest, precision));
  const double longest2 = std::max({x.edge[0].square, x.edge[1].square, x.edge[2].square});
  const double out_of_plane = RoundedNumbers::ratio(truncated(det), x.normal);
  m.sine = out_of_plane / std::sqrt(x.direction.square);
  m.altitude = std::sqrt(x.normal.square) / longest2;
  m.size = std::sqrt(longest2) / (largest * point_scale);
  if (sign == 0) return m;
  const double direction_unit = power_of_two(grid->direction_unit);
  m.t = truncated(T) / truncated(det) * (unit / direction_unit);
  m.u = x.w[2] / truncated(det);
  m.v = x.w[0] / truncated(det);
  m.t_scale = out_of_plane * direction_unit;
  m.u_scale = RoundedNumbers::ratio(truncated(det), x.across[2]) * unit;
  m.v_scale = RoundedNumbers::ratio(truncated(det), x.across[0]) * unit;
  return m;
}

}  // namespace plumbline
