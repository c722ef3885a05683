#include "analysis/sweep.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cfenv>
#include <cstdlib>

#include "analysis/ask.h"
#include "analysis/tracers.h"
#include "case/input_error.h"
#include "float_tracer/isolated.h"

namespace plumbline {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

Lattice cube(Decimal box, Decimal step, Decimal offset = {}) {
  const LatticeAxis axis = {box, step, offset};
  return make_lattice({axis, axis, axis});
}

/// The report's experiment.
SweepPlan plan_for(std::initializer_list<std::string_view> tracers) {
  SweepPlan plan;
  plan.lattices = {cube({2, 0}, {15, -1})};
  plan.object.mode = BagMode::plate;
  plan.object.thickness = 0.1;
  for (const std::string_view name : tracers) plan.tracers.push_back(&find_tracer(name));
  plan.triples = triple_range(plan.lattices.front(), 0, {});
  return plan;
}

std::vector<Tally> tallies(const SweepResult& result) {
  std::vector<Tally> list;
  for (const SweepRow& row : result.rows) list.push_back(row.tally);
  return list;
}

std::vector<std::uint64_t> successes(const SweepResult& result) {
  std::vector<std::uint64_t> list;
  for (const SweepRow& row : result.rows) list.push_back(row.tally.successes);
  return list;
}

TEST(Sweep, GivesTheReportsTable) {
  EXPECT_THAT(successes(sweep(plan_for({"brlcad_bot_classic"}))), ElementsAre(1344, 1710, 5802, 5772, 5528));
}

TEST(Sweep, GivesTheFiguresOfTheExactTracer) {
  const SweepResult result = sweep(plan_for({"exact"}));
  EXPECT_THAT(successes(result), ElementsAre(1344, 1890, 5724, 5688, 5760));
  for (const SweepRow& row : result.rows) {
    EXPECT_EQ(row.tally.exact_successes, row.tally.successes);
    EXPECT_EQ(row.tally.false_misses + row.tally.false_hits + row.tally.unspecified + row.tally.faults, 0);
  }
}

TEST(Sweep, GivesTheFiguresOfTheNewestBrlcad) {
  EXPECT_THAT(successes(sweep(plan_for({"brlcad_bot_hlbvh"}))), ElementsAre(1344, 846, 5490, 5184, 5280));
}

TEST(Sweep, SplitsTheReportsFailures) {
  const SweepResult result = sweep(plan_for({"brlcad_bot_classic"}));
  EXPECT_EQ(result.triangles, 336);
  EXPECT_EQ(result.rows[1].tally, (Tally{.attempts = 2016,
                                         .successes = 1710,
                                         .exact_successes = 1890,
                                         .false_misses = 192,
                                         .false_hits = 12,
                                         .lucky_hits = 12,
                                         .unlucky_harness_errors = 114}));
  EXPECT_EQ(result.rows[4].tally.false_misses, 352);
  EXPECT_EQ(result.rows[4].tally.false_hits, 120);
}

TEST(Sweep, LeavesRaysThatAreNotNormalisedExact) {
  SweepPlan plan = plan_for({"exact", "brlcad_bot_classic_kernel", "brlcad_bot_classic"});
  plan.normal = Normal::none;
  plan.standoffs = {1};
  plan.tolerances = {};
  EXPECT_THAT(successes(sweep(plan)), ElementsAre(1344, 2016, 1344, 2016, 1344, 1782));
}

TEST(Sweep, BalancesForEveryTracerAndIsTrueToPrecision) {
  SweepPlan plan = plan_for({});
  plan.tracers = standard_tracers();
  for (const SweepRow& row : sweep(plan).rows) {
    const Tally& t = row.tally;
    if (t.unspecified + t.faults == 0) {
      EXPECT_EQ(t.attempts - t.successes + 2 * t.lucky(), t.harness_errors() + t.false_misses + t.false_hits)
          << row.tracer->info().name;
    }
    if (row.target == TargetKind::vertex_edge) {
      const bool binary32 = row.tracer->info().contract.precision == Precision::binary32;
      EXPECT_EQ(t.exact_successes, binary32 ? 1908 : 1890) << row.tracer->info().name;
    }
  }
}

TEST(Sweep, DoesNotDependOnJobsOrSplits) {
  SweepPlan plan = plan_for({"brlcad_bot_classic", "exact", "moller_trumbore_f32"});
  plan.lattices = {cube({1, 0}, {5, -1}), cube({1, 0}, {5, -1}, {25, -2})};
  plan.triples = {1000, 1100};
  plan.standoffs = {0.25, 5};
  const SweepResult whole = sweep(plan);
  EXPECT_EQ(whole.rows.size(), 3 * 2 * 2 * 5);
  for (const unsigned jobs : {2, 3, 8}) {
    plan.jobs = jobs;
    const SweepResult again = sweep(plan);
    EXPECT_EQ(tallies(again), tallies(whole));
    EXPECT_EQ(again.triangles, whole.triangles);
  }
  for (const std::uint64_t cut : {1000, 1001, 1016, 1077, 1100}) {
    plan.triples = {1000, cut};
    std::vector<Tally> sum = tallies(sweep(plan));
    plan.triples = {cut, 1100};
    const std::vector<Tally> rest = tallies(sweep(plan));
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += rest[i];
    EXPECT_EQ(sum, tallies(whole)) << cut;
  }
}

TEST(Sweep, OfSeveralStandoffsAndPlacesIsThatOfEach) {
  SweepPlan plan = plan_for({"brlcad_bot_classic"});
  plan.lattices.push_back(cube({2, 0}, {15, -1}, {25, -2}));
  plan.standoffs = {2.5, 5};
  const SweepResult all = sweep(plan);
  std::size_t next = 0;
  for (const Lattice& lattice : plan.lattices)
    for (const double standoff : plan.standoffs) {
      SweepPlan one = plan_for({"brlcad_bot_classic"});
      one.lattices = {lattice};
      one.standoffs = {standoff};
      for (const SweepRow& row : sweep(one).rows) {
        EXPECT_EQ(all.rows[next].offset, offset_of(lattice));
        EXPECT_EQ(all.rows[next].standoff, standoff);
        EXPECT_EQ(all.rows[next].tally, row.tally);
        ++next;
      }
    }
  EXPECT_EQ(next, all.rows.size());
}

TEST(Sweep, IsAPrefixWhenInterrupted) {
  SweepPlan plan = plan_for({"exact"});
  plan.jobs = 4;
  std::atomic<bool> stop = false;
  const SweepResult partial = sweep(plan, stop, [&](std::uint64_t done, std::uint64_t planned) {
    EXPECT_EQ(planned, 512);
    if (done >= 100) stop = true;
  });
  EXPECT_GE(partial.done.end, 100);
  EXPECT_LT(partial.done.end, 512);
  plan.triples = partial.done;
  EXPECT_EQ(tallies(sweep(plan)), tallies(partial));
}

// `exact`, but dies of each ray from x = 1, and changes the rounding mode at those from x = 0.
class Mortal final : public Tracer {
 public:
  Mortal() : Tracer({.name = "mortal", .summary = "", .source = "", .contract = {}}) {}
  std::unique_ptr<PreparedBag> prepare(const Bag& bag) const override {
    return std::make_unique<Prepared>(find_tracer("exact").prepare(bag));
  }

