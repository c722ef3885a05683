#include "repros/text.h"

#include <gtest/gtest.h>

#include <limits>

namespace plumbline {
namespace {

TEST(Fill, ReplacesNamedPlaces) {
  EXPECT_EQ(fill("", {}), "");
  EXPECT_EQ(fill("@A@", {{"A", "x"}}), "x");
  EXPECT_EQ(fill("<@A@@B@@A@>", {{"A", "x"}, {"B", ""}}), "<xx>");
  EXPECT_EQ(fill("a@b @AB@ @A @@A@", {{"A", "x"}, {"AB", "y"}}), "a@b y @A @x");
}

TEST(Fill, DoesNotSearchWhatItPutIn) { EXPECT_EQ(fill("@A@ @B@", {{"A", "@B@"}, {"B", "@A@"}}), "@B@ @A@"); }

TEST(Harmless, IsOneLineOfPrintableAscii) {
  EXPECT_EQ(harmless(""), "");
  EXPECT_EQ(harmless(" a~*/ '\" <script>; DROP TABLE x;"), " a~*/ '\" <script>; DROP TABLE x;");
  EXPECT_EQ(harmless("a\nb\r\t"), "a\\x0ab\\x0d\\x09");
  EXPECT_EQ(harmless(std::string_view("\0\x7f", 2)), "\\x00\\x7f");
  EXPECT_EQ(harmless("\xe2\x80\xa8"), "\\xe2\\x80\\xa8");  // ends a line in JavaScript
  EXPECT_EQ(harmless("end\\"), "end\\x5c");                // goes on on the next line in C
  EXPECT_EQ(harmless("{}"), "\\x7b\\x7d");                 // counted by asc2g
}

TEST(Commented, PutsALeaderBeforeEachLine) {
  EXPECT_EQ(commented("", "// "), "");
  EXPECT_EQ(commented("a", "// "), "// a\n");
  EXPECT_EQ(commented("a\n\n b\n", "# "), "# a\n#\n#  b\n");
}

TEST(CNumber, LosesNoBit) {
  EXPECT_EQ(c_number(1, Precision::binary32), "0x1p+0f");
  EXPECT_EQ(c_number(-0.0, Precision::binary64), "-0x0p+0");
  EXPECT_EQ(c_number(0x1.fffffffffffffp-1, Precision::binary64), "0x1.fffffffffffffp-1");
  EXPECT_EQ(c_number(0x1p-149, Precision::binary32), "0x1p-149f");
  EXPECT_EQ(c_number(std::numeric_limits<double>::infinity(), Precision::binary32), "INFINITY");
  EXPECT_EQ(c_number(-std::numeric_limits<double>::infinity(), Precision::binary64), "-INFINITY");
  EXPECT_EQ(c_numbers({1, -2, 0.5}, Precision::binary64), "0x1p+0, -0x1p+1, 0x1p-1");
}

TEST(Decimals, AreTheShortest) {
  EXPECT_EQ(decimals({0.1, -0.0, 1e300}), "0.1, -0, 1e+300");
  EXPECT_EQ(decimals({1, 2, 3}, " "), "1 2 3");
}

}  // namespace
}  // namespace plumbline
