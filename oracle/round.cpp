#include "oracle/round.h"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "case/float_bits.h"

namespace plumbline::exact {
namespace {

long bit_length(const mpz_class& x) { return static_cast<long>(mpz_sizeinbase(x.get_mpz_t(), 2)); }

void shift_left(mpz_class& x, long n) { mpz_mul_2exp(x.get_mpz_t(), x.get_mpz_t(), static_cast<mp_bitcnt_t>(n)); }

// significand * 2^exponent, rounded. The last bit of the significand is sticky: set where the exact value has further
// bits. The significand has at least two bits more than the format, so that the sticky bit lies below the tie bit.
template <class Real>
Real assemble(std::uint64_t significand, long exponent, bool negative) {
  using F = FloatFormat<Real>;
  const auto sign = negative ? F::sign_bit : typename F::Bits{0};
  const long leading = exponent + std::bit_width(significand) - 1;
  if (leading > F::max_exponent) return from_bits<Real>(F::exponent_mask | sign);
  const long ulp = std::max<long>(leading - F::fraction_bits, F::least_exponent);
  const long dropped = ulp - exponent;
  if (dropped > 63) return from_bits<Real>(sign);  // below 2^64 / 2^65 of the least subnormal: under half of it
  const std::uint64_t half = std::uint64_t{1} << (dropped - 1);
  const std::uint64_t rest = significand & (2 * half - 1);
  std::uint64_t kept = significand >> dropped;
  if (rest > half || (rest == half && (kept & 1) != 0)) ++kept;
  // The hidden bit carries into the exponent field: right for subnormals, normals and the step to infinity alike.
  const auto magnitude = (static_cast<std::uint64_t>(ulp - F::least_exponent) << F::fraction_bits) + kept;
  return from_bits<Real>(static_cast<typename F::Bits>(magnitude) | sign);
}

}  // namespace

template <class Real>
Real rounded(const Quotient& x) {
  if (x.numerator.sign() == 0) return Real{0};
  mpz_class p = ::abs(x.numerator.integer), q = x.denominator.integer;
  // A quotient of precision + 2 or + 3 bits.
  const long shift = FloatFormat<Real>::precision + 2 - (bit_length(p) - bit_length(q));
  shift_left(shift >= 0 ? p : q, std::abs(shift));
  mpz_class quotient, remainder;
  mpz_tdiv_qr(quotient.get_mpz_t(), remainder.get_mpz_t(), p.get_mpz_t(), q.get_mpz_t());
  const std::uint64_t significand = quotient.get_ui() | (remainder != 0 ? 1 : 0);
  return assemble<Real>(significand, x.numerator.exponent - x.denominator.exponent - shift, x.numerator.sign() < 0);
}

template <class Real>
Real rounded_sqrt(const Quotient& x) {
  if (x.numerator.sign() == 0) return Real{0};
  mpz_class p = x.numerator.integer, q = x.denominator.integer;
  const long exponent = x.numerator.exponent - x.denominator.exponent;
  // A quotient of at least 2 * (precision + 2) bits, so a root of at least precision + 2; its exponent even.
  long shift = 2 * (FloatFormat<Real>::precision + 2) + 1 - (bit_length(p) - bit_length(q));
  if ((exponent - shift) % 2 != 0) ++shift;
  shift_left(shift >= 0 ? p : q, std::abs(shift));
  mpz_class quotient, remainder, root, square_remainder;
  mpz_tdiv_qr(quotient.get_mpz_t(), remainder.get_mpz_t(), p.get_mpz_t(), q.get_mpz_t());
  mpz_sqrtrem(root.get_mpz_t(), square_remainder.get_mpz_t(), quotient.get_mpz_t());
  const bool inexact = remainder != 0 || square_remainder != 0;
  return assemble<Real>(root.get_ui() | (inexact ? 1 : 0), (exponent - shift) / 2, false);
}

template float rounded<float>(const Quotient&);
template double rounded<double>(const Quotient&);
template float rounded_sqrt<float>(const Quotient&);
template double rounded_sqrt<double>(const Quotient&);

}  // namespace plumbline::exact
