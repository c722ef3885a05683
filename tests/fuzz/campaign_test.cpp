// A search without folder and driver: reproducible, within its domain, and telling what is new and no more.
#include "fuzz/campaign.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <vector>

#include "tests/fuzz/searched.h"

namespace plumbline {
namespace {

void expect_same_search(const Campaign& x, const Campaign& y) {
  EXPECT_EQ(fingerprint(x.elites()), fingerprint(y.elites()));
  EXPECT_EQ(x.executions(), y.executions());
  EXPECT_EQ(x.first_disagreement(), y.first_disagreement());
  EXPECT_EQ(x.worst_nominal(), y.worst_nominal());
  ASSERT_EQ(x.findings().size(), y.findings().size());
  for (const auto& [key, finding] : x.findings()) {
    const auto other = y.findings().find(key);
    ASSERT_NE(other, y.findings().end()) << to_word(finding.signature);
    EXPECT_EQ(finding.signature, other->second.signature);
    EXPECT_EQ(finding.ulps, other->second.ulps);
    EXPECT_EQ(finding.execution, other->second.execution);
    EXPECT_EQ(finding.input, other->second.input);
  }
}

struct Where {
  Space space;
  Domain domain;
  const char* tracer;
};
std::vector<Where> everywhere() {
  std::vector<Where> list;
  for (const Space space : {Space::ray, Space::target})
    for (const Domain domain : {Domain::nominal, Domain::full})
      for (const char* tracer : {"moller_trumbore_f32", "moller_trumbore_f64"})
        list.push_back({space, domain, tracer});
  return list;
}
CampaignPlan plan_at(const Where& where, std::uint64_t seed) {
  CampaignPlan plan = plan_for(where.tracer, seed);
  plan.space = where.space;
  plan.domain = where.domain;
  return plan;
}

class CampaignAt : public testing::TestWithParam<Where> {};
INSTANTIATE_TEST_SUITE_P(Everywhere, CampaignAt, testing::ValuesIn(everywhere()), [](const auto& info) {
  const Where& w = info.param;
  return std::string(name(w.space)) + "_" + std::string(name(w.domain)) + "_" + w.tracer;
});

TEST_P(CampaignAt, TheSamePlanIsTheSameSearch) {
  const CampaignPlan plan = plan_at(GetParam(), 20260101);
  const Campaign once = searched(plan, 3000);
  EXPECT_FALSE(once.findings().empty());
  expect_same_search(once, searched(plan, 3000));
}

TEST_P(CampaignAt, AnotherSeedOrStreamIsAnother) {
  std::set<std::uint64_t> prints;
  for (const auto& [seed, stream] : {std::pair{1, 0}, {1, 1}, {2, 0}, {2, 1}, {1, 2}}) {
    CampaignPlan plan = plan_at(GetParam(), static_cast<std::uint64_t>(seed));
    plan.stream = static_cast<std::uint64_t>(stream);
    prints.insert(fingerprint(searched(plan, 500).elites()));
  }
  EXPECT_EQ(prints.size(), 5u);
}

// The search goes on from what it finds, so that inputs are far from where it began.
TEST_P(CampaignAt, EveryInputIsInTheDomain) {
  constexpr std::uint64_t seed = 20260101;
  const CampaignPlan plan = plan_at(GetParam(), seed);
  Campaign campaign(plan);
  std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
  bool beyond_nominal = false;
  for (int i = 0; i < 100000; ++i) {
    const FuzzInput input = campaign.next();
    ASSERT_EQ(input.space, plan.space);
    ASSERT_EQ(input.precision, plan.tracer->info().contract.precision);
    ASSERT_TRUE(in_domain(input, plan.domain)) << "input " << i;
    ASSERT_TRUE(input.space == Space::target || input.ray.direction != Vec3{}) << "input " << i;
    beyond_nominal |= !in_domain(input, Domain::nominal);
    if (i < 20000) campaign.test(input);
  }
  EXPECT_EQ(beyond_nominal, plan.domain == Domain::full);
}

// ---- what is told

struct Told {
  double ulps;
  std::uint64_t execution;
};
using ToldOf = std::map<std::uint32_t, std::vector<Told>>;

TEST(Campaign, TellsOfWhatIsNewOrTwiceAsSevere) {
  Campaign campaign(plan_for("moller_trumbore_f64", 20260101));
  ToldOf told;
  campaign.on_finding = [&](const Finding& finding) {
    EXPECT_EQ(finding.execution, campaign.executions());
    told[finding.signature.key()].push_back({finding.ulps, finding.execution});
  };
  while (campaign.executions() < 50000) campaign.test(campaign.next());
  ASSERT_EQ(told.size(), campaign.findings().size());
  std::size_t again = 0;
  for (const auto& [key, finding] : campaign.findings()) {
    const auto& list = told[key];
    SCOPED_TRACE(to_word(finding.signature));
    for (std::size_t i = 1; i < list.size(); ++i) ASSERT_GE(list[i].ulps, 2 * list[i - 1].ulps);
    ASSERT_GE(finding.ulps, list.back().ulps);
    ASSERT_TRUE(finding.ulps < 2 * list.back().ulps || finding.ulps == 0);
    again += list.size() - 1;
  }
  EXPECT_GT(told.size(), 20u);
  EXPECT_GT(again, 20u);
}

// The worst of each signature, told or not.
TEST(Campaign, KeepsTheWorstOfEachSignature) {
  const CampaignPlan plan = plan_for("moller_trumbore_f32", 20260101);
  Campaign campaign(plan);
  Examiner examiner(*plan.tracer);
  std::map<std::uint32_t, Finding> worst;
  double nominal = 0;
  std::optional<std::uint64_t> first;
  for (std::uint64_t n = 1; n <= 20000; ++n) {
    const FuzzInput input = campaign.next();
    campaign.test(input);
    const Examination e = examiner.examine(input.triangle, ray_of(input));
    const double ulps = e.severity_ulps();
    if (ulps > 0 && !first) first = n;
    if (e.nominal()) nominal = std::max(nominal, ulps);
    const auto found = signature(e);
    if (!found) continue;
    const double how_bad = finding_ulps(e, *found);
    auto [at, is_new] = worst.try_emplace(found->key(), Finding{*found, how_bad, n, input});
    if (!is_new && how_bad > at->second.ulps) at->second = {*found, how_bad, n, input};
  }
  EXPECT_EQ(campaign.first_disagreement(), first);
  EXPECT_GT(nominal, 0);
  EXPECT_EQ(campaign.worst_nominal(), nominal);
  ASSERT_EQ(campaign.findings().size(), worst.size());
  for (const auto& [key, finding] : worst) {
    const Finding& kept = campaign.findings().at(key);
    EXPECT_EQ(kept.signature, finding.signature);
    EXPECT_EQ(kept.ulps, finding.ulps);
    EXPECT_EQ(kept.execution, finding.execution);
    EXPECT_EQ(kept.input, finding.input);
  }
}

TEST(Campaign, WhatIsRecalledIsNoNews) {
  const CampaignPlan plan = plan_for("moller_trumbore_f64", 20260101);
  const Campaign before = searched(plan, 20000);
  ASSERT_GT(before.findings().size(), 10u);
  Campaign campaign(plan);
  std::size_t told = 0;
  campaign.on_finding = [&told](const Finding&) { ++told; };
  for (const auto& [key, finding] : before.findings()) campaign.recall(finding.input);
  EXPECT_EQ(told, 0u);
  EXPECT_EQ(campaign.executions(), 0u);
  EXPECT_EQ(campaign.first_disagreement(), std::nullopt);
  EXPECT_EQ(campaign.worst_nominal(), before.worst_nominal());
  EXPECT_EQ(campaign.findings().size(), before.findings().size());
  for (const auto& [key, finding] : campaign.findings()) EXPECT_EQ(finding.execution, 0u);
  // Nor are they once they are executed; nor is anything else that is no worse.
  for (const auto& [key, finding] : before.findings()) campaign.test(finding.input);
  EXPECT_EQ(told, 0u);
  EXPECT_EQ(campaign.executions(), before.findings().size());
  EXPECT_EQ(campaign.first_disagreement().has_value(), true);
}

// A recalled finding sets the mark that the next has to be twice as severe as.
TEST(Campaign, TwiceAsSevereAsWhatWasRecalledIsNews) {
  const CampaignPlan plan = plan_for("moller_trumbore_f64", 20260101);
  std::map<std::uint32_t, std::vector<FuzzInput>> told;
  Campaign first(plan);
  first.on_finding = [&](const Finding& finding) { told[finding.signature.key()].push_back(finding.input); };
  while (first.executions() < 20000) first.test(first.next());
  int tried = 0;
  for (const auto& [key, inputs] : told) {
    if (inputs.size() < 2) continue;
    ++tried;
    Campaign campaign(plan);
    std::vector<std::uint32_t> news;
    campaign.on_finding = [&](const Finding& finding) { news.push_back(finding.signature.key()); };
    campaign.recall(inputs.front());
    campaign.test(inputs.front());
    EXPECT_TRUE(news.empty());
    campaign.test(inputs.back());
    campaign.test(inputs.back());
    campaign.test(inputs.front());
    EXPECT_EQ(news, std::vector{key});
  }
  EXPECT_GT(tried, 5);
}

TEST(Campaign, ElitesAreToldWithTheirPlaces) {
  Campaign campaign(plan_for("moller_trumbore_f64"));
  std::set<Cell> cells;
  campaign.on_elites = [&](const Elites& elites) {
    EXPECT_FALSE(elites.changed().empty());
    for (const auto at : elites.changed()) cells.insert(elites.all()[at].cell);
  };
  while (campaign.executions() < 2000) campaign.test(campaign.next());
  EXPECT_EQ(cells.size(), campaign.elites().all().size());
}

TEST(Campaign, SearchesForComparisonKeepNothing) {
  for (const Search search : {Search::fresh, Search::given}) {
    SCOPED_TRACE(name(search));
    CampaignPlan plan = plan_for("moller_trumbore_f32", 20260101);
    plan.search = search;
    const Campaign campaign = searched(plan, 20000);
    EXPECT_TRUE(campaign.elites().all().empty());
    EXPECT_TRUE(campaign.findings().empty());
    EXPECT_TRUE(campaign.first_disagreement().has_value());
    EXPECT_GT(campaign.worst_nominal(), 0);
    EXPECT_LT(campaign.worst_nominal(), searched(plan_for("moller_trumbore_f32", 20260101), 20000).worst_nominal());
  }
}

// The control tracer is the oracle: nothing to find, but every case in its cell.
TEST(Campaign, FindsNothingWhereNothingIsWrong) {
  for (const Space space : {Space::ray, Space::target}) {
    CampaignPlan plan = plan_for("exact");
    plan.space = space;
    const Campaign campaign = searched(plan, 5000);
    EXPECT_TRUE(campaign.findings().empty());
    EXPECT_EQ(campaign.first_disagreement(), std::nullopt);
    EXPECT_EQ(campaign.worst_nominal(), 0);
    EXPECT_GT(campaign.elites().all().size(), 50u);
  }
}

TEST(Campaign, WishesAreThoseOfTheTargets) {
  FuzzInput input;
  EXPECT_EQ(wish_of(input), Wish::none);
  input.space = Space::target;
  // 4 interior, 6 of vertices and edges, 6 on the edges: hit. 6 beyond: miss. 3 inside, 3 outside.
  constexpr std::string_view expected = "hhhhhhhhhhhhhhhhmmmmmmhhhmmm";
  ASSERT_EQ(expected.size(), targets_of_a_triangle);
  for (input.target = 0; input.target < targets_of_a_triangle; ++input.target)
    EXPECT_EQ(wish_of(input), expected[input.target] == 'h' ? Wish::hit : Wish::miss) << input.target;
}

}  // namespace
}  // namespace plumbline
