// The vector stages of classify, W cases at a time: the filter and the residue stage. Each lane is decided, with a proof,
// or left to the next stage; no lane is guessed. No allocation, no exception, no state. Valid in every rounding mode, with
// FTZ and DAZ set or not, with contraction to FMA or without.
//
// Both stages evaluate, with a = A-O, e1 = B-A, e2 = C-A, N = e1 x e2, h = D x a:
//   det = D.N   T = a.N   w_AB = e1.h   w_CA = -(e2.h)   w_BC = det - w_CA - w_AB   V(tau) = T - tau det
//
// FILTER. u = 2^-53; mD, ma, me are the largest magnitudes of the components of D, of the computed a, and of the computed
// e1 and e2. D is exact. A product of three such components carries at most this many relative roundings (a difference, a
// product, a sum each count one; in directed modes one rounding is 2u, in nearest mode u):
//   det:          2 differences + 2 products + 3 sums = 7 on each of 6 terms: 42 u mD me^2, directed 84 u mD me^2
//   w_AB, w_CA:   the same 7: 84 u mD ma me
//   w_BC:         both of the above and 2 sums: 204 u mD me (ma + me)
//   T:            8 (a is a difference as well): 96 u ma me^2
//   V(tau):       T, det, a product and a sum: 96 u (ma me^2 + |tau| mD me^2); the last sum's rounding keeps the sign
// The constants are the next powers of two: 128 u = 2^-46, 256 u = 2^-45. What is left of them, at least a fifth, covers
// the roundings of the bound itself (at most 5, relative), second-order terms (2^-50) and underflow. Precondition, checked
// per lane: 2^-300 < mD, ma, me < 2^300. So no product of three exceeds 2^904. Gradual underflow, FTZ or DAZ add at most
// 2^-1022 to an operation; relative to the norms of its operands, of which the smallest product of two is 2^-600, that is
// 2^-422, and it stays so through later factors. A tau that DAZ flushes changes V by 2^-1022 |det|, 2^-422 of T's norm
// ma me^2 alike. A decision needs |value| > bound, which a NaN fails.
//
// RESIDUE. A determinant of integers is known exactly when it is known modulo 2^64 and known to lie in (-2^63, 2^63).
// The stage takes lanes whose twelve point coordinates are multiples of one power of two g, and below 2^30 g; and whose
// direction's are multiples of some g', and below 2^31 g'. In these units all inputs are integers, differences (< 2^31)
// are exact in binary64 as in 64-bit integers, so are the components of N and h as integers (< 2^63), and the determinants
// are evaluated twice: in binary64, and modulo 2^64. The error of the binary64 value, in units and in any rounding mode
// (one rounding is at most 2^-52 relative):
//   a component of N or h (two products < 2^62, a difference < 2^63):  2 * 2^10 + 2^11 = 2^12
//   det, T, w_AB, w_CA (3 products < 2^94, sums < 2^95 and < 2^96):  3 * 2^31 * 2^12 + 3 * 2^42 + 2^43 + 2^44 < 2^46
//   w_BC: three of these and two sums < 2^98:  < 2^49
// So where |value| >= 2^62 its sign is right, and elsewhere the exact value lies in (-2^63, 2^63): the residue is it.
// V(tau) is taken in units of g^3 / 64, where tau = m g / (64 g') with an integer |m| <= 2^13: 64 T - m det has the error
// 2^6 * 2^46 + 2^13 * 2^46 + (roundings of a product and a difference below 2^110) 2^59 < 2^61. Other tau are left.
// A NaN coordinate makes det or T NaN, and such lanes are left; an infinite one fails the range of the exponents.
#pragma once
#include <cstddef>

#include "oracle/batch.h"
#include "oracle/lanes.h"

namespace plumbline {
namespace {

// Enumerators as they stand in Truth's bytes, lowest first; see pack_truth in batch.h.
constexpr int feature_at = 8, det_sign_at = 16, t_min_at = 24, t_max_at = 32, invalid_at = 40;

template <int W>
class BatchKernel {
  using L = Lanes<W>;
  using Real = typename L::Real;
  using Int = typename L::Int;
  using Word = typename L::Word;

