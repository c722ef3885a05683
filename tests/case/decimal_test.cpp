#include "case/decimal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "case/input_error.h"

namespace plumbline {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

Decimal parse(std::string_view text) { return parse_decimal(text, "step"); }

TEST(Decimal, IsParsedExactly) {
  EXPECT_EQ(parse("1.5"), (Decimal{15, -1}));
  EXPECT_EQ(parse("0.05"), (Decimal{5, -2}));
  EXPECT_EQ(parse("1e-3"), (Decimal{1, -3}));
  EXPECT_EQ(parse("-.25"), (Decimal{-25, -2}));
  EXPECT_EQ(parse("+2."), (Decimal{2, 0}));
  EXPECT_EQ(parse("12.5E+3"), (Decimal{125, 2}));
  EXPECT_EQ(parse("999999999999999999"), (Decimal{999999999999999999, 0}));
}

TEST(Decimal, HasNoTrailingZeros) {
  EXPECT_EQ(parse("1.50"), parse("1.5"));
  EXPECT_EQ(parse("100"), (Decimal{1, 2}));
  EXPECT_EQ(parse("-0.00e7"), Decimal{});
  EXPECT_EQ(parse("1.0000000000000000000000000000"), (Decimal{1, 0}));
}

TEST(Decimal, BecomesTheNearestDouble) {
  EXPECT_EQ(to_double(parse("0.1")), 0x1.999999999999ap-4);
  EXPECT_EQ(to_double(parse("-0.05")), -0x1.999999999999ap-5);
  EXPECT_EQ(to_double(parse("9007199254740993")), 0x1p53);  // a tie, to even
  EXPECT_EQ(to_double(parse("9007199254740995")), 0x1.0000000000002p53);
  EXPECT_EQ(to_double(parse("1e300")), 0x1.7e43c8800759cp996);
  EXPECT_EQ(to_double(parse("1e-300")), 0x1.56e1fc2f8f359p-997);
  EXPECT_EQ(to_double({-1, -322}), -0x0.0000000000014p-1022);
}

TEST(Decimal, CountsUnits) {
  EXPECT_EQ(in_units(parse("2"), -2, "box"), 200);
  EXPECT_EQ(in_units(parse("-0.05"), -2, "offset"), -5);
  EXPECT_EQ(in_units(Decimal{}, -30, "offset"), 0);
  EXPECT_THAT([] { in_units({2, 0}, -18, "box"); }, ThrowsMessage<InputError>(HasSubstr("box: 2e0")));
}

TEST(Decimal, RefusesWhatIsNoNumber) {
  for (const char* text :
       {"", "-", ".", "abc", "1.5x", "1.2.3", "nan", "inf", "1e", "1e+-3", "0x1p3", "1,5", " 1", "--1"})
    EXPECT_THAT([&] { parse(text); }, ThrowsMessage<InputError>(AllOf(HasSubstr("step '" + std::string(text) + "'"),
                                                                      HasSubstr("write it like 1.5"))))
        << text;
}

TEST(Decimal, RefusesWhatIsTooLongOrTooLarge) {
  EXPECT_THAT([] { parse("1.000000000000000001"); }, ThrowsMessage<InputError>(HasSubstr("18 significant digits")));
  for (const char* text : {"1e301", "-1e301", "1e-301", "1e99999999999999999999", "1e-99999999999999999999"})
    EXPECT_THAT([&] { parse(text); }, ThrowsMessage<InputError>(HasSubstr("out of range"))) << text;
}

}  // namespace
}  // namespace plumbline
