// A case as 64-bit integers, where it is one: the points multiples of one power of two, the direction of another.
// Private to the oracle.
#pragma once
#include <optional>

#include "case/float_bits.h"
#include "case/geometry.h"
#include "oracle/int192.h"
#include "oracle/largest.h"

namespace plumbline {

struct IntegerVec {
  std::int64_t x = 0, y = 0, z = 0;
};
inline IntegerVec operator+(const IntegerVec& p, const IntegerVec& q) { return {p.x + q.x, p.y + q.y, p.z + q.z}; }
inline IntegerVec operator-(const IntegerVec& p, const IntegerVec& q) { return {p.x - q.x, p.y - q.y, p.z - q.z}; }

struct IntegerCross {
  Int128 x, y, z;
  IntegerCross(const IntegerVec& p, const IntegerVec& q)
      : x(static_cast<Int128>(p.y) * q.z - static_cast<Int128>(p.z) * q.y),
        y(static_cast<Int128>(p.z) * q.x - static_cast<Int128>(p.x) * q.z),
        z(static_cast<Int128>(p.x) * q.y - static_cast<Int128>(p.y) * q.x) {}
  bool is_zero() const { return x == 0 && y == 0 && z == 0; }
};

inline Int192 dot(const IntegerVec& p, const IntegerCross& q) {
  return multiply(p.x, q.x) + multiply(p.y, q.y) + multiply(p.z, q.z);
}

/// Coordinates are integers times 2^point_unit (the direction's, times 2^direction_unit), below 2^61 in magnitude. So
/// differences are below 2^62, components of N and h below 2^125, determinants below 2^189: everything fits.
struct IntegerCase {
  IntegerVec a, e1, e2;  ///< A-O, B-A, C-A
  IntegerVec direction;
  int point_unit = 0, direction_unit = 0;

  /// No value where the coordinates are not such integers, where one is NaN or infinite, or the direction is zero. Any
  /// rounding mode, FTZ and DAZ: what is used of binary64 here is exact or seen to be inexact.
  static std::optional<IntegerCase> make(const Triangle& triangle, const Ray& ray) {
    const Grid points(largest_magnitude(ray.origin, triangle.a, triangle.b, triangle.c)),
        directions(largest_magnitude(ray.direction));
    if (!points.usable || !directions.usable) return std::nullopt;
    std::uint64_t lost = 0;
    const IntegerVec o = points.scaled(ray.origin, lost), a = points.scaled(triangle.a, lost),
                     b = points.scaled(triangle.b, lost), c = points.scaled(triangle.c, lost),
                     d = directions.scaled(ray.direction, lost);
    if (lost << 1 != 0) return std::nullopt;  // the sign bit only says that a zero was negative
    return IntegerCase{.a = a - o,
                       .e1 = b - a,
                       .e2 = c - a,
                       .direction = d,
                       .point_unit = points.unit,
                       .direction_unit = directions.unit};
  }

 private:
  // Multiples of 2^unit below 2^61 * 2^unit, where `biggest` is the largest of them.
  struct Grid {
    int unit;
    bool usable;  // not zero, finite, and of a size that the scaling below cannot overflow or underflow by itself
    double down, up;
    explicit Grid(double biggest) {
      constexpr int bias = 1023, reach = 900;
      const int exponent = static_cast<int>(to_bits(biggest) >> FloatFormat<double>::fraction_bits) - bias;
      usable = exponent >= -reach && exponent <= reach;
      unit = exponent - 60;
      down = power_of_two(-unit);
      up = power_of_two(unit);
    }
    // x = k * 2^unit exactly, or a bit of `lost` is set: the product is exact, or too small for an integer but zero; the
    // way back is exact, since k has no more bits than x; and bits are compared, so that DAZ cannot hide a subnormal.
    std::int64_t scaled(double x, std::uint64_t& lost) const {
      const auto k = static_cast<std::int64_t>(x * down);
      lost |= to_bits(static_cast<double>(k) * up) ^ to_bits(x);
      return k;
    }
    IntegerVec scaled(const Vec3& v, std::uint64_t& lost) const {
      return {scaled(v.x, lost), scaled(v.y, lost), scaled(v.z, lost)};
    }
    static double power_of_two(int n) {
      return from_bits<double>(static_cast<std::uint64_t>(1023 + n) << FloatFormat<double>::fraction_bits);
    }
  };
};

/// The determinants of batch_kernel.h, exact: T in units of 2^(3 point_unit), the others of 2^(2 point_unit +
/// direction_unit).
struct IntegerDeterminants {
  IntegerCross normal;
  Int192 det, T, w_ab, w_ca, w_bc;
  explicit IntegerDeterminants(const IntegerCase& x)
      : normal(x.e1, x.e2), det(dot(x.direction, normal)), T(dot(x.a, normal)) {
    const IntegerCross h(x.direction, x.a);
    w_ab = dot(x.e1, h);
    w_ca = -dot(x.e2, h);
    w_bc = det - w_ca - w_ab;
  }
};

}  // namespace plumbline