 public:
  struct RealVec { Real x, y, z; };
  struct WordVec { Word x, y, z; };  // modulo 2^64

  template <class V>
  static V minus(const V& p, const V& q) { return {p.x - q.x, p.y - q.y, p.z - q.z}; }
  template <class V>
  static V cross(const V& p, const V& q) {
    return {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
  }
  template <class V>
  static auto dot(const V& p, const V& q) { return p.x * q.x + p.y * q.y + p.z * q.z; }

  // Of integers: p and q below 2^31 in magnitude; then p below 2^31, q any, modulo 2^64.
  static WordVec cross(const WordVec& p, const WordVec& q) {
    const auto product = [](Word x, Word y) { return (Word)L::multiply_halves((Int)x, (Int)y); };
    return {product(p.y, q.z) - product(p.z, q.y), product(p.z, q.x) - product(p.x, q.z),
            product(p.x, q.y) - product(p.y, q.x)};
  }
  static Word dot(const WordVec& p, const WordVec& q) {
    // y = high 2^32 + low, both as signed halves.
    const auto product = [](Word x, Word y) {
      const Word high = (y + 0x80000000u) >> 32;
      return (Word)L::multiply_halves((Int)x, (Int)y) + ((Word)L::multiply_halves((Int)x, (Int)high) << 32);
    };
    return product(p.x, q.x) + product(p.y, q.y) + product(p.z, q.z);
  }

  static Real max_norm(const RealVec& v) { return L::max_abs(L::max_abs(v.x, v.y), v.z); }

  template <class V>
  struct Determinants {
    V a, e1, e2, n;
    decltype(V::x) det, T, w_ab, w_bc, w_ca;
    Determinants(const V& o, const V& d, const V& pa, const V& pb, const V& pc)
        : a(minus(pa, o)), e1(minus(pb, pa)), e2(minus(pc, pa)), n(cross(e1, e2)), det(dot(d, n)), T(dot(a, n)) {
      const V h = cross(d, a);
      w_ab = dot(e1, h);
      w_ca = -dot(e2, h);
      w_bc = det - w_ca - w_ab;
    }
  };

  // A sign per lane as the byte of a Truth, at its place.
  static Word sign_byte(Int negative, Int zero, int at) {
    return (Word)(negative ? Int{} + 0xff : zero ? Int{} : Int{} + 1) << at;
  }

 public:
  /// W cases: columns origin, direction, a, b, c, t_min, t_max.
  struct Cases {
    RealVec o, d, a, b, c;
    Real t_min, t_max;
  };

 private:
  static constexpr double infinity = __builtin_inf();

  // The filter's values, each multiplied by the sign of det, and the bounds of their errors.
  struct Bounded {
    Real det, T, ab, bc, ca;
    Real det_error, T_error, w_error, w_bc_error;
    Int crosses;   // det is proved to be other than zero, and no bound of t is NaN
    Int sign_bit;  // of det

    [[gnu::always_inline]] explicit Bounded(const Cases& s) {
      constexpr double k46 = 0x1p-46, low = 0x1p-300, high = 0x1p+300;
      const Determinants<RealVec> x(s.o, s.d, s.a, s.b, s.c);
      const Real m_d = max_norm(s.d), m_a = max_norm(x.a), m_e = L::max(max_norm(x.e1), max_norm(x.e2));
      const Real least = L::min(L::min(m_d, m_a), m_e), most = L::max(L::max(m_d, m_a), m_e);
      const Int in_bounds = (least > low) & (most < high) & (s.t_min == s.t_min) & (s.t_max == s.t_max);
      const Real scale = k46 * m_e, scale_d = scale * m_d;
      det_error = scale_d * m_e;
      w_error = scale_d * m_a;
      w_bc_error = 2.0 * (w_error + det_error);
      T_error = scale * m_e * m_a;
      const Int sign = L::as_int(x.det) & (Int{} + static_cast<long long>(0x8000000000000000ull));
      const auto along = [sign](Real v) { return L::as_real(L::as_int(v) ^ sign); };
      sign_bit = sign;
      det = L::abs(x.det);
      T = along(x.T);
      ab = along(x.w_ab);
      bc = along(x.w_bc);
      ca = along(x.w_ca);
      crosses = in_bounds & (det > det_error);
    }

    // V(tau), and whether its sign is proved. An infinite tau is answered by the difference's own sign.
    [[gnu::always_inline]] Real versus(Real tau, Int& known) const {
      const Real v = T - tau * det, error = T_error + L::abs(tau) * det_error;
      known = (Int)(L::abs(v) > error) | (Int)(L::abs(tau) == infinity);
      return v;
    }
  };

 public:
  /// Writes a truth for each lane; returns the mask of the lanes for which it is proved.
  [[gnu::always_inline]] static Int filter(const Cases& s, Word& truth) {
    const Bounded x(s);
    const Real least_w = L::min(x.ab, x.ca);  // a NaN would be in both: it comes with a
    const Int outside = x.crosses & ((least_w < -x.w_error) | (x.bc < -x.w_bc_error));
    const Word front = sign_byte(x.sign_bit != 0, Int{}, det_sign_at);
    const Word miss = (Word{} + static_cast<unsigned>(HitClass::exterior)) | front;
    if constexpr (W == 1) {  // a branch pays where no other lane waits
      if (outside) {
        truth = miss;
        return outside;
      }
    }
    const Int inside = x.crosses & (least_w > x.w_error) & (x.bc > x.w_bc_error);
    // The usual range, [0, inf): V(0) is T, and any t is below infinity. Bits tell zero, whatever DAZ says.
    if (L::all_true((Int)((L::as_int(s.t_min) << 1) == 0) & (Int)(s.t_max == infinity))) {
      const Word hit = front | sign_byte(x.T < 0.0, Int{}, t_min_at) | (Word{} + 0xff) << t_max_at;
      truth = outside ? miss : hit;
      return outside | (inside & (L::abs(x.T) > x.T_error));
    }
    Int min_known, max_known;
    const Real past_min = x.versus(s.t_min, min_known), past_max = x.versus(s.t_max, max_known);
    const Word hit = front | sign_byte(past_min < 0.0, Int{}, t_min_at) | sign_byte(past_max < 0.0, Int{}, t_max_at);
    truth = outside ? miss : hit;
    return outside | (inside & min_known & max_known);
  }

  /// What the filter knows of each lane, as KnownSigns.
  static Word known_signs(const Cases& s) {
    const Bounded x(s);
    const auto known_byte = [&](Real v, Int known, int at) {
      return x.crosses & known ? sign_byte(v < 0.0, Int{}, at) : (Word{} + KnownSigns::unknown) << at;
    };
    const auto beyond = [](Real v, Real error) { return (Int)(L::abs(v) > error); };
    Int min_known, max_known;
    const Real past_min = x.versus(s.t_min, min_known), past_max = x.versus(s.t_max, max_known);
    return (x.crosses ? sign_byte(x.sign_bit != 0, Int{}, 0) : Word{} + KnownSigns::unknown) |
           known_byte(x.ab, beyond(x.ab, x.w_error), 8) | known_byte(x.bc, beyond(x.bc, x.w_bc_error), 16) |
           known_byte(x.ca, beyond(x.ca, x.w_error), 24) | known_byte(past_min, min_known, 32) |
           known_byte(past_max, max_known, 40);
  }

  /// The residue stage, of the same form.
  [[gnu::always_inline]] static Int residue(const Cases& s, Word& truth) {
    constexpr int point_bits = 30, direction_bits = 31, tau_shift = 6, tau_reach = 1 << 13;
    constexpr long long exponent_field = 0x7ff0000000000000ll, half = 0x0008000000000000ll;
    const auto magnitude = [](Real x) { return (Int)L::abs(x); };
    const Int m_p = (Int)L::max(L::max(max_norm(s.o), max_norm(s.a)), L::max(max_norm(s.b), max_norm(s.c)));
    const Int m_d = (Int)max_norm(s.d);
    const Int no_direction = (((Int)s.d.x | (Int)s.d.y | (Int)s.d.z) << 1) == 0;
    const Int p_exponent = m_p & exponent_field, d_exponent = m_d & exponent_field;
    const auto biased = [](int e) { return static_cast<long long>(1023 + e) << 52; };
    Int on_grid = (p_exponent > biased(-300)) & (p_exponent < biased(300)) &
                  (((d_exponent > biased(-300)) & (d_exponent < biased(300))) | no_direction);

    // x + 1.5 * 2^52 g is exact where x is a multiple of g below 2^51 g, and then its fraction holds the integer x / g.
    // Exactness is a matter of bits (DAZ would call a subnormal equal to zero), but for the sign of zero.
    const auto integer = [&](Real x, Int magic, Int& lost) {
      const Real sum = x + (Real)magic;
      lost |= (Int)(sum - (Real)magic) ^ (Int)x;
      return (Word)((Int)sum - magic);
    };
    Int lost = Int{};
    const auto integers = [&](const RealVec& v, Int magic) {
      return WordVec{integer(v.x, magic, lost), integer(v.y, magic, lost), integer(v.z, magic, lost)};
    };
    const auto steps = [](int n) { return static_cast<long long>(n) << 52; };
    // Unsigned: of lanes that are left anyway, the exponents may wrap.
    const auto magic = [&](Int exponent, int n) { return (Int)((Word)exponent + (Word)(Int{} + steps(n))) | half; };
    const Int p_magic = magic(p_exponent, 53 - point_bits), d_magic = magic(d_exponent, 53 - direction_bits);
    const WordVec o = integers(s.o, p_magic), d = integers(s.d, d_magic), a = integers(s.a, p_magic),
                  b = integers(s.b, p_magic), c = integers(s.c, p_magic);

    on_grid &= (lost << 1) == 0;

    const Determinants<RealVec> real(s.o, s.d, s.a, s.b, s.c);
    on_grid &= (real.det == real.det) & (real.T == real.T);
    const Determinants<WordVec> word(o, d, a, b, c);
    // 2^62 units of det and of T.
    const auto unit = [&](Int exponent, int bits) { return (Real)((Word)exponent - (Word)(Int{} + steps(bits - 1))); };
    const Real g = unit(p_exponent, point_bits), g_d = unit(d_exponent, direction_bits);
    const Real det_limit = 0x1p+62 * g * g * g_d, T_limit = 0x1p+62 * g * g * g;
    struct Sign { Int negative, zero; };
    const auto sign = [](Real value, Word exact, Real limit) {
      const Int proved = L::abs(value) >= limit;
      return Sign{proved ? (Int)(value < 0.0) : (Int)((Int)exact < 0), ~proved & (Int)(exact == 0)};
    };
    const Sign det = sign(real.det, word.det, det_limit), T = sign(real.T, word.T, T_limit),
               ab = sign(real.w_ab, word.w_ab, det_limit), bc = sign(real.w_bc, word.w_bc, det_limit),
               ca = sign(real.w_ca, word.w_ca, det_limit);

    // tau = m g / (64 g'): the unit of tau by its exponent, m by the same addition as above.
    const Int tau_magic = magic((Int)((Word)p_exponent - (Word)d_exponent),
                                direction_bits - point_bits - tau_shift + 52 + 1023);
    const Real V_limit = 0x1p-6 * T_limit;
    const auto versus = [&](Real tau, Int& known, int at) {
      const Int infinite = magnitude(tau) == exponent_field;
      Int tau_lost = Int{};
      const Word m = integer(tau, tau_magic, tau_lost);
      known = infinite | (((tau_lost << 1) == 0) & (magnitude(tau) < exponent_field) & ((Int)m <= tau_reach) & ((Int)m >= -tau_reach));
      const Sign v = sign(real.T - tau * real.det, (word.T << tau_shift) - m * word.det, V_limit);
      const Int negative = infinite ? (Int)(tau > 0.0) : (Int)(~v.zero & (v.negative ^ det.negative));
      return sign_byte(negative, ~infinite & v.zero, at);
    };
    Int min_known, max_known;
    const Word t_min = versus(s.t_min, min_known, t_min_at), t_max = versus(s.t_max, max_known, t_max_at);

    const auto against = [&](const Sign& w) { return ~w.zero & (w.negative ^ det.negative); };
    const Int outside = against(ab) | against(bc) | against(ca);
    const Int flat = (word.n.x | word.n.y | word.n.z) == 0;
    const auto all = [](auto e) { return Int{} + static_cast<long long>(e); };
    // Interior, edge, vertex: no, one, two zeros.
    const Int zeros = -(ab.zero + bc.zero + ca.zero);
    const Int feature = ab.zero ? (ca.zero ? all(Feature::a) : bc.zero ? all(Feature::b) : all(Feature::ab))
                        : bc.zero ? (ca.zero ? all(Feature::c) : all(Feature::bc))
                                  : (ca.zero ? all(Feature::ca) : all(Feature::none));
    const Word hit = (Word)(zeros | (feature << feature_at)) | t_min | t_max;
    const Word crossing = (outside ? (Word)all(HitClass::exterior) : hit) | sign_byte(det.negative, Int{}, det_sign_at);
    const Int no_crossing = flat ? all(HitClass::degenerate) : T.zero ? all(HitClass::coplanar) : all(HitClass::parallel);
    const Word invalid = Word{} + (static_cast<unsigned long long>(HitClass::invalid) |
                                   static_cast<unsigned long long>(Invalid::zero_direction) << invalid_at);
    truth = no_direction ? invalid : det.zero ? (Word)no_crossing : crossing;
    const Int range_known = (magnitude(s.t_min) <= exponent_field) & (magnitude(s.t_max) <= exponent_field);
    return on_grid & (no_direction | (range_known & (det.zero | outside)) | (min_known & max_known));
  }
};

// Runs both stages over a batch of at most lane_block cases; see LaneStages in batch.h.
template <int W>
class BatchDriver {
  using L = Lanes<W>;
  using Kernel = BatchKernel<W>;
  using Int = typename L::Int;
  using Word = typename L::Word;

