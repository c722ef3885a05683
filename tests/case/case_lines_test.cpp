#include "case/case_lines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <limits>
#include <random>
#include <vector>

#include "case/case_json.h"
#include "case/input_file.h"
#include "tests/case/error_of.h"
#include "tests/case/random_case.h"

namespace plumbline {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

constexpr double inf = std::numeric_limits<double>::infinity();

// A file with this text, for the life of the object.
class TextFile {
 public:
  explicit TextFile(const std::string& text) : path_(testing::TempDir() + "case_lines_" + std::to_string(getpid())) {
    std::ofstream(path_, std::ios::binary) << text;
  }
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;
  ~TextFile() { std::remove(path_.c_str()); }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

std::vector<CaseLine> lines_of(const std::string& text) {
  const TextFile file(text);
  CaseLines lines(file.path());
  std::vector<CaseLine> all;
  for (CaseLine line; lines.next(line);) all.push_back(line);
  return all;
}

// Without the file's name.
std::string error_in(const std::string& text) {
  const std::string error = error_of([&] { lines_of(text); });
  return error.substr(std::min(error.find(':'), error.size()));
}

const std::string question = R"("triangle":[[0,0,0],[1,0,0],[0,1,0]],"origin":[0.25,0.25,1],"direction":[0,0,-1])";

TEST(CaseLines, ReadsEveryKeyOfAQuestion) {
  const auto lines =
      lines_of(R"({"id":7,"precision":"binary64","triangle":[[0,0,0],[1,0,0],[0,1,0]],)"
               R"("origin":["0x1p-2",0.25,1e0],"direction":[0,-0,"-inf"],"t_min":"-inf","t_max":12.5,)"
               R"("mode":"plate","thickness":0.1,"position":"appended","cosine":false,"orientation":"cw",)"
               R"("target":"tolerance","tolerance":1e-5,"standoff":5,"wish":"miss"})");
  ASSERT_EQ(lines.size(), 1u);
  const Case expected{.id = "7",
                      .provenance = {},
                      .bag = {.triangles = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
                              .mode = BagMode::plate,
                              .thickness = 0.1,
                              .position = PlatePosition::appended,
                              .cosine = false,
                              .orientation = Orientation::cw},
                      .ray = {{0.25, 0.25, 1}, {0, 0, -inf}, -inf, 12.5},
                      .aim = Aim{TargetKind::tolerance, 1e-5, 5, Wish::miss},
                      .expect = {},
                      .known = {}};
  EXPECT_EQ(lines[0].asked, expected);
  EXPECT_TRUE(is_negative(lines[0].asked.ray.direction.y));
  EXPECT_EQ(lines[0].id, "7");
  EXPECT_FALSE(lines[0].answer);
}

TEST(CaseLines, DefaultsAndBlankLines) {
  const auto lines =
      lines_of("\n  \r\n{" + question + "}\r\n\n{" + question + R"(,"t_max":null})");  // no newline at the end
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].id, "null");
  EXPECT_EQ(lines[0].asked.ray, (Ray{{0.25, 0.25, 1}, {0, 0, -1}}));
  EXPECT_EQ(lines[1].asked.ray, lines[0].asked.ray);
  EXPECT_TRUE(lines_of("").empty());
}

TEST(CaseLines, SkipsAByteOrderMark) {
  const std::string mark = "\xef\xbb\xbf";
  EXPECT_EQ(lines_of(mark + "{" + question + "}\n{" + question + "}").size(), 2u);
  EXPECT_TRUE(lines_of(mark).empty());
  EXPECT_EQ(error_in(mark + "{\"trianlge\":1}"), ":1:2: unknown key 'trianlge'; did you mean 'triangle'?");
  EXPECT_NE(error_in("{" + question + "}\n" + mark + "{" + question + "}"), "");
}

