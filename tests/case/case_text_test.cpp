#include "case/case_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "tests/case/error_of.h"
#include "tests/case/random_case.h"

namespace plumbline {
namespace {

using testing::HasSubstr;

constexpr std::string_view geometry =
    "triangle 0 0 0  1 0 0  0 1 0\n"
    "ray 0.25 0.25 1  0 0 -1\n";

std::string error_in(const std::string& text) {
  return error_of([&] { parse_cases(text, "f.case"); });
}

TEST(CaseText, ReadsEveryKey) {
  const auto cases = parse_cases(
      "# a file may begin with remarks\n"
      "\n"
      "# found by fuzz\n"
      "#\n"
      "#  shrunk\n"
      "case grazing-3f2a   # a remark\n"
      "known woop_watertight_f32 false-miss # known\n"
      "known other false-hit\n"
      "  range 0x0p+0 inf\r\n"
      "expect edge ca hit v 0 u 0.5 t 0x1p+0\n"
      "aim tolerance 0x1p-10 wish hit standoff 5\n"
      "mode plate orientation ccw thickness 0.1 position appended cosine false\n"
      "ray 0.25 0.25 1  0 0 -1\n"
      "# in between: no provenance\n"
      "triangle 0 0 0  1 0 0  0 1 0\n"
      "triangle 0 0 2\t1 0 2  0 1 2\n"
      "precision binary32\n"
      "case next\n" +
          std::string(geometry),
      "f.case");
  ASSERT_EQ(cases.size(), 2u);
  Case expected{.id = "grazing-3f2a",
                .provenance = {},
                .precision = Precision::binary32,
                .bag = {.triangles = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 0, 2}, {1, 0, 2}, {0, 1, 2}}},
                        .mode = BagMode::plate,
                        .thickness = 0.1,
                        .position = PlatePosition::appended,
                        .cosine = false,
                        .orientation = Orientation::ccw},
                .ray = {{0.25, 0.25, 1}, {0, 0, -1}},
                .aim = Aim{TargetKind::tolerance, 0x1p-10, 5, Wish::hit},
                .expect = Expectation{HitClass::edge, Feature::ca, true, 1, 0.5, 0},
                .known = {}};
  expected.provenance = {"found by fuzz", "", " shrunk"};
  expected.known = {{"woop_watertight_f32", VerdictKind::false_miss}, {"other", VerdictKind::false_hit}};
  EXPECT_EQ(cases[0], expected);
  EXPECT_EQ(cases[1].id, "next");
  EXPECT_TRUE(cases[1].provenance.empty());
}

TEST(CaseText, LinesMayEndWithCarriageReturns) {
  const auto cases =
      parse_cases("# a\rremark\r\r\r\n#\r\r\ncase x\r\r\n\r\r\n" + std::string(geometry), "f.case");
  ASSERT_EQ(cases.size(), 1u);
  EXPECT_EQ(cases[0].id, "x");
  EXPECT_EQ(cases[0].provenance, (std::vector<std::string>{"a\rremark", ""}));
  EXPECT_EQ(parse_cases(to_text(cases[0]), "again"), cases);
}

TEST(CaseText, WritesOneOrder) {
  const std::string text =
      "# by hand\n"
      "case one\n"
      "precision binary32\n"
      "triangle 0x0p+0 0x0p+0 0x0p+0   0x1p+0 0x0p+0 0x0p+0   0x0p+0 0x1p+0 0x0p+0\n"
      "ray 0x1p-2 0x1p-2 0x1p+0   -0x0p+0 0x0p+0 -0x1p+0\n"
      "range 0x0p+0 inf\n"
      "mode plate thickness 0x1.999999999999ap-4 position centred cosine true orientation none\n"
      "aim vertex_edge standoff 0x1.4p+2 wish hit\n"
      "expect vertex c hit t 0x1p+0\n"
      "known brlcad_bot_classic false-miss\n";
  const auto cases = parse_cases(text, "f.case");
  ASSERT_EQ(cases.size(), 1u);
  EXPECT_EQ(to_text(cases[0]), text);
}

