// Each stage alone against mpq, on every family: what it decides is right, and it decides what it is there for.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <random>

#include "oracle/classify.h"
#include "oracle/explain.h"
#include "tests/judges/mpq_judge.h"
#include "tests/judges/print.h"
#include "tests/judges/seed.h"
#include "tests/oracle/stages.h"

namespace plumbline {
namespace {

constexpr std::size_t count = 2000;

class ForcedStages : public testing::TestWithParam<std::size_t> {
 protected:
  static Family family() { return static_cast<Family>(GetParam()); }
  ForcedStages() {
    for (std::uint64_t i = 0; shots.size() < count; ++i) {
      const Shot shot = draw(family(), judges::seed() + 3, i);
      if (shot.ray.direction == Vec3{}) continue;
      shots.push_back(shot);
      expected.push_back(judges::mpq_truth(shot.triangle, shot.ray));
    }
  }

  // How many are decided.
  std::size_t check(const std::vector<std::optional<Truth>>& answers) const {
    std::size_t decided = 0;
    for (std::size_t i = 0; i < answers.size(); ++i) {
      if (!answers[i]) continue;
      ++decided;
      if (*answers[i] == expected[i]) continue;
      EXPECT_EQ(*answers[i], expected[i]) << explain(shots[i].triangle, shots[i].ray);
      break;
    }
    return decided;
  }

