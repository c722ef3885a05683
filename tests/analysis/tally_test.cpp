#include "analysis/tally.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "oracle/classify.h"

namespace plumbline {
namespace {

constexpr Triangle triangle = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
constexpr Ray through_edge = {{0.5, 0, 1}, {0, 0, -1}};
constexpr Ray from_behind = {{0.25, 0.25, -1}, {0, 0, 1}};

TEST(Tally, KeepsWishTruthAndAnswerApart) {
  Tally t;
  count(t, Wish::hit, true, Outcome::hit, VerdictKind::correct);
  EXPECT_EQ(t, (Tally{.attempts = 1, .successes = 1, .exact_successes = 1}));
  count(t, Wish::hit, true, Outcome::miss, VerdictKind::false_miss);
  EXPECT_EQ(t, (Tally{.attempts = 2, .successes = 1, .exact_successes = 2, .false_misses = 1}));
  count(t, Wish::hit, false, Outcome::miss, VerdictKind::correct);
  EXPECT_EQ(
      t, (Tally{.attempts = 3, .successes = 1, .exact_successes = 2, .false_misses = 1, .unlucky_harness_errors = 1}));
  EXPECT_EQ(t.harness_errors(), 1);
  count(t, Wish::hit, false, Outcome::hit, VerdictKind::false_hit);
  EXPECT_EQ(t, (Tally{.attempts = 4,
                      .successes = 2,
                      .exact_successes = 2,
                      .false_misses = 1,
                      .false_hits = 1,
                      .lucky_hits = 1,
                      .unlucky_harness_errors = 1}));
}

TEST(Tally, CountsWhatHasNoVerdict) {
  Tally t;
  count(t, Wish::miss, true, Outcome::miss, VerdictKind::unspecified);
  count(t, Wish::miss, false, Outcome::hit, VerdictKind::correct);  // within the slack of its contract
  count(t, Wish::miss, false, Outcome::fault, VerdictKind::fault);
  EXPECT_EQ(t, (Tally{.attempts = 3, .successes = 1, .exact_successes = 2, .unspecified = 2, .faults = 1}));
}

TEST(Tally, BalancesWithoutUnspecifiedAndFaults) {
  for (const Wish wish : {Wish::hit, Wish::miss})
    for (const bool truth : {false, true})
      for (const Outcome outcome : {Outcome::hit, Outcome::miss}) {
        const bool answered = outcome == Outcome::hit;
        Tally t;
        count(t, wish, truth, outcome,
              answered == truth ? VerdictKind::correct
              : answered        ? VerdictKind::false_hit
                                : VerdictKind::false_miss);
        EXPECT_EQ(t.attempts - t.successes + 2 * t.lucky(), t.harness_errors() + t.false_misses + t.false_hits);
        EXPECT_EQ(t.unlucky_harness_errors, t.harness_errors() - t.lucky());
      }
}

TEST(Tally, IsPutOutByOneAtMostByARayWithoutVerdict) {
  for (const Wish wish : {Wish::hit, Wish::miss})
    for (const std::optional<bool> truth : {std::optional<bool>(), std::optional(false), std::optional(true)})
      for (const auto& [outcome, verdict] : {std::pair(Outcome::hit, VerdictKind::unspecified),
                                             {Outcome::miss, VerdictKind::unspecified},
                                             {Outcome::hit, VerdictKind::correct},  // the slack of its contract
                                             {Outcome::fault, VerdictKind::fault}}) {
        Tally t;
        count(t, wish, truth, outcome, verdict);
        const auto failures = static_cast<int>(t.attempts - t.successes);
        const auto harness = static_cast<int>(t.harness_errors());
        EXPECT_LE(std::abs(failures - harness), static_cast<int>(t.unspecified + t.faults));
      }
}

TEST(Tally, MergesByAdding) {
  const Tally one = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
  Tally sum = one;
  sum += one;
  EXPECT_EQ(sum, (Tally{2, 4, 6, 8, 10, 12, 14, 16, 18, 20}));
}

TEST(Tally, TakesTheContractsSideOfTheTruth) {
  const Truth edge = classify(triangle, through_edge), behind = classify(triangle, from_behind);
  EXPECT_EQ(right_answer(triangle, through_edge, edge, {.edges = EdgeRule::closed}), true);
  EXPECT_EQ(right_answer(triangle, through_edge, edge, {.edges = EdgeRule::open}), false);
  EXPECT_EQ(right_answer(triangle, through_edge, edge, {.edges = EdgeRule::one_owner}), true);  // silent: the closed triangle
  EXPECT_EQ(right_answer(triangle, from_behind, behind, {}), true);
  EXPECT_EQ(right_answer(triangle, from_behind, behind, {.culling = Culling::back}), false);
  const Ray nowhere{{0, 0, 0}, {0, 0, 0}};
  EXPECT_EQ(right_answer(triangle, nowhere, classify(triangle, nowhere), {}), std::nullopt);
}

}  // namespace
}  // namespace plumbline