 public:
  BatchDriver(const Batch& batch, std::uint32_t* undecided) : batch_(batch), undecided_(undecided) {
    if (batch.one_triangle)
      for (int k = 0; k < 9; ++k) triangle_[k] = L::all(batch.triangle[k][0]);
  }

  LaneCounts run() {
    const auto size = static_cast<std::uint32_t>(batch_.size);
    std::uint32_t i = 0;
    for (; i + W <= size; i += W) decide(i);
    if (i < size) decide_last(i, size - i);
    // Lanes that stood alone among decided ones, brought together.
    for (std::uint32_t k = 0; k < sparse_count_; k += W)
      residue_listed(sparse_ + k, sparse_count_ - k < W ? sparse_count_ - k : W);
    return counts_;
  }

 private:
  void store(std::uint32_t i, Word truth) { std::memcpy(static_cast<void*>(batch_.truths + i), &truth, sizeof truth); }
  void store_lane(std::uint32_t i, const Word& words, std::uint32_t lane) {
    std::memcpy(static_cast<void*>(batch_.truths + i), reinterpret_cast<const char*>(&words) + 8 * lane, 8);
  }

  [[gnu::always_inline]] typename Kernel::Cases load(std::uint32_t i) const {
    const auto ray = [&](int k) { return L::load(batch_.ray[k] + i); };
    const auto corner = [&](int k) { return batch_.one_triangle ? triangle_[k] : L::load(batch_.triangle[k] + i); };
    return {{ray(0), ray(1), ray(2)}, {ray(3), ray(4), ray(5)}, {corner(0), corner(1), corner(2)},
            {corner(3), corner(4), corner(5)}, {corner(6), corner(7), corner(8)}, ray(6), ray(7)};
  }