TEST(CaseLines, NonFiniteCoordinatesAreData) {
  const auto lines = lines_of(R"({"triangle":[["nan",1e999,"inf"],[-1e999,0,0],[0,1e-999,0]],"origin":[0,0,0],)"
                              R"("direction":[0,0,1],"t_min":"nan"})");
  ASSERT_EQ(lines.size(), 1u);
  const Triangle& t = lines[0].asked.bag.triangles[0];
  EXPECT_TRUE(is_nan(t.a.x));
  EXPECT_EQ(t.a.y, inf);
  EXPECT_EQ(t.a.z, inf);
  EXPECT_EQ(t.b.x, -inf);
  EXPECT_EQ(t.c.y, 0);
  EXPECT_TRUE(is_nan(lines[0].asked.ray.t_min));
}

TEST(CaseLines, EchoesAnyScalarId) {
  for (const std::string id :
       {"1", "-1.50e+3", "true", "false", "null", R"("")", R"("a \"b\" \u00e4 é \\")", "18446744073709551616"}) {
    const auto lines = lines_of("{\"id\": " + id + " ," + question + "}");
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(lines[0].id, id);
  }
  EXPECT_EQ(lines_of(R"({"id":"a\tb",)" + question + "}")[0].asked.id, "a\tb");
}

TEST(CaseLines, ReadsAnswers) {
  const auto lines =
      lines_of("{" + question +
               R"(,"hit":true,"t":1,"u":0.25,"v":"nan","in":null,"out":null,"triangle_index":3,"tracer":"me"})" + "\n" +
               "{" + question + R"(,"hit":true,"t":null,"u":null,"v":null,"in":"0x1p-1","out":1})" + "\n" +  //
               "{" + question + R"(,"hit":false})" + "\n" +                                                  //
               "{" + question + R"(,"hit":null,"fault":true})");
  ASSERT_EQ(lines.size(), 4u);
  const Answer& full = *lines[0].answer;
  EXPECT_EQ(full.outcome, Outcome::hit);
  EXPECT_TRUE(full.has_t && full.has_uv && !full.has_segment);
  EXPECT_EQ(full.t, 1);
  EXPECT_EQ(full.u, 0.25);
  EXPECT_TRUE(is_nan(full.v));
  EXPECT_EQ(full.triangle, 3u);
  EXPECT_EQ(lines[0].tracer, "me");
  const Answer& segment = *lines[1].answer;
  EXPECT_TRUE(!segment.has_t && !segment.has_uv && segment.has_segment);
  EXPECT_EQ(segment.in, 0.5);
  EXPECT_EQ(segment.out, 1);
  EXPECT_EQ(lines[1].tracer, "");
  EXPECT_EQ(lines[2].answer->outcome, Outcome::miss);
  EXPECT_EQ(lines[3].answer->outcome, Outcome::fault);
}

TEST(CaseLines, AnyCaseSurvives) {
  const auto seed = std::random_device{}();
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  RandomCase random(seed);
  std::vector<Case> made;
  std::string text;
  for (int i = 0; i < 5000; ++i) {
    made.push_back(random());
    append_json(text, made.back());
  }
  const auto back = lines_of(text);
  ASSERT_EQ(back.size(), made.size());
  for (std::size_t i = 0; i < made.size(); ++i) {
    ASSERT_EQ(back[i].asked, made[i]) << made[i].id;
    ASSERT_TRUE(same_bits(back[i].asked, made[i])) << made[i].id;
  }
}

TEST(CaseLines, AnyTextSurvives) {
  std::string id;
  for (int c = 1; c < 128; ++c) id += static_cast<char>(c);
  Case made = lines_of("{" + question + "}")[0].asked;
  made.id = id + "äß€\U0001d11e";
  std::string text;
  append_json(text, made);
  EXPECT_EQ(lines_of(text)[0].asked, made);
}

