#include "oracle/accumulator.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

#include "oracle/decoded.h"
#include "oracle/int192.h"
#include "oracle/signs.h"

namespace plumbline {
namespace {

using Word = Word128;
using Vec = std::array<Decoded, 3>;

Vec decode(const Vec3& v) { return {Decoded(v.x), Decoded(v.y), Decoded(v.z)}; }

Decoded negated(Decoded x) {
  x.negative = !x.negative;
  return x;
}

// The product of up to two significands.
struct Pair {
  Word significand = 1;
  int exponent = 0;
  int high = 1;  // 2^high is above the product, 2^(high - 2) is not
  bool negative = false;

  Pair() = default;
  Pair(const Decoded& x, const Decoded& y)
      : significand(static_cast<Word>(x.significand) * y.significand),
        exponent(x.exponent + y.exponent),
        high(significand == 0 ? 0 : x.high() + y.high()),
        negative(x.negative != y.negative) {}
};

// A sum of products of two pairs, of which only the sign is asked.
class Sum {
 public:
  /// Adds x * y, or subtracts it.
  void add(const Pair& x, const Pair& y, bool subtract) {
    if (x.significand == 0 || y.significand == 0) return;
    Term& term = term_[count_];
    multiply(x.significand, y.significand, term.limb);
    term.exponent = x.exponent + y.exponent;
    term.negative = (x.negative != y.negative) != subtract;
    low_ = std::min(low_, term.exponent);
    const int high = x.high + y.high;
    if (high > first_) {
      second_ = first_;
      first_ = high;
      leader_ = count_;
    } else if (high > second_) {
      second_ = high;
    }
    ++count_;
  }

  int sign() const {
    if (count_ == 0) return 0;
    // The other terms, at most 63 of them, sum up to less than 2^(second + 6); the leader is at least 2^(first - 4).
    if (count_ == 1 || first_ - second_ >= 10) return term_[leader_].negative ? -1 : 1;
    return compare();
  }

 private:
  struct Term {
    std::uint64_t limb[4];  // at most 4 * 53 bits
    int exponent;
    bool negative;
  };
  static constexpr int max_terms = 64;
  static constexpr int max_words = (4096 + 4296 + 64) / 64 + 5;

  static void multiply(Word x, Word y, std::uint64_t* limb) {
    const auto x0 = static_cast<std::uint64_t>(x), x1 = static_cast<std::uint64_t>(x >> 64);
    const auto y0 = static_cast<std::uint64_t>(y), y1 = static_cast<std::uint64_t>(y >> 64);
    const Word low = static_cast<Word>(x0) * y0, high = static_cast<Word>(x1) * y1;
    // x1, y1 < 2^42: no sum below overflows.
    const Word middle = static_cast<Word>(x0) * y1 + static_cast<Word>(x1) * y0 + (low >> 64);
    const Word top = high + (middle >> 64);
    limb[0] = static_cast<std::uint64_t>(low);
    limb[1] = static_cast<std::uint64_t>(middle);
    limb[2] = static_cast<std::uint64_t>(top);
    limb[3] = static_cast<std::uint64_t>(top >> 64);
  }

  int compare() const {
    const int words = (first_ - low_) / 64 + 5;  // a term's four limbs, one more for the shift, and room for carries
    std::uint64_t positive[max_words], negative[max_words];
    std::memset(positive, 0, sizeof(std::uint64_t) * static_cast<std::size_t>(words));
    std::memset(negative, 0, sizeof(std::uint64_t) * static_cast<std::size_t>(words));
    for (int i = 0; i < count_; ++i) accumulate(term_[i].negative ? negative : positive, term_[i]);
    for (int k = words - 1; k >= 0; --k)
      if (positive[k] != negative[k]) return positive[k] > negative[k] ? 1 : -1;
    return 0;
  }