 private:
  class Prepared final : public PreparedBag {
   public:
    explicit Prepared(std::unique_ptr<PreparedBag> exact) : exact_(std::move(exact)) {}

   private:
    void answer(std::span<const Ray> rays, std::span<Answer> answers) override {
      exact_->trace(rays, answers);
      for (const Ray& ray : rays) {
        if (ray.origin.x == 1) std::abort();
        if (ray.origin.x == 0) std::fesetround(FE_UPWARD);
      }
    }
    std::unique_ptr<PreparedBag> exact_;
  };
};

TEST(Sweep, CountsWhatATracerDiesOfAndChangesNothingElse) {
  const auto mortal = isolated(std::make_unique<Mortal>());
  SweepPlan plan = plan_for({"exact"});
  plan.triples = {0, 200};
  plan.tracers.push_back(mortal.get());
  const SweepResult one = sweep(plan);
  plan.jobs = 3;
  const SweepResult three = sweep(plan);
  EXPECT_EQ(tallies(three), tallies(one));
  EXPECT_EQ(three.conduct, one.conduct);

  EXPECT_EQ(one.conduct.at(0), Conduct{});
  EXPECT_TRUE(one.conduct.at(1).disturbed);
  std::uint64_t faults = 0;
  for (std::size_t i = 0; i < one.rows.size(); ++i) {
    faults += one.rows[i].tally.faults;
    EXPECT_EQ(one.rows[i].tally.false_hits + one.rows[i].tally.false_misses, 0);
  }
  EXPECT_GT(faults, 0);
  EXPECT_EQ(one.conduct.at(1).deaths, (std::map<std::string, std::uint64_t>{{"SIGABRT", faults}}));
}

TEST(Ask, TellsWhatATracerDiedOf) {
  const auto mortal = isolated(std::make_unique<Mortal>());
  Case asked;
  asked.bag.triangles = {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};
  asked.ray = {.origin = {1, 1, 5}, .direction = {0, 0, -1}};
  const Reply dead = ask(*mortal, asked);
  EXPECT_EQ(dead.answer.outcome, Outcome::fault);
  EXPECT_EQ(dead.conduct.deaths, (std::map<std::string, std::uint64_t>{{"SIGABRT", 1}}));
  asked.ray.origin.x = 0;
  const Reply disturbed = ask(*mortal, asked);
  EXPECT_EQ(disturbed.answer.outcome, Outcome::hit);
  EXPECT_EQ(disturbed.conduct, Conduct{.disturbed = true});
}

TEST(Sweep, RefusesAPlanThatMakesNoSense) {
  const auto refused = [](const SweepPlan& plan, const char* message) {
    EXPECT_THAT([&] { check(plan); }, ThrowsMessage<InputError>(HasSubstr(message)));
  };
  SweepPlan plan = plan_for({"exact"});
  EXPECT_NO_THROW(check(plan));
  plan.standoffs = {5, 5};
  refused(plan, "standoff 5: given twice");
  plan.standoffs = {-5};
  refused(plan, "standoff -5");
  refused(plan_for({"exact", "exact"}), "tracer exact: given twice");
  plan = plan_for({"exact"});
  plan.tolerances = {0.1, 0.1};
  refused(plan, "tolerance 0.1: given twice");
  plan = plan_for({"exact"});
  plan.lattices.push_back(plan.lattices.front());
  refused(plan, "offset 0 0 0: given twice");
  plan = plan_for({"exact"});
  plan.object.thickness = 0;
  refused(plan, "thickness 0");
}

}  // namespace
}  // namespace plumbline
