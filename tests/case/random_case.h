// Cases of random bits, with every optional part now there, now not.
#pragma once
#include <cmath>
#include <random>

#include "case/case.h"
#include "case/float_bits.h"

namespace plumbline {

class RandomCase {
 public:
  explicit RandomCase(std::uint64_t seed) : random_(seed) {}

  Case operator()() {
    Case made;
    made.precision = coin() ? Precision::binary32 : Precision::binary64;
    const auto x = [&] { return made.precision == Precision::binary32 ? number<float>() : number<double>(); };
    const auto p = [&] { return Vec3{x(), x(), x()}; };
    made.id = "case-" + std::to_string(random_());
    for (auto n = 1 + random_() % 3; n > 0; --n) made.bag.triangles.push_back({p(), p(), p()});
    made.ray = {p(), p()};
    if (coin()) made.ray.t_min = x();
    if (coin()) made.ray.t_max = x();
    if (coin()) {
      made.bag.mode = pick<BagMode>(bag_mode_names.size());
      if (made.bag.mode == BagMode::plate) {
        made.bag.thickness = length();
        made.bag.position = pick<PlatePosition>(plate_position_names.size());
        made.bag.cosine = coin();
      }
      made.bag.orientation = pick<Orientation>(orientation_names.size());
    }
    if (coin()) {
      Aim& aim = made.aim.emplace();
      aim.target = pick<TargetKind>(target_kind_names.size());
      aim.standoff = length();
      aim.wish = pick<Wish>(wish_names.size());
      if (aim.target == TargetKind::tolerance) aim.tolerance = length();
    }
    return made;
  }

  /// What the .case text has and NDJSON has not.
  void annotate(Case& made) {
    for (auto n = random_() % 3; n > 0; --n) made.provenance.push_back(coin() ? "  found by hand # really" : "");
    if (coin()) {
      Expectation& expect = made.expect.emplace();
      expect.hit_class = pick<HitClass>(hit_class_names.size());
      expect.feature = pick<Feature>(feature_names.size());
      if (coin()) expect.hit = coin();
      if (coin()) expect.t = number<double>();
      if (coin()) expect.u = number<double>();
      if (coin()) expect.v = number<double>();
    }
    for (auto n = random_() % 3; n > 0; --n)
      made.known.push_back({"tracer_" + std::to_string(n), coin() ? VerdictKind::false_miss : VerdictKind::false_hit});
  }

 private:
  bool coin() { return random_() % 2; }

  template <class Enum>
  Enum pick(std::size_t size) {
    return static_cast<Enum>(random_() % size);
  }

  // Any bits but those of a NaN; often a zero, an infinity or a subnormal.
  template <class Real>
  double number() {
    using F = FloatFormat<Real>;
    auto bits = static_cast<typename F::Bits>(random_());
    switch (random_() % 8) {
      case 0:
        bits &= F::sign_bit;
        break;
      case 1:
        bits = (bits & F::sign_bit) | F::exponent_mask;
        break;
      case 2:
        bits &= F::sign_bit | F::fraction_mask;
        break;
      default:
        break;
    }
    const Real x = from_bits<Real>(bits);
    return is_nan(x) ? 1 : static_cast<double>(x);
  }

  double length() { return std::ldexp(static_cast<double>(random_() >> 11), -60); }

  std::mt19937_64 random_;
};

/// Whether all numbers have the same bits, as == can't tell of zeros.
inline bool same_bits(const Vec3& p, const Vec3& q) {
  return to_bits(p.x) == to_bits(q.x) && to_bits(p.y) == to_bits(q.y) && to_bits(p.z) == to_bits(q.z);
}
inline bool same_bits(const Case& p, const Case& q) {
  if (p.bag.triangles.size() != q.bag.triangles.size()) return false;
  for (std::size_t i = 0; i < p.bag.triangles.size(); ++i) {
    const Triangle &s = p.bag.triangles[i], &t = q.bag.triangles[i];
    if (!same_bits(s.a, t.a) || !same_bits(s.b, t.b) || !same_bits(s.c, t.c)) return false;
  }
  return same_bits(p.ray.origin, q.ray.origin) && same_bits(p.ray.direction, q.ray.direction) &&
         to_bits(p.ray.t_min) == to_bits(q.ray.t_min) && to_bits(p.ray.t_max) == to_bits(q.ray.t_max);
}

}  // namespace plumbline