  void accumulate(std::uint64_t* word, const Term& p) const {
    const int at = p.exponent - low_, shift = at % 64;
    std::uint64_t* to = word + at / 64;
    std::uint64_t below = 0;
    unsigned char carry = 0;
    for (const std::uint64_t limb : p.limb) {
      carry = add_carry(*to++, shift == 0 ? limb : limb << shift | below, carry);
      below = shift == 0 ? 0 : limb >> (64 - shift);
    }
    // The words past a term's highest bit are there: `words` counts from the highest bit of all terms.
    for (std::uint64_t rest = below; rest != 0 || carry != 0; rest = 0) carry = add_carry(*to++, rest, carry);
  }

  static unsigned char add_carry(std::uint64_t& to, std::uint64_t x, unsigned char carry) {
    const Word t = static_cast<Word>(to) + x + carry;
    to = static_cast<std::uint64_t>(t);
    return static_cast<unsigned char>(t >> 64);
  }

  Term term_[max_terms];
  int count_ = 0, leader_ = 0;
  int low_ = 1 << 20, first_ = -(1 << 20), second_ = -(1 << 20);
};

// A direction, each component times one scale.
using ScaledVec = std::array<Pair, 3>;

ScaledVec scaled(const Vec& d, const Decoded& scale) { return {Pair(d[0], scale), Pair(d[1], scale), Pair(d[2], scale)}; }

// d . (p x q)
void add_triple(Sum& sum, const ScaledVec& d, const Vec& p, const Vec& q) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    if (d[i].significand == 0) continue;
    sum.add(d[i], Pair(p[j], q[k]), false);
    sum.add(d[i], Pair(p[k], q[j]), true);
  }
}

// S(d; p, q, r)
void add_S(Sum& sum, const ScaledVec& d, const Vec& p, const Vec& q, const Vec& r) {
  add_triple(sum, d, p, q);
  add_triple(sum, d, q, r);
  add_triple(sum, d, r, p);
}

constexpr Decoded one(1.0), minus_one(-1.0);

struct Decider {
  Vec o, d, a, b, c;

  int sign_S(const Vec& p, const Vec& q, const Vec& r) const {
    Sum sum;
    add_S(sum, scaled(d, one), p, q, r);
    return sum.sign();
  }

  // sign(T - tau det), tau finite.
  int sign_V(double tau) const {
    Sum sum;
    add_triple(sum, scaled(a, one), b, c);
    add_S(sum, scaled(o, minus_one), a, b, c);
    if (!is_zero(tau)) add_S(sum, scaled(d, negated(Decoded(tau))), a, b, c);
    return sum.sign();
  }

  // Whether (b-a) x (c-a) = a x b + b x c + c x a is zero: asked along each axis.
  bool flat() const {
    for (std::size_t i = 0; i < 3; ++i) {
      ScaledVec axis{};
      for (std::size_t k = 0; k < 3; ++k) axis[k].significand = k == i ? 1 : 0;
      Sum sum;
      add_S(sum, axis, a, b, c);
      if (sum.sign() != 0) return false;
    }
    return true;
  }

  signed char versus(double tau, int det) const {
    if (!is_finite(tau)) return is_negative(tau) ? 1 : -1;
    return static_cast<signed char>(sign_V(tau) * det);
  }
};

}  // namespace

Truth classify_accumulate(const Triangle& triangle, const Ray& ray) {
  const Decider x{decode(ray.origin), decode(ray.direction), decode(triangle.a), decode(triangle.b), decode(triangle.c)};
  Truth truth;
  const int det = x.sign_S(x.a, x.b, x.c);
  truth.det_sign = static_cast<signed char>(det);
  if (det == 0) {
    truth.hit_class = x.flat()            ? HitClass::degenerate
                      : x.sign_V(0) == 0 ? HitClass::coplanar
                                         : HitClass::parallel;
    return truth;
  }
  place(truth, x.sign_S(x.a, x.b, x.o) * det, x.sign_S(x.b, x.c, x.o) * det, x.sign_S(x.c, x.a, x.o) * det);
  if (truth.hit_class == HitClass::exterior) return truth;
  truth.versus_t_min = x.versus(ray.t_min, det);
  truth.versus_t_max = x.versus(ray.t_max, det);
  return truth;
}

}  // namespace plumbline
