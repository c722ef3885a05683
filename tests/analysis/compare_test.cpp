#include "analysis/compare.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "analysis/compare_table.h"
#include "analysis/replay.h"
#include "analysis/tracers.h"
#include "case/case_text.h"
#include "case/input_error.h"
#include "case/precision.h"

namespace plumbline {
namespace {

const std::atomic<bool> go_on = false;

ComparePlan plan_of(std::vector<std::string> tracers, std::vector<Family> families, std::uint64_t count) {
  return {.tracers = find_tracers(tracers), .families = std::move(families), .inputs = Precision::binary32, .count = count};
}

TEST(Compare, PairsAreCountedOnce) {
  constexpr std::size_t n = 5;
  std::size_t expected = 0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j) EXPECT_EQ(pair_index(i, j, n), expected++);
  EXPECT_EQ(expected, n * (n - 1) / 2);
}

// Each wrong answer is one in which the tracer and `exact` differ, and exact is right.
TEST(Compare, ScoresAgreeWithTheDuelAgainstExact) {
  const auto result =
      compare(plan_of({"moller_trumbore_f32", "exact"}, {Family::edge_ulps, Family::sliver}, 2000), go_on);
  for (std::size_t family = 0; family < 2; ++family) {
    const Score& score = result.scores[0][family];
    EXPECT_EQ(score.cases, 2000u);
    EXPECT_GT(score.false_misses, 0u);
    EXPECT_GT(score.false_hits, 0u);
    EXPECT_EQ(score.ray_false_misses, score.false_misses) << "it is asked the ray itself";
    EXPECT_EQ(result.scores[1][family].false_misses + result.scores[1][family].false_hits, 0u);
    Duel sum;
    for (const Duel& duel : result.duels[0][family]) {
      sum.differ += duel.differ;
      sum.first_right += duel.first_right;
      sum.second_right += duel.second_right;
    }
    EXPECT_EQ(sum.differ, score.false_misses + score.false_hits);
    EXPECT_EQ(sum.second_right, sum.differ);
    EXPECT_EQ(sum.first_right, 0u);
  }
}

TEST(Compare, InputsAreWhatThePlanSays) {
  const auto result = compare(plan_of({"woop_watertight_f32"}, {Family::edge_ulps, Family::tiny}, 300), go_on);
  for (const auto& list : result.worst[0])
    for (const WrongCase& c : list) {
      EXPECT_EQ(c.asked.ray, at_precision(c.asked.ray, Precision::binary32));
      EXPECT_EQ(c.asked.precision, Precision::binary32);
    }
}

TEST(Compare, WorstCasesReplayAsTheFindingsTheyAre) {
  auto plan = plan_of({"moller_trumbore_f32", "plucker_f32"}, {Family::grazing, Family::huge}, 400);
  plan.worst = 2;
  const auto result = compare(plan, go_on);
  const auto cases = parse_cases(to_cases(result), "worst.case");
  EXPECT_EQ(cases.size(), 8u);
  for (const Case& c : cases) {
    ASSERT_EQ(c.known.size(), 1u);
    const Tracer& tracer = find_tracer(c.known[0].tracer);
    EXPECT_EQ(judge(c, ask(tracer, c), tracer.info().contract).verdict, c.known[0].kind) << c.id;
  }
  for (const auto& families : result.worst)
    for (const auto& list : families)
      for (std::size_t i = 1; i < list.size(); ++i)
        EXPECT_TRUE(list[i - 1].nominal > list[i].nominal ||
                    (list[i - 1].nominal == list[i].nominal && list[i - 1].ulps >= list[i].ulps));
}

TEST(Compare, JsonHasALineForEachTracerAndFamily) {
  const auto result = compare(plan_of({"moller_trumbore_f32", "exact"}, {Family::edge_ulps, Family::grazing}, 200), go_on);
  std::istringstream lines(to_json_lines(result));
  std::size_t scores = 0, duels = 0;
  for (std::string line; std::getline(lines, line);) {
    const auto object = nlohmann::json::parse(line);
    if (object.contains("tracer")) {
      ++scores;
      EXPECT_EQ(object["cases"], 200);
    } else {
      ++duels;
      EXPECT_EQ(object["differ"], object["first_right"].get<int>() + object["second_right"].get<int>());
    }
  }
  EXPECT_EQ(scores, 4u);
  EXPECT_GT(duels, 0u);
}

TEST(Compare, SameSeedSameResult) {
  const auto plan = plan_of({"plucker_f32", "exact"}, {Family::edge_ulps}, 300);
  EXPECT_EQ(to_json_lines(compare(plan, go_on)), to_json_lines(compare(plan, go_on)));
  auto other = plan;
  other.seed = 2;
  EXPECT_NE(to_json_lines(compare(plan, go_on)), to_json_lines(compare(other, go_on)));
}

TEST(Compare, RefusesWhatItCannotCompare) {
  auto plan = plan_of({"moller_trumbore_f32"}, {Family::random}, 10);
  plan.inputs = Precision::binary64;
  EXPECT_THROW(compare(plan, go_on), InputError);
  EXPECT_THROW(compare(plan_of({"exact", "exact"}, {Family::random}, 10), go_on), InputError);
  EXPECT_THROW(compare(plan_of({"exact"}, {}, 10), go_on), InputError);
  EXPECT_THROW(compare(plan_of({"exact"}, {Family::random}, 0), go_on), InputError);
}

TEST(Compare, StopsWhenTold) {
  const std::atomic<bool> stop = true;
  EXPECT_EQ(compare(plan_of({"exact"}, {Family::random}, 10), stop).done, 0u);
}

}  // namespace
}  // namespace plumbline
