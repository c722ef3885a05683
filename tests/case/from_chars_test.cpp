#include "case/from_chars.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "case/float_bits.h"
#include "case/real_text.h"

namespace plumbline {
namespace {

struct Read {
  std::size_t used = 0;
  std::errc error{};
  std::uint64_t bits = 0;
  friend bool operator==(const Read&, const Read&) = default;
};

Read outcome(const std::string& text, const std::from_chars_result& r, double x) {
  return {static_cast<std::size_t>(r.ptr - text.data()), r.ec, r.ec == std::errc{} ? to_bits(x) : 0};
}

void expect_same(const std::string& text, std::chars_format format) {
  double standard = 0, by_strtod = 0;
  const char *first = text.data(), *last = first + text.size();
  const Read expected = outcome(text, std::from_chars(first, last, standard, format), standard);
  EXPECT_EQ(outcome(text, from_chars_by_strtod(first, last, by_strtod, format), by_strtod), expected) << text;
}

TEST(FromChars, StrtodStopsWhereTheStandardDoes) {
  for (const std::string text :
       {"0", "12", "0.5", ".5", "5.", "1e3", "1E+3", "1e-3", "1e", "1e+", ".", ".e5", "1_0", "1,5", "1..2", "1.5f",
        "0x1", "0X1p3", "1 ", "1p3", "00012", "1.7976931348623158e308", "1e-320"})
    expect_same(text, std::chars_format::general);
  for (const std::string text : {"0", "1.8p+1", ".8", "8.", "1p", "1p+", ".", ".p1", "0x1", "fFp-3", "1.8p+1x", "g",
                                 "1.fffffffffffffp+1023", "0.0000000000001p-1022"})
    expect_same(text, std::chars_format::hex);
}

TEST(FromChars, StrtodRoundsWhatIsOutOfRange) {
  const std::string huge = "1e309", tiny = "1e-400";
  double x = 1;
  EXPECT_EQ(from_chars_by_strtod(huge.data(), huge.data() + huge.size(), x).ec, std::errc{});
  EXPECT_EQ(x, HUGE_VAL);
  EXPECT_EQ(from_chars_by_strtod(tiny.data(), tiny.data() + tiny.size(), x).ec, std::errc{});
  EXPECT_EQ(x, 0);
}

TEST(FromChars, StrtodReadsWhatWeWrite) {
  const auto seed = std::random_device{}();
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  std::mt19937_64 random(seed);
  for (int i = 0; i < 100'000 && !testing::Test::HasFailure(); ++i) {
    const auto bits = random() & (i % 4 ? 0x7fffffffffffffff : 0x000fffffffffffff);  // some are subnormal
    const auto x = from_bits<double>(bits);
    if (!is_finite(x)) continue;
    const std::string hex = hexfloat(x).substr(2), decimal = shortest_decimal(x);
    for (const auto& [text, format] :
         {std::pair(hex, std::chars_format::hex), {decimal, std::chars_format::general}}) {
      double read = -1;
      const char* const last = text.data() + text.size();
      EXPECT_EQ(from_chars_by_strtod(text.data(), last, read, format).ptr, last);
      EXPECT_EQ(to_bits(read), bits) << text;
    }
  }
}

}  // namespace
}  // namespace plumbline