TEST(CaseText, AnyCaseSurvives) {
  const auto seed = std::random_device{}();
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  RandomCase random(seed);
  for (int i = 0; i < 5000; ++i) {
    Case made = random();
    random.annotate(made);
    const std::string text = to_text(made);
    const auto back = parse_cases(text, "f.case");
    ASSERT_EQ(back.size(), 1u);
    ASSERT_EQ(back[0], made) << text;
    ASSERT_TRUE(same_bits(back[0], made)) << text;
  }
}

TEST(CaseText, RefusesToWriteWhatWouldNotReadBack) {
  Case made = parse_cases("case x\n" + std::string(geometry), "f.case").front();
  for (const char* id : {"", "two words", "a#b", "line\nbreak"}) {
    made.id = id;
    EXPECT_NE(error_of([&] { to_text(made); }), "") << id;
  }
  made.id = "x";
  made.provenance = {"two\nlines"};
  EXPECT_THAT(error_of([&] { to_text(made); }), HasSubstr("case 'x'"));
  made.provenance.clear();
  made.bag.thickness = 0.1;
  EXPECT_THAT(error_of([&] { to_text(made); }), HasSubstr("only a plate may have thickness"));
  made.bag.thickness = 0;
  made.ray.origin.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(error_of([&] { to_text(made); }), HasSubstr("NaN"));
}

TEST(CaseText, SkipsAByteOrderMark) {
  const std::string mark = "\xef\xbb\xbf";
  EXPECT_EQ(parse_cases(mark + "case x\n" + std::string(geometry), "f.case").size(), 1u);
  EXPECT_EQ(parse_cases(mark + "# from where\ncase x\n" + std::string(geometry), "f.case")[0].provenance.size(), 1u);
  EXPECT_NE(error_in("case x\n" + mark + std::string(geometry)), "");
}

TEST(CaseText, NothingIsNoCase) {
  EXPECT_TRUE(parse_cases("", "f.case").empty());
  EXPECT_TRUE(parse_cases("# only a remark", "f.case").empty());
}

