#include "case/real_text.h"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <cfloat>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

#include "case/float_bits.h"

namespace plumbline {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double least = 0x1p-1074;

void expect_reads(std::string_view text, double x) {
  const auto read = parse_real(text);
  ASSERT_TRUE(read) << text;
  EXPECT_EQ(to_bits(*read), to_bits(x)) << text << " read as " << *read;
}

TEST(RealText, ReadsDecimals) {
  expect_reads("0", 0);
  expect_reads("-0", -0.0);
  expect_reads("12", 12);
  expect_reads("-0.5", -0.5);
  expect_reads(".5", 0.5);
  expect_reads("5.", 5);
  expect_reads("1e3", 1000);
  expect_reads("1E+3", 1000);
  expect_reads("1e-3", 0.001);
  expect_reads("0.1", 0.1);
}

TEST(RealText, ReadsHexfloats) {
  expect_reads("0x1.8p+1", 3);
  expect_reads("-0X1.8P1", -3);
  expect_reads("0x10", 16);
  expect_reads("0x.8", 0.5);
  expect_reads("-0x0p+0", -0.0);
  expect_reads("0x0.0000000000001p-1022", least);
  expect_reads("0x1.fffffffffffffp+1023", DBL_MAX);
}

TEST(RealText, ReadsWhatIsNoNumber) {
  expect_reads("inf", inf);
  expect_reads("-inf", -inf);
  ASSERT_TRUE(parse_real("nan"));
  EXPECT_TRUE(std::isnan(*parse_real("nan")));
}

TEST(RealText, OverflowIsInfinite) {
  expect_reads("1e309", inf);
  expect_reads("-1e309", -inf);
  expect_reads("1e999999999999999999999", inf);
  expect_reads("1.7976931348623158e308", DBL_MAX);  // the halfway number to infinity is ...15808e308
  expect_reads("1.7976931348623159e308", inf);
  expect_reads(std::string(400, '9'), inf);
  expect_reads("0x1p1024", inf);
  expect_reads("0x1.fffffffffffff7p1023", DBL_MAX);
  expect_reads("-0x1.fffffffffffff8p1023", -inf);
  expect_reads("0x1p99999999999999999999", inf);
  expect_reads("0x0.001p1040", inf);
  expect_reads("0e999999999999999999999", 0);
}

TEST(RealText, UnderflowIsZero) {
  expect_reads("1e-400", 0);
  expect_reads("-1e-400", -0.0);
  expect_reads("1e-999999999999999999999", 0);
  expect_reads("0." + std::string(400, '0') + "1", 0);
  expect_reads("0x1p-1075", 0);  // a tie, to even
  expect_reads("0x1.0000000000001p-1075", least);
  expect_reads("-0x1p-99999999999999999999", -0.0);
  expect_reads("2.4703282292062327e-324", 0);
  expect_reads("2.4703282292062328e-324", least);
}

TEST(RealText, RefusesEverythingElse) {
  for (const char* text : {"",         " ",   "1 ",   " 1",   "+1",  "--1",    "-",    ".",     "e5",        "1e",
                           "1e+",      "1_0", "1,5",  "0x",   "0x.", "0xp1",   "0x-1", "0xinf", "0x1p",      "1p3",
                           "infinity", "INF", "+inf", "-nan", "NaN", "nan(0)", "1.5f", "1..2",  "0x1.8p+1x", "one"})
    EXPECT_FALSE(parse_real(text)) << text;
}

TEST(RealText, WritesHexfloats) {
  EXPECT_EQ(hexfloat(1.5), "0x1.8p+0");
  EXPECT_EQ(hexfloat(0.0), "0x0p+0");
  EXPECT_EQ(hexfloat(-0.0), "-0x0p+0");
  EXPECT_EQ(hexfloat(-inf), "-inf");
  EXPECT_EQ(hexfloat(std::nan("")), "nan");
  EXPECT_EQ(hexfloat(least), "0x0.0000000000001p-1022");
}

TEST(RealText, WritesShortestDecimals) {
  EXPECT_EQ(shortest_decimal(0.1), "0.1");
  EXPECT_EQ(shortest_decimal(-0.0), "-0");
  EXPECT_EQ(shortest_decimal(1e22), "1e+22");
  EXPECT_EQ(shortest_decimal(least), "5e-324");
  EXPECT_EQ(shortest_decimal(inf), "inf");
  EXPECT_EQ(shortest_decimal(-std::nan("")), "nan");
}

TEST(RealText, AnyDoubleSurvives) {
  const auto seed = std::random_device{}();
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  std::mt19937_64 random(seed);
  for (int i = 0; i < 200'000; ++i) {
    const double x = from_bits<double>(i % 4 ? random() : random() & 0x800fffffffffffff);  // some are subnormal
    if (is_nan(x)) continue;
    expect_reads(hexfloat(x), x);
    expect_reads(shortest_decimal(x), x);
    if (is_finite(x)) {
      char printed[64];
      std::snprintf(printed, sizeof printed, "%a", x);
      EXPECT_EQ(hexfloat(x), printed);
    }
    if (testing::Test::HasFailure()) return;
  }
}

// The exact value of a double; that of infinity is where the next binade would begin, so that rounding goes there as if
// the exponents went on.
mpq_class exact(double x) {
  if (is_finite(x)) return mpq_class(x);
  mpz_class power = 1;
  power <<= 1024;
  return x < 0 ? mpq_class(-power) : mpq_class(power);
}

void expect_nearest(const std::string& text, const mpq_class& value) {
  const auto read = parse_real(text);
  ASSERT_TRUE(read) << text;
  const double magnitude = std::fabs(*read);
  const mpq_class error = abs(exact(magnitude) - abs(value));
  const bool even = to_bits(magnitude) % 2 == 0;
  for (const int step : {-1, 1}) {
    if ((magnitude == 0 && step < 0) || (magnitude == inf && step > 0)) continue;
    const mpq_class other = abs(exact(step_ulps(magnitude, step)) - abs(value));
    EXPECT_TRUE(even ? error <= other : error < other) << text << " read as " << hexfloat(*read);
  }
}

// Not against strtod: that of glibc 2.36 is wrong in rare subnormal hexfloats, such as 0x.f5a2f0fc0e602cp-1022.
TEST(RealText, RoundsToNearest) {
  const auto seed = std::random_device{}();
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  std::mt19937_64 random(seed);
  const auto between = [&random](int low, int high) { return std::uniform_int_distribution(low, high)(random); };
  for (int i = 0; i < 40'000; ++i) {
    const bool hex = i % 2;
    const int base = hex ? 16 : 10;
    std::string digits;
    for (int k = between(1, 30); k > 0; --k) digits += "0123456789abcdef"[between(0, 2) ? between(0, base - 1) : 0];
    const int places = between(0, static_cast<int>(digits.size()));
    const int exponent = hex ? (between(0, 1) ? between(-1160, -1000) : between(900, 1100))
                             : (between(0, 1) ? between(-350, -280) : between(270, 320));
    std::string text = digits;
    text.insert(text.size() - places, ".");
    text = (hex ? "0x" : "") + text + (hex ? "p" : "e") + std::to_string(exponent);

    mpz_class power;
    mpz_ui_pow_ui(power.get_mpz_t(), hex ? 2 : 10, std::abs(exponent));
    mpz_class scale;
    mpz_ui_pow_ui(scale.get_mpz_t(), base, places);
    mpq_class value(mpz_class(digits, base), scale);
    value.canonicalize();
    if (exponent < 0) {
      value /= power;
    } else {
      value *= power;
    }
    expect_nearest(text, value);
    if (testing::Test::HasFailure()) return;
  }
}

}  // namespace
}  // namespace plumbline
