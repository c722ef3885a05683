#include "oracle/stated.h"

#include <gtest/gtest.h>

#include "case/case_text.h"

namespace plumbline {
namespace {

using enum VerdictKind;

TEST(Stated, RuleOfEveryVerdictAndListing) {
  const std::optional<VerdictKind> unlisted;
  const auto rule = [](VerdictKind verdict, std::optional<VerdictKind> known) {
    const auto r = rule_of(verdict, known);
    return r ? std::string(name(*r)) + (disagrees(r, known) ? "" : " only told") : "";
  };
  EXPECT_EQ(rule(correct, unlisted), "");
  EXPECT_EQ(rule(unspecified, unlisted), "");
  EXPECT_EQ(rule(false_miss, unlisted), "false-miss");
  EXPECT_EQ(rule(false_hit, unlisted), "false-hit");
  EXPECT_EQ(rule(fault, unlisted), "fault only told");
  for (const VerdictKind known : {false_miss, false_hit, fault}) {
    EXPECT_EQ(rule(known, known), "");
    EXPECT_EQ(rule(correct, known), "known-now-passes");
    EXPECT_EQ(rule(unspecified, known), "known-now-passes");
    for (const VerdictKind other : {false_miss, false_hit, fault})
      if (other != known) EXPECT_EQ(rule(other, known), name(other));
  }
}

TEST(Stated, Messages) {
  const Severity half = {.length = 0x1p-53, .ulps = 0.5, .condition = {}};
  EXPECT_EQ(rule_message(false_hit, {}, half), "new false-hit, severity 1.1102230246251565e-16 (0.5 ulps)");
  EXPECT_EQ(rule_message(false_miss, {}, {}), "new false-miss");
  EXPECT_EQ(rule_message(fault, {}, {}), "no answer: a fault");
  EXPECT_EQ(rule_message(correct, false_hit, {}), "known as false-hit, it is now correct; remove the line 'known'");
  EXPECT_EQ(rule_message(unspecified, fault, {}), "known as fault, it is now unspecified; remove the line 'known'");
  EXPECT_EQ(rule_message(false_miss, false_hit, half),
            "known as false-hit, it is now false-miss; look into it and change the line 'known', severity "
            "1.1102230246251565e-16 (0.5 ulps)");
  EXPECT_EQ(rule_message(fault, false_hit, {}),
            "known as false-hit, it is now fault; look into it and change the line 'known'");
}

std::string differences(const std::string& expect) {
  return expectation_differences(
      parse_cases("case x\ntriangle 0 0 0  1 0 0  0 1 0\nray 0.25 0.5 1  0 0 -2\n" + expect, "f.case").front());
}

TEST(Stated, ExpectationsAreDerivedAgain) {
  EXPECT_EQ(differences(""), "");
  EXPECT_EQ(differences("expect interior hit t 0.5 u 0.25 v 0.5"), "");
  EXPECT_EQ(differences("expect exterior"), "expected class exterior, it is interior");
  EXPECT_EQ(differences("expect interior miss t 0x1.0000000000001p-1 u 0.25 v 0.25"),
            "expected answer miss, it is hit; expected t 0x1.0000000000001p-1, it is 0x1p-1; expected v 0x1p-2, it "
            "is 0x1p-1");
  EXPECT_EQ(differences("expect edge bc"), "expected class edge, it is interior; expected feature bc, it is none");
}

TEST(Stated, AnExpectedNumberThatIsUndefined) {
  const auto parallel =
      parse_cases("case x\ntriangle 0 0 0  1 0 0  0 1 0\nray 0 0 1  1 0 0\nexpect parallel t 1\n", "f.case");
  EXPECT_EQ(expectation_differences(parallel.front()), "expected t 0x1p+0, it is undefined");
}

}  // namespace
}  // namespace plumbline
