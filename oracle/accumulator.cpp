#include "oracle/accumulator.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#include "oracle/decoded.h"
#include "oracle/int192.h"
#include "oracle/signs.h"

namespace plumbline {
namespace {

using Word = Word128;
using Vec = std::array<Decoded, 3>;

// With 2^52 <= significand < 2^53, subnormal or not, unless it is zero.
Decoded normalized(double x) {
  Decoded decoded(x);
  if (decoded.significand != 0) {
    const int up = std::countl_zero(decoded.significand) - 11;
    decoded.significand <<= up;
    decoded.exponent -= up;
  }
  return decoded;
}

Vec decode(const Vec3& v) { return {normalized(v.x), normalized(v.y), normalized(v.z)}; }

// +-limbs * 2^exponent: a product of three or four coordinates; least significant limb first.
struct Term {
  std::uint64_t limb[4];
  int exponent;
  bool negative;
};

Term times(const Term& x, const Decoded& y) {
  Word carry = 0;
  Term product{{}, x.exponent + y.exponent, x.negative != y.negative};
  for (int i = 0; i < 4; ++i) {
    carry += static_cast<Word>(x.limb[i]) * y.significand;
    product.limb[i] = static_cast<std::uint64_t>(carry);
    carry >>= 64;
  }
  return product;
}

// The terms of a determinant, all products of that many coordinates; zeros are left out.
template <int factor_count, int capacity>
struct Terms {
  static constexpr int factors = factor_count;
  Term term[capacity];
  int count = 0;
};
using Triple = Terms<3, 12>;

// One of the six products of a cross product, and the axis it belongs to.
struct Minor {
  Word significand;
  int exponent;
  bool negative;
  unsigned char axis;
};

struct Cross {
  Minor minor[6];
  int count = 0;

  Cross(const Vec& p, const Vec& q) {
    for (unsigned char axis = 0; axis < 3; ++axis) {
      const std::size_t j = (axis + 1) % 3, k = (axis + 2) % 3;
      add(p[j], q[k], false, axis);
      add(p[k], q[j], true, axis);
    }
  }

 private:
  void add(const Decoded& x, const Decoded& y, bool subtract, unsigned char axis) {
    if (x.significand == 0 || y.significand == 0) return;
    minor[count++] = {static_cast<Word>(x.significand) * y.significand, x.exponent + y.exponent,
                      (x.negative != y.negative) != subtract, axis};
  }
};

// Adds d . cross.
void add_dot(Triple& terms, const Vec& d, const Cross& cross) {
  for (int i = 0; i < cross.count; ++i) {
    const Minor& m = cross.minor[i];
    const Decoded& x = d[m.axis];
    if (x.significand == 0) continue;
    const Word low = static_cast<Word>(static_cast<std::uint64_t>(m.significand)) * x.significand;
    // The minor is below 2^106: no sum below overflows.
    const Word high = static_cast<Word>(static_cast<std::uint64_t>(m.significand >> 64)) * x.significand + (low >> 64);
    terms.term[terms.count++] = {{static_cast<std::uint64_t>(low), static_cast<std::uint64_t>(high),
                                  static_cast<std::uint64_t>(high >> 64)},
                                 m.exponent + x.exponent,
                                 m.negative != x.negative};
  }
}

Triple dot(const Vec& d, const Cross& cross) {
  Triple terms;
  add_dot(terms, d, cross);
  return terms;
}

// A sum of terms, of which only the sign is asked. The terms stay where they are.
class Sum {
 public:
  template <class Terms>
  Sum& add(const Terms& terms) {
    part_[parts_++] = {terms.term, terms.count, Terms::factors, false};
    return *this;
  }
  template <class Terms>
  Sum& subtract(const Terms& terms) {
    part_[parts_++] = {terms.term, terms.count, Terms::factors, true};
    return *this;
  }

  int sign() const {
    constexpr int none = -(1 << 20);
    int low = -none, first = none, second = none;  // of the lowest bit; above the largest term and the next
    bool leader_negative = false;
    for (int i = 0; i < parts_; ++i) {
      const Part& part = part_[i];
      for (int k = 0; k < part.count; ++k) {
        const Term& term = part.term[k];
        const int high = term.exponent + 53 * part.factors;
        low = std::min(low, term.exponent);
        second = std::max(second, std::min(first, high));
        leader_negative = high > first ? term.negative != part.negated : leader_negative;
        first = std::max(first, high);
      }
    }
    if (first == none) return 0;
    // The other terms, at most 59 of them, sum up to less than 2^(second + 6); the leader is at least 2^(first - 4).
    if (first - second >= 10) return leader_negative ? -1 : 1;
    return compare(low, first);
  }

 private:
  struct Part {
    const Term* term;
    int count, factors;
    bool negated;
  };
  // The longest sum is that of t - tau for |tau| < 1: T's terms of three factors reach up to 2^3072, tau * det's down to
  // 2^-4504. For |tau| >= 1 it is 2^4096 down to 2^-3378.
  static constexpr int max_cells = (3 * 1024 + 4 * 1126) / 64 + 2;

