// The integer stage's numbers against GMP: its determinants, and the comparison of products longer than they are.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include "oracle/explain.h"
#include "oracle/integer_case.h"
#include "oracle/normalized.h"
#include "tests/judges/mpq_judge.h"
#include "tests/judges/seed.h"
#include "tests/oracle/grid_shots.h"

namespace plumbline {
namespace {

mpz_class integer(std::uint64_t x) {
  mpz_class r;
  mpz_import(r.get_mpz_t(), 1, 1, sizeof x, 0, 0, &x);
  return r;
}

mpz_class integer(const Int192& x) {
  const auto high = static_cast<std::int64_t>(x.high >> 64);
  const mpz_class top =
      high < 0 ? mpz_class(-integer(-static_cast<std::uint64_t>(high))) : integer(static_cast<std::uint64_t>(high));
  return (top << 128) + (integer(static_cast<std::uint64_t>(x.high)) << 64) + integer(x.low);
}

// x >= 0, as an integer of 384 bits.
WideInt<6> wide_words(const mpz_class& x) {
  WideInt<6> r;
  mpz_export(r.word, nullptr, -1, sizeof r.word[0], 0, 0, x.get_mpz_t());
  return r;
}

// |x| < 2^191
Int192 words(const mpz_class& x) {
  const mpz_class m = abs(x);
  std::uint64_t word[3] = {};
  mpz_export(word, nullptr, -1, sizeof word[0], 0, 0, m.get_mpz_t());
  const Int192 r{word[0], static_cast<Int128>(static_cast<Word128>(word[2]) << 64 | word[1])};
  return x < 0 ? -r : r;
}

mpq_class in_units(const Int192& x, int unit) {
  const mpz_class scale = mpz_class(1) << static_cast<unsigned>(unit < 0 ? -unit : unit);
  return unit < 0 ? mpq_class(integer(x)) / scale : mpq_class(integer(x) * scale);
}

TEST(IntegerCase, DeterminantsAreExact) {
  Random random(judges::seed());
  int made = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto bits = [&] {
      return static_cast<int>(random() % 2 == 0 ? uniform(random, 1, 61) : uniform(random, 58, 61));
    };
    const Shot shot = draw_on_grids(random, bits(), bits());
    const auto x = IntegerCase::make(shot.triangle, shot.ray);
    if (!x) continue;  // all points zero
    ++made;
    const IntegerDeterminants k(*x);
    const judges::Determinants expected = judges::mpq_determinants(shot.triangle, shot.ray);
    const int unit = 2 * x->point_unit + x->direction_unit;
    ASSERT_EQ(in_units(k.det, unit), expected.det) << explain(shot.triangle, shot.ray);
    ASSERT_EQ(in_units(k.T, 3 * x->point_unit), expected.T) << explain(shot.triangle, shot.ray);
    ASSERT_EQ(in_units(k.w_ab, unit), expected.w_ab) << explain(shot.triangle, shot.ray);
    ASSERT_EQ(in_units(k.w_bc, unit), expected.w_bc) << explain(shot.triangle, shot.ray);
    ASSERT_EQ(in_units(k.w_ca, unit), expected.w_ca) << explain(shot.triangle, shot.ray);
  }
  EXPECT_GT(made, 19000);
}

// x against y * factor, which may have 53 bits more than there are in either: equal, or apart in the last.
template <class ToInteger>
void compare_products(ToInteger to_integer, unsigned most) {
  gmp_randclass random(gmp_randinit_default);
  random.seed(judges::seed());
  const auto number = [&](unsigned bits) -> mpz_class {
    return random.get_z_bits(bits - 1) + (mpz_class(1) << (bits - 1));
  };
  const auto compared = [&](const mpz_class& x, unsigned shift, const mpz_class& y, const mpz_class& factor) {
    Normalized left(to_integer(x)), right(to_integer(y));
    left.exponent += static_cast<int>(shift);
    right *= factor.get_ui();
    return left.compare(right);
  };
  for (unsigned i = 0; i < 20000; ++i) {
    const mpz_class factor = number(1 + i % 53), y = number(1 + i % most);
    const mpz_class product = y * factor;
    const auto bits = static_cast<unsigned>(mpz_sizeinbase(product.get_mpz_t(), 2));
    const unsigned shift = bits > most ? bits - most : 0;
    const mpz_class x = product >> shift, remainder = product - (x << shift);
    ASSERT_EQ(compared(x, shift, y, factor), remainder == 0 ? 0 : -1) << x << ' ' << y << ' ' << factor;
    ASSERT_EQ(compared(x + 1, shift, y, factor), 1) << x << ' ' << y << ' ' << factor;
    if (x > 1) {
      ASSERT_EQ(compared(x - 1, shift, y, factor), -1) << x << ' ' << y << ' ' << factor;
    }
  }
}

TEST(Normalized, ComparesProductsToTheLastBit) {
  ASSERT_NO_FATAL_FAILURE(compare_products(words, 189));
  ASSERT_NO_FATAL_FAILURE(compare_products(wide_words, 381));
}

}  // namespace
}  // namespace plumbline
