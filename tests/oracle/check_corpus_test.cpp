#include "oracle/check_corpus.h"

#include <gmock/gmock.h>

#include <fstream>

#include "tests/case/error_of.h"
#include "tests/fuzz/scratch.h"
#include "tests/several.h"

namespace plumbline {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

class CheckCorpus : public testing::Test {
 protected:
  // What is told of a tracer that answers all cases so.
  std::string check(const std::string& text, std::optional<bool> hits, const Contract& contract = {}) {
    std::ofstream(file_) << text;
    return check_corpus(
        file_, {.name = "mine", .contract = contract, .hits = [hits](const Triangle&, const Ray&) { return hits; }});
  }

  Scratch scratch_;
  const std::string file_ = scratch_.path() / "x.case";
};

const std::string inside = "case x\ntriangle 0 0 0  1 0 0  0 1 0\nray 0.25 0.25 1  0 0 -1\n";
const std::string edge = "case x\ntriangle 0 0 0  1 0 0  0 1 0\nray 0.5 0.5 1  0 0 -1\n";

TEST_F(CheckCorpus, NothingIsToldOfWhatIsAsStated) {
  EXPECT_EQ(check(inside, true), "");
  EXPECT_EQ(check(inside, std::nullopt), "");
  EXPECT_EQ(check(inside + "known mine false-miss\n", false), "");
  EXPECT_EQ(check(inside + "known mine fault\n", std::nullopt), "");
  EXPECT_EQ(check(inside + "known other false-miss\n", true), "");
}

TEST_F(CheckCorpus, AWrongAnswerWithItsMargin) {
  // From (0.25, 0.25) it is as far to edge ab as to edge ca.
  EXPECT_THAT(
      check("\n" + inside, false),
      AllOf(StartsWith(file_ + ":2: x: mine: new false-miss, severity 0.25 (1.13e+15 ulps)\n"),
            HasSubstr("class      interior"), HasSubstr("asks       must hit"), HasSubstr("verdict    false-miss")));
  EXPECT_THAT(check(inside + "known mine false-miss\n", true),
              StartsWith(file_ + ":1: x: mine: known as false-miss, it is now correct; remove the line 'known'\n"));
}

TEST_F(CheckCorpus, ItIsJudgedByItsContract) {
  EXPECT_EQ(check(edge, true), "");
  EXPECT_THAT(check(edge, false), HasSubstr("new false-miss, severity 0 (0 ulps)"));
  EXPECT_EQ(check(edge, false, {.edges = EdgeRule::open}), "");
  EXPECT_THAT(check(edge, true, {.edges = EdgeRule::open}), HasSubstr("new false-hit"));
  EXPECT_EQ(check(edge, true, {.edges = EdgeRule::unspecified}), "");
}

TEST_F(CheckCorpus, ItIsGivenNumbersOfItsPrecision) {
  std::ofstream(file_) << "case x\ntriangle 0 0 0  1 0 0  0 1 0\nray 0.1 0.1 1  0 0 -1\n";
  double x = 0;
  const auto look = [&x](const Triangle&, const Ray& ray) { return x = ray.origin.x, true; };
  EXPECT_EQ(check_corpus(file_, {.name = "mine", .hits = look}), "");
  EXPECT_EQ(x, 0.1);
  EXPECT_EQ(check_corpus(file_, {.name = "mine", .contract = {.precision = Precision::binary32}, .hits = look}), "");
  EXPECT_EQ(x, static_cast<double>(0.1f));
}

TEST_F(CheckCorpus, AnExpectationThatIsntTheTruth) {
  EXPECT_EQ(check(inside + "expect edge ab\n", true),
            file_ + ":1: x: expected class edge, it is interior; expected feature ab, it is none\n");
}

TEST_F(CheckCorpus, Trouble) {
  EXPECT_EQ(error_of([&] { check("", true); }), file_ + ": no case in this file");
  const auto nowhere = [&] { check_corpus(file_ + ".none", {.name = "mine", .hits = {}}); };
  EXPECT_THAT(error_of(nowhere), HasSubstr("x.case.none: cannot be opened"));
}

TEST_F(CheckCorpus, SeveralTrianglesAreHitIfOneIs) {
  EXPECT_EQ(check(leaking_pair, true), "");
  EXPECT_EQ(check(leaking_pair, std::nullopt), "");
  EXPECT_EQ(check(leaking_pair + "known mine leak\n", false), "");
  EXPECT_THAT(check(leaking_pair, false),
              AllOf(StartsWith(file_ + ":1: pair: mine: new leak, severity "), HasSubstr("crossed    2 of 2 triangles"),
                    HasSubstr("triangle 1: interior, from the "), HasSubstr("verdict    leak: ")));
  EXPECT_THAT(check(leaking_pair + "known mine leak\n", true), HasSubstr("known as leak, it is now correct; remove"));
  EXPECT_THAT(check("case x\ntriangle 0 0 0  1 0 0  0 1 0\ntriangle 9 9 0  8 9 0  9 8 0\nray 2 0 1  0 0 -1\n", true),
              HasSubstr("mine: new false-hit, severity 1 "));
  // What is hit first, a function of one triangle can't say.
  EXPECT_EQ(check(leaking_pair + "known mine wrong-nearest\n", true), "");
}

}  // namespace
}  // namespace plumbline
