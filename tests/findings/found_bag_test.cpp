// Findings of several triangles: told, kept, asked for again, promoted.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "analysis/tracers.h"
#include "case/input_error.h"
#include "findings/event_line.h"
#include "findings/event_reader.h"
#include "findings/found.h"
#include "findings/promotion.h"
#include "findings/store.h"
#include "tests/analysis/fixed_tracer.h"
#include "tests/case/error_of.h"
#include "tests/findings/told.h"
#include "tests/fuzz/scratch.h"
#include "tests/several.h"

namespace plumbline {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

// Two triangles that share the edge from (1, 0, 0) to (0, 1, 0), and one behind; the ray meets the edge's middle.
const std::string square =
    "case square\ntriangle 0 0 0  1 0 0  0 1 0\ntriangle 1 0 0  1 1 0  0 1 0\n"
    "triangle -4 -4 -1  4 -4 -1  0 4 -1\nray 0.5 0.5 1  0 0 -1\n";

FoundFinding found(const FixedAnswer& answer, const std::string& text) {
  const auto f = ask_for_finding(FixedTracer(answer), case_of(text), "a test");
  if (!f) throw std::logic_error("nothing found");
  return *f;
}

TEST(FoundBag, IsSignedByWhatIsHitFirst) {
  const FoundFinding leak = found({a_miss}, square);
  EXPECT_EQ(leak.signature, "leak-edge");
  EXPECT_EQ(leak.kind, FindingKind::leak);
  EXPECT_EQ(leak.element, Element::none);
  EXPECT_EQ(leak.conditioning, Conditioning::nominal);
  EXPECT_EQ(leak.found.what.bag.triangles.size(), 3u);
  EXPECT_EQ(leak.tracer, "fixed");
  EXPECT_EQ(leak.source, "a test");
  Answer third = hit_at(2);
  third.triangle = 2;
  const FoundFinding behind = found({third}, square);
  EXPECT_EQ(behind.signature, "wrong-nearest-edge-through");
  EXPECT_EQ(behind.kind, FindingKind::wrong_nearest);
  EXPECT_EQ(behind.found.ulps, 0x1p+50);  // 1, of which an ulp of 4 is 2^-50
  // Away from all but the third.
  const FoundFinding beside =
      found({hit_at(1)}, "case x\ntriangle 0 0 0  1 0 0  0 1 0\ntriangle 9 9 0  8 9 0  9 8 0\nray 2 0 1  0 0 -1\n");
  EXPECT_EQ(beside.signature, "false-hit");
  EXPECT_EQ(beside.kind, FindingKind::false_hit);
  EXPECT_EQ(beside.found.ulps, 0x1p+51);  // 1, of which an ulp of 2 is 2^-51
  EXPECT_FALSE(ask_for_finding(FixedTracer({hit_at(1)}), case_of(square), ""));
}

TEST(FoundBag, TellsWhatTheCaseIsIllConditionedBy) {
  const std::string sliver = "case s\ntriangle 0 0 0  1 0 0  0 0x1p-12 0\ntriangle -4 -4 -1  4 -4 -1  0 4 -1\n";
  const FoundFinding thin = found({a_miss}, sliver + "ray 0x1p-2 0x1p-14 1  0 0 -1\n");
  EXPECT_EQ(thin.conditioning, Conditioning::sliver);
  EXPECT_EQ(thin.signature, "leak-interior-sliver");
  // The same beside a well-shaped triangle that is crossed first: the sliver doesn't matter.
  const std::string before = "triangle -4 -4 0.5  4 -4 0.5  0 4 0.5\n";
  EXPECT_EQ(found({a_miss}, sliver + before + "ray 0x1p-2 0x1p-14 1  0 0 -1\n").signature, "leak-interior");
  // A false hit: of the triangle that is nearest to being hit.
  EXPECT_EQ(found({hit_at(1)}, sliver + "ray 9 0 1  0 0 -1\n").signature, "false-hit");
}

TEST(FoundBag, OfOneTriangleIsAFalseMiss) {
  const Tracer& tracer = find_tracer("moller_trumbore_f64");
  const Case what = case_of("case x\ntriangle 0 0 0  1 0 0  0 1 0\nray 0.25 0.25 1  0 0 -1\n");
  const FoundFinding one =
      found_bag_finding(tracer.info(), {.verdict = BagVerdict::leak}, {BagVerdict::leak, 1, 2}, what, "");
  EXPECT_EQ(one.kind, FindingKind::false_miss);
  EXPECT_EQ(one.found.ulps, 2);
}

TEST(FoundBag, IsADeathWhereTheTracerDiesOfIt) {
  const FoundFinding dead =
      found({.answer = {.outcome = Outcome::fault}, .conduct = {.deaths = {{"SIGABRT", 1}}}}, square);
  EXPECT_EQ(dead.kind, FindingKind::death);
  EXPECT_EQ(dead.signature, "death");
  EXPECT_EQ(dead.found.ulps, 0);
}

TEST(FoundBag, IsNoVerdictOfHitsOneByOne) {
  const FixedTracer tracer({a_miss});
  const BagSignature doubled{.verdict = BagVerdict::double_hit};
  EXPECT_THROW(found_bag_finding(tracer.info(), doubled, {}, case_of(square), ""), std::logic_error);
}

TEST(FoundBag, GoesThroughTheJournalUnchanged) {
  const FoundFinding told = found({a_miss}, square);
  const auto back = std::get<FoundFinding>(EventReader().read(to_line(told)));
  EXPECT_EQ(back.kind, FindingKind::leak);
  EXPECT_EQ(back.signature, told.signature);
  EXPECT_EQ(back.found.what.bag, told.found.what.bag);
  EXPECT_EQ(back.found.what.ray, told.found.what.ray);
  EXPECT_EQ(back.found.bits, told.found.bits);
}

class FoundBagStore : public testing::Test {
 protected:
  FindingStore store() const { return FindingStore(scratch_.path() / "found.db", Open::create); }

