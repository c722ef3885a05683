// What the tests of this folder share: the set {0, 1.5, 3}^3, and the comparison of a truth with a judge's.
#pragma once
#include <gtest/gtest.h>

#include <cstdint>

#include "case/geometry.h"
#include "oracle/classify.h"
#include "oracle/contact.h"
#include "oracle/explain.h"
#include "tests/judges/integer_judge.h"
#include "tests/judges/print.h"

namespace plumbline::judges {

/// Class and signs, and contact where the class leaves it open. For use with ASSERT_NO_FATAL_FAILURE.
inline void expect_agreement(const Triangle& triangle, const Ray& ray, const Truth& truth, const Judged& judged) {
  ASSERT_EQ(truth, judged.truth) << explain(triangle, ray);
  if (truth.hit_class != HitClass::coplanar && truth.hit_class != HitClass::degenerate) return;
  ASSERT_EQ(touches(triangle, ray), judged.touches) << explain(triangle, ray);
}

/// Case `index` of the 27^5 with origin, target, a, b, c in {0, 1.5, 3}^3. The ray goes to the target, where t = 1 is
/// the end of its range [0.5, 1].
struct LatticeCase {
  static constexpr std::uint64_t count = 14348907;
  IntVec origin, direction, a, b, c;  ///< in steps of 1.5
  Triangle triangle;
  Ray ray;

  explicit LatticeCase(std::uint64_t index) {
    const auto point = [&index] {
      const auto k = static_cast<std::int64_t>(index % 27);
      index /= 27;
      return IntVec{k / 9, k / 3 % 3, k % 3};
    };
    const auto real = [](const IntVec& k) {
      return Vec3{1.5 * static_cast<double>(k[0]), 1.5 * static_cast<double>(k[1]), 1.5 * static_cast<double>(k[2])};
    };
    c = point(), b = point(), a = point();
    const IntVec target = point();
    origin = point();
    direction = {target[0] - origin[0], target[1] - origin[1], target[2] - origin[2]};
    triangle = {real(a), real(b), real(c)};
    ray = {real(origin), real(direction), 0.5, 1};
  }
  Judged integer_judged() const { return judges::integer_judged(a, b, c, origin, direction, 2, 4); }
};

}  // namespace plumbline::judges
