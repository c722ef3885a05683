// The wide integers against GMP, and which cases are taken for 125-bit integers.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "oracle/quotient.h"
#include "oracle/wide_case.h"
#include "tests/judges/mpq_judge.h"
#include "tests/judges/seed.h"
#include "tests/oracle/grid_shots.h"

namespace plumbline {
namespace {

template <int words>
mpz_class integer(const WideInt<words>& x) {
  mpz_class r;
  mpz_import(r.get_mpz_t(), words, -1, sizeof x.word[0], 0, 0, x.word);
  return x.is_negative() ? mpz_class(r - (mpz_class(1) << (64 * words))) : r;
}

// 0, +-1, the ends of the range, single bits and runs of bits, and random numbers of every length.
template <int words>
std::vector<WideInt<words>> samples(Random& random) {
  std::vector<WideInt<words>> list;
  WideInt<words> one;
  one.word[0] = 1;
  for (int k = 0; k < 64 * words; ++k) {
    WideInt<words> bit;
    bit.word[k / 64] = std::uint64_t{1} << (k % 64);
    list.insert(list.end(), {bit, bit - one, -bit, one - bit});
  }
  for (int i = 0; i < 2000; ++i) {
    WideInt<words> x;
    const auto bits = static_cast<int>(uniform(random, 1, 64 * words - 1));
    for (int k = 0; k < words; ++k)
      if (bits > 64 * k) x.word[k] = bits >= 64 * k + 64 ? random() : random() >> (64 * k + 64 - bits);
    list.push_back(random() % 2 == 0 ? x : -x);
  }
  return list;
}

// As a WideInt holds it: modulo 2^(64 words), with a sign.
mpz_class wrapped(const mpz_class& x, int words) {
  const mpz_class modulus = mpz_class(1) << static_cast<unsigned>(64 * words);
  mpz_class r;
  mpz_fdiv_r(r.get_mpz_t(), x.get_mpz_t(), modulus.get_mpz_t());
  return 2 * r >= modulus ? mpz_class(r - modulus) : r;
}

template <int m, int n>
void check_products(Random& random) {
  const auto left = samples<m>(random);
  const auto right = samples<n>(random);
  for (std::size_t i = 0; i < left.size(); ++i) {
    const auto& x = left[i];
    const auto& y = right[random() % right.size()];
    ASSERT_EQ(integer(x * y), integer(x) * integer(y)) << m << ' ' << n;
  }
  WideInt<m> least_m;
  WideInt<n> least_n;
  least_m.word[m - 1] = least_n.word[n - 1] = std::uint64_t{1} << 63;
  ASSERT_EQ(integer(least_m * least_n), integer(least_m) * integer(least_n));
}

template <int words>
void check_sums(Random& random) {
  const auto list = samples<words>(random);
  for (const auto& x : list) {
    const auto& y = list[random() % list.size()];
    ASSERT_EQ(integer(x + y), wrapped(integer(x) + integer(y), words));
    ASSERT_EQ(integer(x - y), wrapped(integer(x) - integer(y), words));
    ASSERT_EQ(integer(-x), wrapped(-integer(x), words));
    ASSERT_EQ(x.sign(), sgn(integer(x)));
  }
}

TEST(WideInt, ProductsSumsAndSignsAreThoseOfGmp) {
  Random random(judges::seed());
  std::printf("seed %llu\n", static_cast<unsigned long long>(judges::seed()));
  ASSERT_NO_FATAL_FAILURE((check_products<2, 2>(random)));
  ASSERT_NO_FATAL_FAILURE((check_products<2, 4>(random)));
  ASSERT_NO_FATAL_FAILURE((check_products<4, 4>(random)));
  ASSERT_NO_FATAL_FAILURE(check_sums<2>(random));
  ASSERT_NO_FATAL_FAILURE(check_sums<4>(random));
  ASSERT_NO_FATAL_FAILURE(check_sums<6>(random));
  ASSERT_NO_FATAL_FAILURE(check_sums<8>(random));
}

TEST(WideInt, TruncatedKeepsTheFirst53Bits) {
  Random random(judges::seed() + 1);
  for (const auto& x : samples<6>(random)) {
    const mpz_class exact = integer(x);
    ASSERT_EQ(mpz_class(truncated(x)), mpz_class(exact.get_d()));  // GMP truncates
  }
  EXPECT_EQ(truncated(WideInt<6>{}), 0);
  EXPECT_FALSE(std::signbit(truncated(WideInt<6>{})));
}

TEST(RoundedQuotient, OfWideIntegersIsRoundedOrNotThere) {
  Random random(judges::seed() + 2);
  const auto list = samples<6>(random);
  int rounded = 0;
  for (const auto& n : list) {
    const auto& d = list[random() % list.size()];
    if (d.sign() == 0) continue;
    const auto q = rounded_quotient<double>(n, d, 0);
    if (!q) continue;
    ++rounded;
    // Within half an ulp of q.
    const mpq_class exact = mpq_class(integer(n)) / integer(d), off = abs(exact - mpq_class(*q));
    const double a = std::abs(*q);
    ASSERT_LE(off, (mpq_class(std::nextafter(a, INFINITY)) - mpq_class(a)) / 2) << exact;
  }
  EXPECT_GT(rounded, static_cast<int>(list.size()) * 9 / 10);
}

// The widest cases: every pattern of signs of coordinates of 125 bits.
TEST(WideCase, DeterminantsOfTheLargestCoordinatesAreExact) {
  constexpr double most = 0x1.fffffffffffffp+124, least = 1;
  for (unsigned signs = 0; signs < 1u << 15; signs += 3) {
    const auto vec = [signs](int first) {
      const auto x = [&](int k) { return (signs >> k & 1) != 0 ? -most : most; };
      return Vec3{x(first), x(first + 1), x(first + 2)};
    };
    Shot shot{{vec(0), vec(3), vec(6)}, {vec(9), vec(12)}};
    if (signs % 2 == 0) shot.triangle.a.x = least;
    if (signs % 5 == 0) shot.ray.direction.z = -least;
    const auto x = WideCase::make(shot.triangle, shot.ray);
    ASSERT_TRUE(x.has_value());
    ASSERT_EQ(x->point_unit, 0);
    ASSERT_EQ(x->direction_unit, 0);
    const auto normal = cross(x->b - x->a, x->c - x->a);
    const judges::Determinants expected = judges::mpq_determinants(shot.triangle, shot.ray);
    ASSERT_EQ(mpq_class(integer(dot(x->direction, normal))), expected.det);
    ASSERT_EQ(mpq_class(integer(dot(x->a - x->origin, normal))), expected.T);
    ASSERT_EQ(mpq_class(integer(dot(x->direction, cross(x->b - x->origin, x->c - x->origin)))), expected.w_bc);
    const mpz_class square = integer(dot(normal, normal));
    mpz_class sum;
    for (const auto& k : normal) sum += integer(k) * integer(k);
    ASSERT_EQ(square, sum);
  }
}

// One coordinate has its lowest bit at 2^low, the largest is 2^high.
Shot spanning(int low, int high, std::size_t which, std::size_t largest) {
  Shot shot{{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {{0, 0, 0}, {0, 0, 0}}};
  const std::array<double*, 12> points = {&shot.ray.origin.x, &shot.ray.origin.y, &shot.ray.origin.z,
                                          &shot.triangle.a.x, &shot.triangle.a.y, &shot.triangle.a.z,
                                          &shot.triangle.b.x, &shot.triangle.b.y, &shot.triangle.b.z,
                                          &shot.triangle.c.x, &shot.triangle.c.y, &shot.triangle.c.z};
  *points[largest] = -std::ldexp(1.0, high);
  *points[which] = std::ldexp(1.0, low);
  return shot;
}

TEST(WideCase, Takes125BitsAndNoMore) {
  for (const int unit : {-1074, -1073, -1022, -500, 0, 500, 898})
    for (std::size_t which = 0; which < 12; ++which) {
      const std::size_t largest = (which + 5) % 12;
      const auto fits = spanning(unit, unit + 124, which, largest),
                 wide = spanning(unit, unit + 125, which, largest);
      const auto x = WideCase::make(fits.triangle, fits.ray);
      ASSERT_TRUE(x.has_value()) << unit << ' ' << which;
      EXPECT_EQ(x->point_unit, unit);
      EXPECT_FALSE(WideCase::make(wide.triangle, wide.ray)) << unit << ' ' << which;
    }
  for (const int unit : {-1074, -300, 0, 898})
    for (const int bits : {1, 53, 54, 72, 73, 124, 125, 126, 200}) {
      const Ray ray{{}, {std::ldexp(1.0, unit), 0, -std::ldexp(1.0, unit + bits - 1)}};
      EXPECT_EQ(WideCase::make({}, ray).has_value(), bits <= 125) << unit << ' ' << bits;
    }
}

// A significand of 53 bits whose last one is just inside, or just outside.
TEST(WideCase, LosesNoBitOfASignificand) {
  for (int binades = 60; binades <= 90; ++binades) {
    const Triangle t{{0x1p+124, 0, 0}, {0, std::ldexp(0x1.0000000000001p+0, 124 - binades), 0}, {}};
    EXPECT_EQ(WideCase::make(t, Ray{}).has_value(), binades <= 72) << binades;
    const Triangle short_one{{0x1p+124, 0, 0}, {0, std::ldexp(0x1p+0, 124 - binades), 0}, {}};
    EXPECT_TRUE(WideCase::make(short_one, Ray{}).has_value());
  }
}

TEST(WideCase, NoneOfWhatIsNotFinite) {
  for (const double bad : {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                           std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_FALSE(WideCase::make({{0, 0, bad}, {}, {}}, Ray{}));
    EXPECT_FALSE(WideCase::make({}, Ray{{bad, 0, 0}, {0, 0, 1}}));
    EXPECT_FALSE(WideCase::make({}, Ray{{}, {0, bad, 1}}));
  }
  EXPECT_TRUE(WideCase::make({}, Ray{{-0.0, 0, 0}, {0, -0.0, 0}}));
}

}  // namespace
}  // namespace plumbline