  typename Kernel::Cases gather(const std::uint32_t* index, std::uint32_t n) const {
    alignas(64) double column[17][W];
    for (std::size_t lane = 0; lane < W; ++lane) {
      const std::size_t i = index[lane < n ? lane : n - 1];
      for (int k = 0; k < 8; ++k) column[k][lane] = batch_.ray[k][i];
      for (int k = 0; k < 9; ++k) column[8 + k][lane] = batch_.triangle[k][batch_.one_triangle ? 0 : i];
    }
    const auto at = [&](int k) { return L::load(column[k]); };
    return {{at(0), at(1), at(2)}, {at(3), at(4), at(5)}, {at(8), at(9), at(10)}, {at(11), at(12), at(13)},
            {at(14), at(15), at(16)}, at(6), at(7)};
  }

  void decide(std::uint32_t i) {
    if (residue_first_) return decide_residue_first(i);
    Word truth{};
    const unsigned open = batch_.skip_filter ? all_lanes : ~L::bits(Kernel::filter(load(i), truth)) & all_lanes;
    store(i, truth);
    if (__builtin_expect(open != 0, 0)) decide_open(i, open, truth);
  }

  // Apart, so that the filter's loop keeps the registers.
  [[gnu::noinline]] void decide_open(std::uint32_t i, unsigned open, Word truth) {
    counts_.past_filter += static_cast<unsigned>(__builtin_popcount(open));
    if (__builtin_popcount(open) * 2 < W) {
      for (unsigned rest = open; rest != 0; rest &= rest - 1)
        sparse_[sparse_count_++] = i + static_cast<unsigned>(__builtin_ctz(rest));
      return;
    }
    if (residue_pause_ != 0) {
      --residue_pause_;
      return list_undecided(i, open);
    }
    Word exact;
    const Int decided = Kernel::residue(load(i), exact);
    const unsigned left = open & ~L::bits(decided);
    if (!batch_.skip_filter) {
      residue_first_ = left != open;
      residue_pause_ = left != open ? 0 : 15;
    }
    store(i, decided ? exact : truth);
    list_undecided(i, left);
  }

