#include "oracle/dyadic.h"

#include <cstdint>
#include <utility>

#include "case/float_bits.h"

namespace plumbline::exact {
namespace {

// x's integer when written with the smaller exponent e.
mpz_class scaled(const Dyadic& x, long e) {
  mpz_class r;
  mpz_mul_2exp(r.get_mpz_t(), x.integer.get_mpz_t(), static_cast<mp_bitcnt_t>(x.exponent - e));
  return r;
}

}  // namespace

Dyadic::Dyadic(double x) {
  using F = FloatFormat<double>;
  const auto bits = to_bits(x);
  const auto biased = static_cast<int>((bits & F::exponent_mask) >> F::fraction_bits);
  const std::uint64_t fraction = bits & F::fraction_mask;
  const std::uint64_t significand = biased == 0 ? fraction : fraction | (F::fraction_mask + 1);
  if (significand == 0) return;
  const int trailing = std::countr_zero(significand);
  static_assert(sizeof(unsigned long) == sizeof(std::uint64_t), "GMP takes an unsigned long");
  integer = static_cast<unsigned long>(significand >> trailing);
  if (is_negative(x)) integer = -integer;
  exponent = ulp_exponent(x) + trailing;
}

Dyadic operator+(const Dyadic& x, const Dyadic& y) {
  if (x.sign() == 0) return y;
  if (y.sign() == 0) return x;
  if (x.exponent < y.exponent) return {x.integer + scaled(y, x.exponent), x.exponent};
  return {scaled(x, y.exponent) + y.integer, y.exponent};
}

Dyadic operator-(const Dyadic& x) { return {-x.integer, x.exponent}; }
Dyadic operator-(const Dyadic& x, const Dyadic& y) { return x + -y; }

Dyadic operator*(const Dyadic& x, const Dyadic& y) {
  if (x.sign() == 0 || y.sign() == 0) return {};
  return {x.integer * y.integer, x.exponent + y.exponent};
}

std::strong_ordering operator<=>(const Dyadic& x, const Dyadic& y) { return (x - y).sign() <=> 0; }

Vec to_exact(const Vec3& v) { return {Dyadic(v.x), Dyadic(v.y), Dyadic(v.z)}; }
Vec operator-(const Vec& x, const Vec& y) { return {x[0] - y[0], x[1] - y[1], x[2] - y[2]}; }
Vec operator+(const Vec& x, const Vec& y) { return {x[0] + y[0], x[1] + y[1], x[2] + y[2]}; }
Vec operator*(const Dyadic& k, const Vec& x) { return {k * x[0], k * x[1], k * x[2]}; }

Vec cross(const Vec& x, const Vec& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}

Dyadic dot(const Vec& x, const Vec& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }

Quotient::Quotient(Dyadic n, Dyadic d) : numerator(std::move(n)), denominator(std::move(d)) {
  if (denominator.sign() < 0) {
    numerator = -numerator;
    denominator = -denominator;
  }
}

std::strong_ordering operator<=>(const Quotient& x, const Quotient& y) {
  return x.numerator * y.denominator <=> y.numerator * x.denominator;
}

mpq_class to_mpq(const Quotient& x) {
  mpz_class p = x.numerator.integer, q = x.denominator.integer;
  const long e = x.numerator.exponent - x.denominator.exponent;
  mpz_class& widened = e >= 0 ? p : q;
  mpz_mul_2exp(widened.get_mpz_t(), widened.get_mpz_t(), static_cast<mp_bitcnt_t>(e >= 0 ? e : -e));
  mpq_class r(p, q);
  r.canonicalize();
  return r;
}

}  // namespace plumbline::exact