TEST(CaseText, ErrorsNameThePlaceAndTheFix) {
  const std::string g(geometry);
  EXPECT_EQ(error_in("case x\ntrianlge 0 0 0\n"), "f.case:2:1: unknown key 'trianlge'; did you mean 'triangle'?");
  EXPECT_EQ(error_in("case x\n  colour red\n"),
            "f.case:2:3: unknown key 'colour'; known: case, precision, triangle, ray, range, mode, aim, expect, known");
  EXPECT_EQ(error_in("ray 0 0 1 0 0 1\n"), "f.case:1:1: 'ray' before any case; begin with a line 'case ID'");
  EXPECT_EQ(error_in("case\n"), "f.case:1:5: the case's id is missing");
  EXPECT_EQ(error_in("case x y\n"), "f.case:1:8: 'y' is too much on this line; remove it, or put '#' before it");
  EXPECT_EQ(error_in("\ncase x\nray 0 0 1 0 0 1\n"),
            "f.case:2:1: case 'x' has no triangle; add a line 'triangle' and 9 numbers");
  EXPECT_EQ(error_in("case x\ntriangle 0 0 0 1 0 0 0 1 0\ncase y\n"),
            "f.case:1:1: case 'x' has no ray; add a line 'ray' and 6 numbers");
  EXPECT_EQ(error_in("case x\n" + g + "ray 0 0 1 0 0 1\n"),
            "f.case:4:1: a second 'ray' in this case; remove one of them");
  EXPECT_EQ(error_in("case x\ntriangle 0 0 0 1 0 0 0 1\n"), "f.case:2:25: vertex c, z is missing");
  EXPECT_EQ(error_in("case x\ntriangle 0 0 0 1 0 0 0 1 0 7\n"),
            "f.case:2:28: '7' is too much on this line; remove it, or put '#' before it");
  EXPECT_EQ(error_in("case x\nray 0 0 0 0 0 1,5\n"),
            "f.case:2:15: '1,5' is no number (ray direction, z); write 0x1.8p+0, 1.5, inf or -inf");
  EXPECT_EQ(error_in("case x\nray 0 nan 0 0 0 1\n"), "f.case:2:7: a NaN (ray origin, y); write a number, inf or -inf");
  EXPECT_EQ(error_in("case x\nrange nan inf\n"), "f.case:2:7: a NaN (t_min); write a number, inf or -inf");
  EXPECT_EQ(error_in("case x\nprecision binary16\n"),
            "f.case:2:11: unknown precision 'binary16'; did you mean 'binary32'?");
  EXPECT_EQ(error_in("case x\nmode solod\n"), "f.case:2:6: unknown mode 'solod'; did you mean 'solid'?");
  EXPECT_EQ(error_in("case x\nmode plate thickness -1\n"), "f.case:2:22: thickness must be finite and not negative");
  EXPECT_EQ(error_in("case x\nmode plate cosine maybe\n"), "f.case:2:19: unknown cosine 'maybe'; known: false, true");
  EXPECT_EQ(error_in("case x\nmode plate colour\n"),
            "f.case:2:12: unknown part of mode 'colour'; known: thickness, position, cosine, orientation");
  EXPECT_EQ(error_in("case x\nmode plate cosine true\n"),
            "f.case:2:19: a plate without thickness; add 'thickness 0.1'");
  EXPECT_EQ(error_in("case x\nmode solid orientation cw thickness 1\n"),
            "f.case:2:27: 'thickness' is of a plate; remove it, or write 'mode plate'");
  EXPECT_EQ(error_in("case x\n" + g + "case y\n" + g + "case x\n" + g),
            "f.case:7:6: a second case 'x', the first is on line 1; rename one of them");
  EXPECT_EQ(error_in("{\"id\":1,\"triangle\":[]}\n"),
            "f.case:1:1: this is JSON, and .case text is expected: lines 'case ID', 'triangle', 'ray'");
  EXPECT_THAT(error_in("case x\n" + std::string(99, 'y')),
              HasSubstr(":2:1: unknown key '" + std::string(40, 'y') + "...'"));
  EXPECT_EQ(error_in("case x\naim tolerance standoff 5\n"),
            "f.case:2:15: 'standoff' is no number (tolerance); write 0x1.8p+0, 1.5, inf or -inf");
  EXPECT_EQ(error_in("case x\naim interior wish\n"), "f.case:2:18: wish is missing");
  EXPECT_EQ(error_in("case x\nexpect edgy\n"), "f.case:2:8: unknown class 'edgy'; did you mean 'edge'?");
  EXPECT_EQ(error_in("case x\nexpect edge maybe\n"),
            "f.case:2:13: unknown part of expect 'maybe'; known: hit, miss, t, u, v");
  EXPECT_EQ(error_in("case x\nknown t false_miss\n"),
            "f.case:2:9: unknown verdict 'false_miss'; did you mean 'false-miss'?");
  EXPECT_EQ(error_in("case x\nknown t correct\n"),
            "f.case:2:9: 'correct' is no finding; write false-miss, false-hit, leak, wrong-nearest or fault");
  EXPECT_EQ(error_in("case x\n" + g + "range 0.1 1\nprecision binary32\n"),
            "f.case:4:7: 0x1.999999999999ap-4 is no binary32 number; round it, or write 'precision binary64'");
  EXPECT_THAT(error_of([] { read_cases("/no/such/file.case"); }),
              HasSubstr("/no/such/file.case: cannot be opened: No such file or directory"));
}

// A file of somebody else's writes nothing to the terminal but its words.
TEST(CaseText, ErrorsEscapeWhatTheyQuote) {
  const std::string error = error_in("case x\n\x1b[2Jray\xff 1\n");
  EXPECT_THAT(error, HasSubstr("\\x1b[2Jray\\xff"));
  EXPECT_EQ(error.find_first_of("\x1b\xff\n"), std::string::npos);
}

}  // namespace
}  // namespace plumbline
