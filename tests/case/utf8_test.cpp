#include "case/utf8.h"

#include <gtest/gtest.h>

#include "case/json_object.h"

namespace plumbline {
namespace {

constexpr const char* bad = "\xef\xbf\xbd";

std::string bads(int n) { return n == 0 ? "" : bad + bads(n - 1); }

TEST(Utf8, WhatIsUtf8StaysAsItIs) {
  // The first and the last character of each length, and those beside the surrogates.
  for (const std::string text : {"", "plain\n", "\x7f", "\xc2\x80", "\xdf\xbf", "\xe0\xa0\x80", "\xed\x9f\xbf",
                                 "\xee\x80\x80", "\xef\xbf\xbf", "\xf0\x90\x80\x80", "\xf4\x8f\xbf\xbf"})
    EXPECT_EQ(as_utf8(text), text);
  EXPECT_EQ(as_utf8(std::string_view("a\0b", 3)), std::string("a\0b", 3));
}

TEST(Utf8, EachByteThatIsNoneIsReplaced) {
  EXPECT_EQ(as_utf8("a\xff" "b"), std::string("a") + bad + "b");
  EXPECT_EQ(as_utf8("\x80"), bads(1));              // begins nothing
  EXPECT_EQ(as_utf8("\xc1\xbf"), bads(2));          // longer than need be
  EXPECT_EQ(as_utf8("\xe0\x9f\xbf"), bads(3));
  EXPECT_EQ(as_utf8("\xf0\x8f\xbf\xbf"), bads(4));
  EXPECT_EQ(as_utf8("\xed\xa0\x80"), bads(3));      // a surrogate
  EXPECT_EQ(as_utf8("\xf4\x90\x80\x80"), bads(4));  // beyond U+10FFFF
  EXPECT_EQ(as_utf8("\xf5\x80\x80\x80"), bads(4));
  EXPECT_EQ(as_utf8("\xe2\x82"), bads(2));          // cut off
  EXPECT_EQ(as_utf8("\xf0\x9f\x92" "a"), bads(3) + "a");
}

TEST(Utf8, JsonHoldsNothingElse) {
  std::string out;
  append_json_string(out, "\"\xff\x01");
  EXPECT_EQ(out, std::string("\"\\\"") + bad + "\\u0001\"");
}

}  // namespace
}  // namespace plumbline