  // Cell k counts 2^(64 k + low). It takes up to 60 numbers of 64 bits without a carry: below 2^70.
  int compare(int low, int first) const {
    const int cells = (first - low) / 64 + 2;
    Word positive[max_cells], negative[max_cells];
    std::memset(positive, 0, sizeof(Word) * static_cast<std::size_t>(cells));
    std::memset(negative, 0, sizeof(Word) * static_cast<std::size_t>(cells));
    for (int i = 0; i < parts_; ++i) {
      const Part& part = part_[i];
      for (int k = 0; k < part.count; ++k) {
        const Term& term = part.term[k];
        const auto at = static_cast<unsigned>(term.exponent - low), shift = at % 64;
        Word* to = (term.negative != part.negated ? negative : positive) + at / 64;
        to[0] += term.limb[0] << shift;
        to[1] += term.limb[0] >> 1 >> (63 - shift) | term.limb[1] << shift;
        to[2] += term.limb[1] >> 1 >> (63 - shift) | term.limb[2] << shift;
        to[3] += term.limb[2] >> 1 >> (63 - shift) | term.limb[3] << shift;
        if (part.factors == 4) to[4] += term.limb[3] >> 1 >> (63 - shift);
      }
    }
    // From the top: all cells below one, in its units, are less than 2^70 / 2^64 * (1 + 2^-63) < 65.
    Int128 sum = 0;
    for (int k = cells - 1; k >= 0; --k) {
      sum = sum * (Int128{1} << 64) + static_cast<Int128>(positive[k] - negative[k]);
      if (sum > 65 || sum < -65) break;
    }
    return (sum > 0) - (sum < 0);
  }

  Part part_[5];
  int parts_ = 0;
};

class Decider {
 public:
  Decider(const Triangle& triangle, const Query& query)
      : o_(decode(query.ray.origin)),
        d_(decode(query.ray.direction)),
        d_tail_(decode(query.direction_tail)),
        has_tail_(query.has_tail()),
        a_(decode(triangle.a)),
        b_(decode(triangle.b)),
        c_(decode(triangle.c)),
        a_x_b_(a_, b_),
        b_x_c_(b_, c_),
        c_x_a_(c_, a_),
        d_ab_(along(a_x_b_)),
        d_bc_(along(b_x_c_)),
        d_ca_(along(c_x_a_)) {}

  int det() const { return Sum().add(d_ab_).add(d_bc_).add(d_ca_).sign(); }

  void place_hit(Truth& truth, int det) const {
    const Triple d_oa = along({o_, a_}), d_ob = along({o_, b_}), d_oc = along({o_, c_});
    place(truth, Sum().add(d_ab_).add(d_oa).subtract(d_ob).sign() * det,
          Sum().add(d_bc_).add(d_ob).subtract(d_oc).sign() * det, Sum().add(d_ca_).add(d_oc).subtract(d_oa).sign() * det);
  }

  /// T, for `versus` and `coplanar`.
  struct Height {
    Triple a_bc, o_ab, o_bc, o_ca;
    Sum sum() const { return Sum().add(a_bc).subtract(o_ab).subtract(o_bc).subtract(o_ca); }
  };
  Height height() const { return {dot(a_, b_x_c_), dot(o_, a_x_b_), dot(o_, b_x_c_), dot(o_, c_x_a_)}; }

  /// Of t - tau.
  signed char versus(double tau, const Height& height, int det) const {
    if (!is_finite(tau)) return is_negative(tau) ? 1 : -1;
    Terms<4, 36> tau_det;
    const Decoded factor = normalized(tau);
    if (!is_zero(tau))
      for (const Triple* terms : {&d_ab_, &d_bc_, &d_ca_})
        for (int i = 0; i < terms->count; ++i) tau_det.term[tau_det.count++] = times(terms->term[i], factor);
    return static_cast<signed char>(height.sum().subtract(tau_det).sign() * det);
  }

  // Whether (b-a) x (c-a) = a x b + b x c + c x a is zero: asked along each axis.
  bool flat() const {
    for (std::size_t i = 0; i < 3; ++i) {
      Vec axis;
      axis[i] = normalized(1.0);
      const Triple ab = dot(axis, a_x_b_), bc = dot(axis, b_x_c_), ca = dot(axis, c_x_a_);
      if (Sum().add(ab).add(bc).add(ca).sign() != 0) return false;
    }
    return true;
  }

 private:
  // The direction . cross.
  Triple along(const Cross& cross) const {
    Triple terms = dot(d_, cross);
    if (has_tail_) add_dot(terms, d_tail_, cross);
    return terms;
  }

  Vec o_, d_, d_tail_;
  bool has_tail_;
  Vec a_, b_, c_;
  Cross a_x_b_, b_x_c_, c_x_a_;
  Triple d_ab_, d_bc_, d_ca_;
};

}  // namespace

Truth classify_accumulate(const Triangle& triangle, const Query& query) {
  const Decider decider(triangle, query);
  const Ray& ray = query.ray;
  Truth truth;
  const int det = decider.det();
  truth.det_sign = static_cast<signed char>(det);
  if (det == 0) {
    truth.hit_class = decider.flat()                       ? HitClass::degenerate
                      : decider.height().sum().sign() == 0 ? HitClass::coplanar
                                                           : HitClass::parallel;
    return truth;
  }
  decider.place_hit(truth, det);
  if (truth.hit_class == HitClass::exterior) return truth;
  const Decider::Height height = decider.height();
  truth.versus_t_min = decider.versus(ray.t_min, height, det);
  truth.versus_t_max = decider.versus(ray.t_max, height, det);
  return truth;
}

}  // namespace plumbline