  std::vector<Shot> shots;
  std::vector<Truth> expected;
};

// The least number of `count` that each of these stages decides; 0 where none is expected.
struct Share {
  std::size_t filter = 0, residue = 0, integer = 0, wide = 0;
};
Share expected_share(Family family) {
  constexpr std::size_t all = count, most = count * 9 / 10, nearly_all = count * 999 / 1000;
  switch (family) {
    case Family::random:
    case Family::small_far:
      return {.filter = nearly_all, .integer = most, .wide = all};
    case Family::lattice_points:
    case Family::exact_edge12:
    case Family::exact_edge23:
    case Family::coplanar:
    case Family::degenerate:
      return {.residue = most, .integer = all, .wide = all};
    case Family::exact_edge51:
      return {.integer = all, .wide = all};
    case Family::ulp12:
    case Family::ulp51:
      return {.integer = most, .wide = all};
    case Family::mixed40:
    case Family::sliver:
    case Family::far:
    case Family::grazing:
    case Family::tiny:
    case Family::huge:
    case Family::edge_ulps:
      return {.wide = all};
    case Family::wide:
    case Family::wide_edge:
    case Family::full_range:
      return {};
  }
  return {};
}

TEST_P(ForcedStages, DecideRightly) {
  std::printf("%s, seed %llu, of %zu:", name(family()).data(), static_cast<unsigned long long>(judges::seed()), count);
  const Share share = expected_share(family());
  for (const Stage& stage : all_stages()) {
    SCOPED_TRACE(stage.name());
    const std::size_t decided = check(ask(stage, shots));
    std::printf("  %s %zu", stage.name().c_str(), decided);
    switch (stage.kind) {
      case Stage::filter:
        EXPECT_GE(decided, share.filter);
        break;
      case Stage::residue:
        EXPECT_GE(decided, share.residue);
        break;
      case Stage::integer:
        EXPECT_GE(decided, share.integer);
        break;
      case Stage::wide:
        EXPECT_GE(decided, share.wide);
        break;
      case Stage::accumulate:
      case Stage::single_call:
        EXPECT_EQ(decided, count);
        break;
    }
  }
  std::printf("\n");
}

TEST_P(ForcedStages, BlocksAnswerAsSingleCasesDo) {
  for (const Isa isa : all_isas()) {
    SCOPED_TRACE(name(isa));
    const auto filter = ask({Stage::filter, isa}, shots), residue = ask({Stage::residue, isa}, shots);
    const BlockRun run = run_blocks(isa, shots, false), skipping = run_blocks(isa, shots, true);
    check(run.truths);
    EXPECT_EQ(skipping.truths, residue);
    EXPECT_EQ(skipping.counts.past_filter, count);
    // A block asks first, or leaves out, the stage that its last groups suggest; the filter is asked of all that is left.
    std::size_t undecided = 0, past_filter = 0;
    for (std::size_t i = 0; i < count; ++i) {
      undecided += run.truths[i] ? 0 : 1;
      past_filter += filter[i] ? 0 : 1;
      EXPECT_TRUE(run.truths[i] || !filter[i]);
      EXPECT_TRUE(!run.truths[i] || filter[i] || residue[i]);
    }
    EXPECT_EQ(run.counts.past_residue, undecided);
    EXPECT_GE(run.counts.past_filter, past_filter);
  }
}

// Rays of other cases, some of them invalid, against the first triangles.
TEST_P(ForcedStages, OneTriangleAgainstManyRays) {
  for (std::size_t k = 0; k < 3; ++k) {
    std::vector<Shot> against = shots;
    for (Shot& shot : against) shot.triangle = shots[k].triangle;
    against[k + 5].ray.direction = {};
    std::vector<Truth> each(count);
    for (std::size_t i = 0; i < count; ++i) each[i] = classify(against[i].triangle, against[i].ray);
    const Columns columns(against);
    for (const Isa isa : all_isas()) {
      std::vector<Truth> truths(count);
      Batch batch = columns.batch(truths.data());
      StageCounts counts;
      classify(batch, isa, &counts);
      EXPECT_EQ(truths, each) << name(isa);
      EXPECT_EQ(counts.filter + counts.residue + counts.integer + counts.wide + counts.accumulate + counts.invalid,
                count);
      EXPECT_GE(counts.invalid + counts.residue, 1u);
      truths.assign(count, Truth{});
      batch.one_triangle = true;
      // Of a column of one triangle, the first value alone is read.
      std::array<double, 9> corners{};
      for (std::size_t c = 0; c < 9; ++c) corners[c] = batch.triangle[c][0];
      for (std::size_t c = 0; c < 9; ++c) batch.triangle[c] = &corners[c];
      classify(batch, isa, nullptr);
      EXPECT_EQ(truths, each) << name(isa);
    }
  }
}

// Batches of every length up to a few groups, so that every last group occurs.
TEST_P(ForcedStages, TheLastCasesOfABatchAreCasesToo) {
  for (const Isa isa : all_isas())
    for (std::size_t n = 1; n <= 40; ++n) {
      const BlockRun run = run_blocks(isa, std::span(shots).first(n), false);
      check(run.truths);
      for (std::size_t i = 0; i < n; ++i)
        EXPECT_EQ(run.truths[i].has_value(),
                  ask({Stage::filter, isa}, shots[i]) || ask({Stage::residue, isa}, shots[i]));
    }
}

// Cases of all families side by side, so that the lanes of a group are decided by different stages.
TEST(MixedBatches, AreDecidedCaseByCase) {
  std::vector<Shot> shots;
  std::vector<Truth> expected;
  std::mt19937_64 random(judges::seed());
  std::size_t family = 0;  // runs of one, of every length
  for (std::uint64_t i = 0; i < 20000; ++i) {
    if (random() % 4 == 0) family = random() % family_names.size();
    const Shot shot = draw(static_cast<Family>(family), judges::seed() + 8, i);
    if (shot.ray.direction == Vec3{}) continue;
    shots.push_back(shot);
    expected.push_back(judges::mpq_truth(shot.triangle, shot.ray));
  }
  for (const Isa isa : all_isas()) {
    SCOPED_TRACE(name(isa));
    const auto filter = ask({Stage::filter, isa}, shots), residue = ask({Stage::residue, isa}, shots);
    const BlockRun run = run_blocks(isa, shots, false);
    for (std::size_t i = 0; i < shots.size(); ++i) {
      ASSERT_TRUE(run.truths[i] || !filter[i]);
      if (run.truths[i]) {
        ASSERT_TRUE(filter[i] || residue[i]);
        ASSERT_EQ(*run.truths[i], expected[i]) << explain(shots[i].triangle, shots[i].ray);
      }
    }
    std::vector<Truth> truths(shots.size());
    classify(Columns(shots).batch(truths.data()), isa, nullptr);
    EXPECT_EQ(truths, expected);
  }
}

INSTANTIATE_TEST_SUITE_P(All, ForcedStages, testing::Range<std::size_t>(0, family_names.size()),
                         [](const auto& each) { return std::string(family_names[each.param]); });

}  // namespace
}  // namespace plumbline