 private:
  Scratch scratch_;
};

TEST_F(FoundBagStore, IsKeptBesideThoseOfOneTriangle) {
  FindingStore kept = store();
  kept.tell(told("moller_trumbore_f64", "false-hit-bc-nominal-c0", 1, 2));
  const Tracer& tracer = find_tracer("moller_trumbore_f64");
  kept.tell(*ask_for_finding(tracer, case_of(leaking_pair), "a test"));
  kept.tell(*ask_for_finding(tracer, case_of(leaking_pair + behind_the_pair), "a test"));
  const auto row = kept.row(2);
  ASSERT_TRUE(row);
  EXPECT_EQ(row->signature, "leak-interior");
  EXPECT_EQ(row->kind, FindingKind::leak);
  EXPECT_EQ(row->worst.what.bag, case_of(leaking_pair).bag);
  EXPECT_FALSE(row->worst.what.expect);  // which is of one triangle
  EXPECT_THAT(row->worst.what.known, ElementsAre(Known{"moller_trumbore_f64", VerdictKind::leak}));
  EXPECT_THAT(kept.row(3)->worst.what.known, ElementsAre(Known{"moller_trumbore_f64", VerdictKind::wrong_nearest}));
  EXPECT_TRUE(kept.row(1)->worst.what.expect);
}

TEST_F(FoundBagStore, IsPromotedWithItsKnownLine) {
  FindingStore kept = store();
  const Tracer& tracer = find_tracer("moller_trumbore_f64");
  kept.tell(*ask_for_finding(tracer, case_of(leaking_pair + behind_the_pair), "a test"));
  const Case what = promoted(*kept.row(1), &tracer);
  EXPECT_THAT(what.known, ElementsAre(Known{"moller_trumbore_f64", VerdictKind::wrong_nearest}));
  EXPECT_GT(what.bag.triangles.size(), 1u);  // one alone has no other that could be first
  EXPECT_THAT(what.provenance.back(),
              AllOf(HasSubstr("shrunk from 3 triangles to "), HasSubstr("wrong-nearest-interior")));
  EXPECT_EQ(ask_for_finding(tracer, what, "")->kind, FindingKind::wrong_nearest);
  EXPECT_THAT(error_of([&] { promoted(*kept.row(1), &find_tracer("exact")); }), HasSubstr("its worst case right"));
}

}  // namespace
}  // namespace plumbline