TEST(CaseLines, ErrorsNameThePlaceAndTheFix) {
  EXPECT_EQ(error_in("\n{\"trianlge\":1}"), ":2:2: unknown key 'trianlge'; did you mean 'triangle'?");
  EXPECT_THAT(error_in("{\"colour\":1}"), HasSubstr(":1:2: unknown key 'colour'; known: id, triangle, "));
  EXPECT_EQ(error_in("{" + question + ",\"origin\":[0,0,0]}"),
            ":1:83: a second 'origin' in this object; remove one of them");
  EXPECT_EQ(error_in("[1,2]"), ":1:1: not a JSON object; each line is one, in braces");
  EXPECT_EQ(error_in("12"), ":1:1: not a JSON object; each line is one, in braces");
  EXPECT_THAT(error_in("{" + question), HasSubstr(":1:82: malformed JSON: "));
  EXPECT_THAT(error_in("{\"id\":\"x"), HasSubstr(":1:9: malformed JSON: "));
  EXPECT_THAT(error_in("{\"id\":1 \"origin\":[0,0,0]}"), HasSubstr(":1:9: malformed JSON: "));
  EXPECT_THAT(error_in("{\"id\":\"\xff\"}"), HasSubstr("malformed JSON: "));
  EXPECT_THAT(error_in("{" + question + "} {}"), HasSubstr(":1:84: more follows the object"));
  EXPECT_THAT(error_in("{" + question + "}}"), HasSubstr(":1:83: more follows the object"));
  EXPECT_EQ(error_in("{\"id\":[1]}"), ":1:7: key 'id': expected a string, number, true, false or null, not an array");
  EXPECT_THAT(error_in("{\"id\":01}"), EndsWith(", not 01"));
  EXPECT_EQ(
      error_in("{\"origin\":[0,true,0]}"),
      ":1:14: key 'origin': expected a number, or a string with a hexfloat, \"inf\", \"-inf\" or \"nan\", not true");
  for (const std::string number :
       {"01", "1.", ".5", "+1", "0x10", "1e", "1e+", "-", "NaN", "Infinity", "1x", "\"one\"", "\"\"", "null"})
    EXPECT_NE(error_in("{\"origin\":[" + number + ",0,0]}"), "") << number;
  EXPECT_EQ(error_in("{\"origin\":[0,0]}"), ":1:11: key 'origin': 2 of 3 numbers");
  EXPECT_EQ(error_in("{\"origin\":[0,0,0,0]}"), ":1:11: key 'origin': more than 3 numbers");
  EXPECT_EQ(error_in("{\"origin\":7}"), ":1:11: key 'origin': expected an array, not 7");
  EXPECT_EQ(error_in("{\"triangle\":[[0,0,0],[0,0,0]]}"), ":1:13: key 'triangle': 2 of 3 vertices");
  EXPECT_EQ(error_in("{\"mode\":\"solod\"}"), ":1:9: unknown mode 'solod'; did you mean 'solid'?");
  EXPECT_EQ(error_in("{\"mode\":1}"), ":1:9: key 'mode': expected a string, not 1");
  EXPECT_EQ(error_in("{\"cosine\":1}"), ":1:11: key 'cosine': expected true or false, not 1");
  EXPECT_EQ(error_in("{\"thickness\":-1}"),
            ":1:14: key 'thickness': expected a finite number that is not negative, not -1");
  EXPECT_EQ(error_in("{\"triangle_index\":0.5}"),
            ":1:19: key 'triangle_index': expected a whole number from 0, not 0.5");
  EXPECT_EQ(error_in("{\"origin\":[0,0,0],\"direction\":[0,0,1]}"),
            ":1:1: no triangle; add \"triangle\":[[x,y,z],[x,y,z],[x,y,z]]");
  EXPECT_EQ(error_in("{\"triangle\":[[0,0,0],[1,0,0],[0,1,0]],\"origin\":[0,0,0]}"),
            ":1:1: key 'direction' is missing; add \"direction\":[x,y,z]");
  EXPECT_EQ(error_in("{\"triangles\":[]," + question + "}"),
            ":1:1: both 'triangle' and 'triangles'; remove one of them");
  EXPECT_EQ(error_in("{\"wish\":\"hit\"," + question + "}"),
            ":1:1: 'tolerance', 'standoff' and 'wish' need a 'target'; add \"target\":\"interior\"");
  EXPECT_EQ(error_in("{\"mode\":\"plate\"," + question + "}"),
            ":1:1: a plate without 'thickness'; add \"thickness\":0.1");
  for (const std::string part : {R"("thickness":0.1)", R"("position":"centred")", R"("cosine":true)"}) {
    EXPECT_EQ(error_in("{" + part + "," + question + "}"),
              ":1:1: 'thickness', 'position' and 'cosine' are of a plate; add \"mode\":\"plate\", or remove them");
    EXPECT_NE(error_in("{\"mode\":\"solid\"," + part + "," + question + "}"), "");
  }
  EXPECT_EQ(error_in("{\"hit\":1," + question + "}"), ":1:8: key 'hit': expected true, false or null, not 1");
  EXPECT_EQ(error_in("{\"t\":1," + question + "}"),
            ":1:1: an answer without 'hit'; add \"hit\":true, false, or null for a fault");
  EXPECT_EQ(error_in("{\"precision\":\"binary32\",\"t_max\":0.1," + question + "}"),
            ":1:1: 0.1 is no binary32 number; round it, or leave out 'precision'");
  EXPECT_THAT(error_of([] { CaseLines("/no/such/file"); }), HasSubstr("/no/such/file: cannot be opened: No such file"));
  EXPECT_THAT(error_of([] {
                CaseLine line;
                CaseLines("/").next(line);
              }),
              HasSubstr("/: cannot be read: Is a directory"));
}

