// What people are told of several triangles.
#include "oracle/bag/explain_bag.h"

#include <gmock/gmock.h>

namespace plumbline {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

// Two that share an edge, whose middle the ray meets; one behind them; one beside whose edge it runs, in its plane.
const std::vector<Triangle> triangles = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                                         {{1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                                         {{-4, -4, -1}, {4, -4, -1}, {0, 4, -1}},
                                         {{0.5, 0.5, 0}, {0.5, 0.5, -0.5}, {0.5, 1, 0}}};
const Ray ray = {{0.5, 0.5, 1}, {0, 0, -1}};

std::string explained(const Ray& r) { return explain_bag(triangles, r, bag_truth(triangles, r)); }

TEST(ExplainBag, TellsAllThatIsMetInOrder) {
  const std::string text = explained(ray);
  EXPECT_THAT(text, StartsWith("origin     0x1p-1 0x1p-1 0x1p+0   (0.5, 0.5, 1)\n"
                               "direction  0x0p+0 0x0p+0 -0x1p+0   (0, 0, -1)\n"
                               "range      0x0p+0 inf   (0, inf)\n"
                               "crossed    3 of 4 triangles, which are counted from 0; in the exact order of t\n"
                               "hit 1      t = 1/1\n"
                               "           binary64 1                        (0x1p+0)   binary32 0x1p+0\n"
                               "           triangle 0: edge bc, from the front"));
  EXPECT_THAT(text, HasSubstr("           triangle 1: edge ca, from the front"));
  EXPECT_THAT(text, EndsWith("hit 2      t = 2/1\n"
                             "           binary64 2                        (0x1p+1)   binary32 0x1p+1\n"
                             "           triangle 2: interior, from the front\n"
                             "touched    triangle 3: coplanar, t from 1 to 1.5: a matter of convention\n"));
  const auto owner = text.find(", its owner\n");
  ASSERT_NE(owner, text.npos);
  EXPECT_EQ(text.find(", its owner", owner + 1), text.npos);  // one of the two that share the edge
}

TEST(ExplainBag, TellsWhyThereIsNothing) {
  EXPECT_THAT(explained({{9, 9, 1}, {0, 0, -1}}), EndsWith("crossed    0 of 4 triangles, which are counted from 0; in "
                                                           "the exact order of t\n"));
  EXPECT_THAT(explained({{9, 9, 1}, {0, 0, 0}}), EndsWith("class      invalid: the direction is zero\n"));
}

TEST(ExplainBag, TellsTheVerdict) {
  const BagTruth truth = bag_truth(triangles, ray);
  const Query query = ray;
  const Contract contract;
  const BagQuestion question{triangles, query, truth, contract};
  const auto verdict = [&](const Answer& answer) {
    return explain_bag_verdict(question, answer, judge_nearest(question, answer));
  };
  const auto reported = [&](std::uint32_t triangle, double t) {
    return verdict({.outcome = Outcome::hit, .has_t = true, .triangle = triangle, .t = t});
  };
  EXPECT_THAT(verdict({}),
              AllOf(StartsWith("verdict    leak: a point has to be hit, and nothing is\nseverity   "),
                    HasSubstr("\nasks       must hit one of the triangles 0 (edge bc), 1 (edge ca), t = 1\n"
                              "answer     miss\ncontract   ")));
  EXPECT_THAT(reported(1, 1),
              AllOf(StartsWith("verdict    correct: "), HasSubstr("\n           triangle 1, which is hit 1\n"),
                    Not(HasSubstr("severity"))));
  EXPECT_THAT(reported(2, 2),
              AllOf(StartsWith("verdict    wrong-nearest: another triangle has to be hit first\nseverity   1 "),
                    HasSubstr("triangle 2, which is hit 2\n")));
  EXPECT_THAT(reported(3, 1), HasSubstr("triangle 3, which is touched\n"));
  EXPECT_THAT(reported(9, 1),
              AllOf(StartsWith("verdict    fault: no answer\n"), HasSubstr("triangle 9, which isn't there\n")));
  EXPECT_THAT(verdict({.outcome = Outcome::fault}), StartsWith("verdict    fault: no answer\nanswer     fault\n"));
}

TEST(ExplainBag, TellsWhereNothingMustBeHit) {
  const Query beside = Ray{{0.25, 0.25, 1}, {0, 0, -1}, 0, 0.5};
  const BagTruth truth = bag_truth(triangles, beside);
  const Contract contract;
  const BagQuestion question{triangles, beside, truth, contract};
  const Answer first{.outcome = Outcome::hit, .has_t = true, .triangle = 0, .t = 1};
  EXPECT_THAT(explain_bag_verdict(question, first, judge_nearest(question, first)),
              AllOf(StartsWith("verdict    false-hit: "),
                    HasSubstr("\nasks       no triangle that is crossed must be hit\n"),
                    HasSubstr("\n           triangle 0, which the ray misses\n")));
}

TEST(ExplainBag, NamesTheTrianglesThatMatter) {
  const BagTruth truth = bag_truth(triangles, ray);
  const Query query = ray;
  const Contract contract{.edges = EdgeRule::unspecified};  // so that the shared edge isn't due
  const BagQuestion question{triangles, query, truth, contract};
  const auto named = [&](const Answer& answer) { return concerned(question, answer, judge_nearest(question, answer)); };
  EXPECT_THAT(concerned(question), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(named({}), ElementsAre(2, 0, 1, 3));
  EXPECT_THAT(named({.outcome = Outcome::hit, .has_t = true, .triangle = 3, .t = 1}), ElementsAre(2, 3, 0, 1));
  EXPECT_THAT(named({.outcome = Outcome::hit, .has_t = true, .triangle = 9, .t = 1}), ElementsAre(0, 1, 2, 3));
}

TEST(VerdictKinds, AreThoseOfWhatIsHitFirst) {
  EXPECT_EQ(verdict_kind(BagVerdict::leak), VerdictKind::leak);
  EXPECT_EQ(verdict_kind(BagVerdict::wrong_nearest), VerdictKind::wrong_nearest);
  EXPECT_EQ(verdict_kind(BagVerdict::false_hit), VerdictKind::false_hit);
  EXPECT_EQ(verdict_kind(BagVerdict::fault), VerdictKind::fault);
  EXPECT_THROW(verdict_kind(BagVerdict::double_hit), std::logic_error);
}

}  // namespace
}  // namespace plumbline
