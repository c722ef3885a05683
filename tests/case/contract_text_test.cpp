#include "case/contract_text.h"

#include <gmock/gmock.h>

#include "tests/case/error_of.h"

namespace plumbline {
namespace {

using testing::HasSubstr;

std::string refusal(std::string_view text) {
  return error_of([&] { changed({}, text); });
}

TEST(ContractText, ChangesWhatItNames) {
  const Contract c = changed({.precision = Precision::binary32, .t_max = EndRule::open},
                             "edges=one_owner,range=ray,t_min=unspecified,coplanar=hit,degenerate=unspecified,"
                             "culling=back,slack_absolute=0x1p-20,slack_relative=0.5");
  EXPECT_EQ(c.precision, Precision::binary32);
  EXPECT_EQ(c.edges, EdgeRule::one_owner);
  EXPECT_EQ(c.range, RangeRule::ray);
  EXPECT_EQ(c.t_min, EndRule::unspecified);
  EXPECT_EQ(c.t_max, EndRule::open);
  EXPECT_EQ(c.coplanar, TouchRule::hit);
  EXPECT_EQ(c.degenerate, TouchRule::unspecified);
  EXPECT_EQ(c.culling, Culling::back);
  EXPECT_EQ(c.slack_absolute, 0x1p-20);
  EXPECT_EQ(c.slack_relative, 0x1p-1);
}

TEST(ContractText, OfNothingChangesNothing) {
  const Contract c = changed({.edges = EdgeRule::open, .slack_relative = 0x1p-3}, "");
  EXPECT_EQ(c.edges, EdgeRule::open);
  EXPECT_EQ(c.slack_relative, 0x1p-3);
}

TEST(ContractText, RefusesWithTheWordAndTheFix) {
  EXPECT_EQ(refusal("edge=open"), "a contract has no 'edge'; did you mean 'edges'?");
  EXPECT_THAT(refusal("precision=binary32"), HasSubstr("a contract has no 'precision'; known: edges, range"));
  EXPECT_EQ(refusal("edges=opn"), "edges can't be 'opn'; did you mean 'open'?");
  EXPECT_EQ(refusal("range=all"), "range can't be 'all'; known: given, ray, line");
  EXPECT_EQ(refusal("edges"), "'edges' says nothing of a contract; write key=word, such as edges=open");
  EXPECT_THAT(refusal(",edges=open"), HasSubstr("'' says nothing of a contract"));
  for (const char* slack : {"-1", "inf", "nan", "", "1e-6x"})
    EXPECT_EQ(refusal(std::string("slack_absolute=") + slack),
              std::string("slack_absolute can't be '") + slack + "'; give a finite number that is not negative");
}

}  // namespace
}  // namespace plumbline