  // For data like lattices, of which the filter decides little.
  [[gnu::noinline]] void decide_residue_first(std::uint32_t i) {
    const auto cases = load(i);
    Word exact, truth;
    const Int decided = Kernel::residue(cases, exact);
    const unsigned open = ~L::bits(decided) & all_lanes;
    counts_.past_filter += W;
    if (open == 0) return store(i, exact);
    residue_first_ = __builtin_popcount(open) * 2 < W;
    const unsigned filtered = L::bits(Kernel::filter(cases, truth)) & open;
    counts_.past_filter -= static_cast<unsigned>(__builtin_popcount(filtered));
    store(i, decided ? exact : truth);
    list_undecided(i, open & ~filtered);
  }

  void list_undecided(std::uint32_t i, unsigned lanes) {
    if (lanes == 0) return;
    const Word known = Kernel::known_signs(load(i));
    for (unsigned k = 0; k < W; ++k)
      if (lanes >> k & 1) store_lane(i + k, known, k);
    for (; lanes != 0; lanes &= lanes - 1)
      undecided_[counts_.past_residue++] = i + static_cast<unsigned>(__builtin_ctz(lanes));
  }

  void residue_listed(const std::uint32_t* index, std::uint32_t n) {
    Word truth;
    const auto cases = gather(index, n);
    const unsigned decided = L::bits(Kernel::residue(cases, truth));
    const Word known = Kernel::known_signs(cases);
    for (std::uint32_t lane = 0; lane < n; ++lane) {
      const bool is_decided = decided >> lane & 1;
      store_lane(index[lane], is_decided ? truth : known, lane);
      if (!is_decided) undecided_[counts_.past_residue++] = index[lane];
    }
  }

  // The last group, of n < W cases.
  void decide_last(std::uint32_t from, std::uint32_t n) {
    std::uint32_t lanes[W];
    for (std::uint32_t lane = 0; lane < n; ++lane) lanes[lane] = from + lane;
    Word truth{};
    const unsigned decided = batch_.skip_filter ? 0 : L::bits(Kernel::filter(gather(lanes, n), truth));
    for (std::uint32_t lane = 0; lane < n; ++lane) {
      if (decided >> lane & 1) {
        store_lane(lanes[lane], truth, lane);
      } else {
        ++counts_.past_filter;
        sparse_[sparse_count_++] = lanes[lane];
      }
    }
  }

  static constexpr unsigned all_lanes = (1u << W) - 1;

  const Batch& batch_;
  std::uint32_t* undecided_;
  // What the last groups were like: decided by the residue stage, or by neither, so that it is left out for some groups.
  bool residue_first_ = false;
  unsigned residue_pause_ = 0;
  typename L::Real triangle_[9];
  LaneCounts counts_;
  std::uint32_t sparse_count_ = 0;
  std::uint32_t sparse_[lane_block];
};

}  // namespace
}  // namespace plumbline
