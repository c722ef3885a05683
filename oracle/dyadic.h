// Exact numbers of the form integer * 2^exponent, and quotients of two: what finite doubles become under + - *.
// No division and no rounding here, so nothing can be lost. Private to the oracle; backed by GMP.
#pragma once
#include <gmpxx.h>

#include <array>
#include <compare>

#include "case/geometry.h"

namespace plumbline::exact {

struct Dyadic {
  mpz_class integer;
  long exponent = 0;

  Dyadic() = default;
  Dyadic(mpz_class i, long e) : integer(std::move(i)), exponent(e) {}
  /// Exact, from the bits; x is finite.
  explicit Dyadic(double x);

  int sign() const { return sgn(integer); }
};

Dyadic operator+(const Dyadic& x, const Dyadic& y);
Dyadic operator-(const Dyadic& x, const Dyadic& y);
Dyadic operator*(const Dyadic& x, const Dyadic& y);
Dyadic operator-(const Dyadic& x);
std::strong_ordering operator<=>(const Dyadic& x, const Dyadic& y);
inline bool operator==(const Dyadic& x, const Dyadic& y) { return (x <=> y) == 0; }
inline Dyadic square(const Dyadic& x) { return x * x; }
inline Dyadic abs(const Dyadic& x) { return x.sign() < 0 ? -x : x; }

using Vec = std::array<Dyadic, 3>;
Vec to_exact(const Vec3& v);
Vec operator-(const Vec& x, const Vec& y);
Vec operator+(const Vec& x, const Vec& y);
Vec operator*(const Dyadic& k, const Vec& x);
Vec cross(const Vec& x, const Vec& y);
Dyadic dot(const Vec& x, const Vec& y);
inline Dyadic square(const Vec& x) { return dot(x, x); }
inline bool is_zero(const Vec& x) { return x[0].sign() == 0 && x[1].sign() == 0 && x[2].sign() == 0; }

/// numerator / denominator, with denominator > 0.
struct Quotient {
  Dyadic numerator, denominator;
  Quotient(Dyadic n, Dyadic d);
  explicit Quotient(const Dyadic& x) : Quotient(x, Dyadic(1, 0)) {}
};
std::strong_ordering operator<=>(const Quotient& x, const Quotient& y);
inline bool operator==(const Quotient& x, const Quotient& y) { return (x <=> y) == 0; }

/// In lowest terms.
mpq_class to_mpq(const Quotient& x);

}  // namespace plumbline::exact