// Every proper prefix of a line is an error, never a crash or a case.
TEST(CaseLines, TruncationIsNoticed) {
  const std::string line = R"({"id":"é\n",)" + question + R"(,"t_max":null,"hit":true,"t":1.5e0})";
  for (std::size_t size = 1; size < line.size(); ++size)
    EXPECT_NE(error_in(line.substr(0, size)), "") << line.substr(0, size);
  EXPECT_EQ(error_in(line), "");
}

// Any one byte put anywhere: a case or an InputError, nothing else.
TEST(CaseLines, StrayBytesDoNoHarm) {
  const std::string line = R"({"id":1,)" + question + R"(,"t_max":null})";
  for (std::size_t at = 0; at < line.size(); ++at) {
    for (const char c : std::string_view("\"\\{}[],:0-e.x\x01\xc3", 16)) {
      std::string changed = line;
      changed[at] = c;
      error_in(changed);
    }
  }
}

TEST(InputFile, LinesOfAnyLength) {
  std::string text;
  std::vector<std::string> expected;
  for (const std::size_t size : {0, 1, 65535, 65536, 65537, 300000, 5}) {
    expected.emplace_back(size, 'x');
    text += expected.back() + "\n";
  }
  expected.emplace_back("end");
  const TextFile file(text + "end");
  InputFile lines(file.path());
  std::vector<std::string> got;
  for (std::string_view line; lines.next_line(line);) got.emplace_back(line);
  EXPECT_EQ(got, expected);
  EXPECT_EQ(lines.line_number(), expected.size());
}

TEST(AnswerReader, ReadsAnAnswerWithoutItsCase) {
  AnswerReader reader("out");
  const AnswerLine hit = reader.read(R"({"id":"a","hit":true,"t":"0x1p-1","u":0.25,"v":0.5,"triangle_index":2})");
  EXPECT_EQ(hit.id, R"("a")");
  EXPECT_EQ(hit.answer.outcome, Outcome::hit);
  EXPECT_TRUE(hit.answer.has_t && hit.answer.has_uv);
  EXPECT_EQ(hit.answer.t, 0x1p-1);
  EXPECT_EQ(hit.answer.triangle, 2u);
  const AnswerLine fault = reader.read(R"({"hit":null})");
  EXPECT_EQ(fault.id, "null");
  EXPECT_EQ(fault.answer.outcome, Outcome::fault);
  EXPECT_EQ(reader.read("{" + question + R"(,"id":3,"hit":false,"precision":"binary32"})").id, "3");
}

TEST(AnswerReader, TellsTheLineThatIsWrong) {
  AnswerReader reader("out");
  reader.read(R"({"id":1,"hit":true})");
  EXPECT_THAT(error_of([&] { reader.read(R"({"id":2})"); }), HasSubstr("out:2:1: an answer without 'hit'"));
  EXPECT_THAT(error_of([&] { reader.read(R"({"id":3,"hit":tr)"); }), HasSubstr("out:3:"));
  EXPECT_THAT(error_of([&] { reader.read(""); }), HasSubstr("out:4:"));
  EXPECT_EQ(reader.read(R"({"id":5,"hit":true})").id, "5");  // goes on
}

}  // namespace
}  // namespace plumbline
