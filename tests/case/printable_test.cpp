#include "case/printable.h"

#include <gtest/gtest.h>

namespace plumbline {
namespace {

using std::string_literals::operator""s;

TEST(Printable, LeavesTextAlone) {
  for (const std::string text : {"", "moller_trumbore_f64", "a b \\ \" ' <script>", "\xc2\xa0", "\xe2\x82\xac", "\xf4\x8f\xbf\xbf"}) {
    EXPECT_EQ(printable(text), text);
    EXPECT_EQ(valid_utf8(text), text);
  }
}

TEST(Printable, EscapesControlCharacters) {
  EXPECT_EQ(printable("a\nb\tc\x1b[2J\x7f\0"s), "a\\nb\\tc\\x1b[2J\\x7f\\x00");
  EXPECT_EQ(printable("\xc2\x9b"), "\\xc2\\x9b");  // C1: another way to begin an escape sequence
  EXPECT_EQ(valid_utf8("a\n\x1b\0"s), "a\n\x1b\0"s);  // JSON has its own escapes for these
}

TEST(Printable, EscapesWhatIsNoUtf8) {
  for (const auto& [bytes, escaped] : {std::pair{"\xff", "\\xff"}, {"\xc3", "\\xc3"}, {"\xc0\x80", "\\xc0\\x80"},
                                       {"\xed\xa0\x80", "\\xed\\xa0\\x80"}, {"\xe2\x82", "\\xe2\\x82"},
                                       {"\xf4\x90\x80\x80", "\\xf4\\x90\\x80\\x80"}, {"\xe2(", "\\xe2("}}) {
    EXPECT_EQ(printable(bytes), escaped);
    EXPECT_EQ(valid_utf8(bytes), escaped);
  }
}

}  // namespace
}  // namespace plumbline
