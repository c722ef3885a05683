// Where the residue stage changes from residue to sign: determinants next to +-2^63, of which the residue alone has the
// wrong sign and binary64 a rounding error on the other side, and multiples of 2^64.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "oracle/explain.h"
#include "tests/judges/mpq_judge.h"
#include "tests/judges/print.h"
#include "tests/oracle/float_environment.h"
#include "tests/oracle/stages.h"

namespace plumbline {
namespace {

// The residue stages' answers agree with mpq in every rounding mode, and are given.
void expect_decided(const Shot& shot) {
  const Truth expected = judges::mpq_truth(shot.triangle, shot.ray);
  for (const Isa isa : all_isas())
    for (const FloatEnvironment& environment : float_environments()) {
      std::optional<Truth> answer;
      {
        const FloatScope scope(environment);
        answer = ask({Stage::residue, isa}, shot);
      }
      ASSERT_TRUE(answer.has_value()) << name(isa);
      ASSERT_EQ(*answer, expected) << name(isa) << ' ' << environment << '\n' << explain(shot.triangle, shot.ray);
    }
}

struct Edges {
  Vec3 e1, e2;
};

// Edges with (e1 x e2).x = n, exactly, and other components small; `y` < 2^31 is e1's.
Edges edges_with_normal(std::int64_t n, std::int64_t y) {
  const std::int64_t z = n / y + 1;
  return {{0, static_cast<double>(y), static_cast<double>(y * z - n)}, {0, 1, static_cast<double>(z)}};
}

// A at `a` from the origin, which is placed so that all coordinates stay below 2^30: they are differences of two.
Shot shot_of(const Vec3& a, const Edges& edges, const Vec3& direction) {
  const auto half = [](double x) { return std::floor(x / 2); };
  const auto all_of = [](double p, double to_a, double e1, double e2) {
    return std::array{p, p + to_a, p + to_a + e1, p + to_a + e2};
  };
  const Vec3 o = {-half(a.x), -half(a.y + edges.e1.y), -half(a.z + std::max(edges.e1.z, edges.e2.z))};
  const auto x = all_of(o.x, a.x, edges.e1.x, edges.e2.x), y = all_of(o.y, a.y, edges.e1.y, edges.e2.y),
             z = all_of(o.z, a.z, edges.e1.z, edges.e2.z);
  return {{{x[1], y[1], z[1]}, {x[2], y[2], z[2]}, {x[3], y[3], z[3]}}, {{x[0], y[0], z[0]}, direction}};
}

// k and edges such that k (e1 x e2).x is 2^bits or just above.
template <class Check>
void for_all_at(int bits, Check check) {
  for (const int k : {3, 5, 7, 9, 11, 13})
    for (const int above : {0, 1, 5, 100}) {
      const auto n = static_cast<std::int64_t>(((std::uint64_t{1} << bits) + static_cast<unsigned>(k) - 1) /
                                               static_cast<unsigned>(k)) +
                     above;
      constexpr std::int64_t reach = (1ll << 31) - 8;  // of differences
      for (std::int64_t y = std::max(std::int64_t{1} << 30, n / reach) + 12345; y < reach; y += 98765432)
        check(k, edges_with_normal(n, y));
    }
}

TEST(ResidueWrap, DeterminantsNextTo2To63) {
  for_all_at(63, [](int k, const Edges& edges) {
    for (const double sign : {1.0, -1.0}) {
      ASSERT_NO_FATAL_FAILURE(expect_decided(shot_of({5, 0, 0}, edges, {sign * k, 0, 0})));
      ASSERT_NO_FATAL_FAILURE(expect_decided(shot_of({sign * k, 0, 0}, edges, {0, 1, 0})));
    }
  });
}

// w_AB = e1 . (D x a), w_CA = -e2 . (D x a): the same numbers with the roles changed.
TEST(ResidueWrap, OtherDeterminantsNextTo2To63) {
  for_all_at(63, [](int k, const Edges& cross) {
    const double x = k;
    for (const double sign : {1.0, -1.0}) {
      ASSERT_NO_FATAL_FAILURE(expect_decided(shot_of(cross.e2, {{sign * x, 0, 0}, {1, 7, 3}}, cross.e1)));
      ASSERT_NO_FATAL_FAILURE(expect_decided(shot_of(cross.e2, {{1, 7, 3}, {sign * x, 0, 0}}, cross.e1)));
      ASSERT_NO_FATAL_FAILURE(expect_decided(shot_of(cross.e2, {{3, 1, 2}, {3 + sign * x, 1, 2}}, cross.e1)));
    }
  });
}

// 64 T next to 2^63, t_min = 0: the unit of V is 64 times finer. The hit is at A + (e1 + e2) / 4.
TEST(ResidueWrap, DifferencesNextTo2To63) {
  for_all_at(57, [](int k, const Edges& edges) {
    for (const double sign : {1.0, -1.0}) {
      Shot shot = shot_of({sign * k, 0, 0}, edges, {1, 0, 0});
      ASSERT_NO_FATAL_FAILURE(expect_decided(shot));
      const auto middle = [](double p, double q, double r) { return std::round((2 * p + q + r) / 4); };
      const auto& [a, b, c] = shot.triangle;
      shot.ray.origin.y = middle(a.y, b.y, c.y);
      shot.ray.origin.z = middle(a.z, b.z, c.z);
      ASSERT_NO_FATAL_FAILURE(expect_decided(shot));
    }
  });
}

TEST(ResidueWrap, MultiplesOf2To64) {
  for (int i = 15; i <= 29; ++i)
    for (int j = 15; j <= 29; ++j)
      for (int k = 1; k <= 30; k += 3) {
        const double x = std::ldexp(1, i), y = std::ldexp(1, j), z = std::ldexp(1, k);
        for (const double sign : {1.0, -1.0}) {
          ASSERT_NO_FATAL_FAILURE(
              expect_decided({{{0, 0, sign}, {x, 0, sign}, {0, y, sign}}, {{x / 4, y / 4, 0}, {0, 0, z}}}));
          ASSERT_NO_FATAL_FAILURE(
              expect_decided({{{0, 0, 4}, {x, 0, 4}, {0, y, 4}}, {{-x / 4, y / 4, 0}, {0, 0, sign * z}}}));
          ASSERT_NO_FATAL_FAILURE(expect_decided(
              {{{0, 0, x / 2}, {x, 0, x / 2}, {0, y, x / 2}}, {{x / 4, y / 4, sign * x / 2}, {0, x, 0}}}));
        }
      }
}

}  // namespace
}  // namespace plumbline
