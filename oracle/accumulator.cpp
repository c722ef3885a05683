#include "oracle/accumulator.h"

#include <array>
#include <cstdint>
#include <cstring>

#include "oracle/decoded.h"
#include "oracle/signs.h"

namespace plumbline {
namespace {

using Word = unsigned __int128;
using Vec = std::array<Decoded, 3>;

Vec decode(const Vec3& v) { return {Decoded(v.x), Decoded(v.y), Decoded(v.z)}; }

Decoded negated(Decoded x) {
  x.negative = !x.negative;
  return x;
}
Vec negated(const Vec& v) { return {negated(v[0]), negated(v[1]), negated(v[2])}; }

// A product of significands, at most 4 * 53 bits.
struct Product {
  std::uint64_t limb[4] = {1, 0, 0, 0};
  int exponent = 0;
  bool negative = false;

  bool is_zero() const { return (limb[0] | limb[1] | limb[2] | limb[3]) == 0; }
  /// One past the exponent of the highest set bit.
  int high() const {
    int k = 3;
    while (limb[k] == 0) --k;
    return exponent + 64 * k + static_cast<int>(std::bit_width(limb[k]));
  }
  Product& operator*=(const Decoded& x) {
    std::uint64_t carry = 0;
    for (std::uint64_t& l : limb) {
      const Word t = static_cast<Word>(l) * x.significand + carry;
      l = static_cast<std::uint64_t>(t);
      carry = static_cast<std::uint64_t>(t >> 64);
    }
    exponent += x.exponent;
    negative ^= x.negative;
    return *this;
  }
};

// A sum of products, of which only the sign is asked.
class Sum {
 public:
  void add(const Product& p) {
    if (p.is_zero()) return;
    term_[count_++] = p;
    if (p.exponent < low_) low_ = p.exponent;
    const int high = p.high();
    if (high > first_) {
      second_ = first_;
      first_ = high;
      leader_ = count_ - 1;
    } else if (high > second_) {
      second_ = high;
    }
  }

  int sign() const {
    if (count_ == 0) return 0;
    const int leader = term_[leader_].negative ? -1 : 1;
    // The other terms, at most 63 of them, sum up to less than 2^(second + 6); the leader is at least 2^(first - 1).
    if (count_ == 1 || first_ - second_ >= 7) return leader;
    return compare();
  }

 private:
  static constexpr int max_terms = 64;
  static constexpr int max_words = (4096 + 4296 + 64) / 64 + 5;

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

  void accumulate(std::uint64_t* word, const Product& p) const {
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

  Product term_[max_terms];
  int count_ = 0, leader_ = 0;
  int low_ = 1 << 20, first_ = -(1 << 20), second_ = -(1 << 20);
};

// scale * d . (p x q)
void add_triple(Sum& sum, const Product& scale, const Vec& d, const Vec& p, const Vec& q) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    Product along = scale;
    along *= d[i];
    if (along.is_zero()) continue;
    Product plus = along, minus = along;
    (plus *= p[j]) *= q[k];
    (minus *= p[k]) *= negated(q[j]);
    sum.add(plus);
    sum.add(minus);
  }
}

// scale * S(d; p, q, r)
void add_S(Sum& sum, const Product& scale, const Vec& d, const Vec& p, const Vec& q, const Vec& r) {
  add_triple(sum, scale, d, p, q);
  add_triple(sum, scale, d, q, r);
  add_triple(sum, scale, d, r, p);
}

struct Decider {
  Vec o, d, a, b, c;
  Product one;

  int sign_S(const Vec& p, const Vec& q, const Vec& r) const {
    Sum sum;
    add_S(sum, one, d, p, q, r);
    return sum.sign();
  }

  // sign(T - tau det), tau finite.
  int sign_V(double tau) const {
    Sum sum;
    add_triple(sum, one, a, b, c);
    add_S(sum, one, negated(o), a, b, c);
    Product minus_tau;
    minus_tau *= negated(Decoded(tau));
    if (!minus_tau.is_zero()) add_S(sum, minus_tau, d, a, b, c);
    return sum.sign();
  }

  // Whether (b-a) x (c-a) = a x b + b x c + c x a is zero: asked along each axis.
  bool flat() const {
    const Decoded one_axis(1.0), zero(0.0);
    for (std::size_t i = 0; i < 3; ++i) {
      Vec axis{zero, zero, zero};
      axis[i] = one_axis;
      Sum sum;
      add_S(sum, one, axis, a, b, c);
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
  const Decider x{decode(ray.origin),  decode(ray.direction), decode(triangle.a),
                  decode(triangle.b), decode(triangle.c),    {}};
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
