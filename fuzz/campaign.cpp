#include "fuzz/campaign.h"

#include <algorithm>

#include "case/targets.h"

namespace plumbline {
namespace {

MutatorPlan mutator_plan(const CampaignPlan& plan) {
  const TracerInfo& info = plan.tracer->info();
  MutatorPlan p{.space = plan.space, .precision = info.contract.precision, .domain = plan.domain, .constants = info.constants};
  for (const double slack : {info.contract.slack_absolute, info.contract.slack_relative})
    if (slack > 0) p.constants.push_back(slack);
  return p;
}

}  // namespace

Campaign::Campaign(const CampaignPlan& plan)
    : plan_(plan), mutator_(mutator_plan(plan)), examiner_(*plan.tracer, plan.search == Search::elites ? Measure::all : Measure::wrong_answers),
       random_(Random(plan.seed, 0).bits(), plan.stream) {}

FuzzInput Campaign::next() {
  if (executions_ == 0) return mutator_.seed();
  if (plan_.search != Search::elites) {
    FuzzInput x = mutator_.fresh(random_);
    for (auto n = random_.below(4); n > 0; --n) x = mutator_.changed(x, random_);
    return x;
  }
  const Elite* parent = random_.chance(64) ? nullptr : elites_.parent(random_);
  return mutator_.changed(parent ? parent->input : mutator_.fresh(random_), random_);
}

void Campaign::test(const FuzzInput& input) {
  ++executions_;
  examine(input, true);
}

void Campaign::skip() { ++executions_; }

void Campaign::recall(const FuzzInput& input) { examine(input, false); }

void Campaign::examine(const FuzzInput& input, bool news) {
  const Examination e = examiner_.examine(input.triangle, ray_of(input));
  const Wish wish = wish_of(input);
  const auto found = signature(e, wish);
  features_ = features(e, found, wish);
  if (news && !first_disagreement_ && features_.severity > 0) first_disagreement_ = executions_;
  if (features_.nominal) worst_nominal_ = std::max(worst_nominal_, features_.severity);
  if (e.nominal() && !found && e.margins->severity_ulps > 0)
    least_margin_ = std::min(least_margin_, e.margins->severity_ulps);
  if (plan_.search != Search::elites) return;
  if (found) record(*found, input, news);
  if (elites_.offer(input, features_) != 0 && on_elites) on_elites(elites_);
}

void Campaign::record(const Signature& found, const FuzzInput& input, bool news) {
  const double ulps = features_.found;
  const auto [at, is_new] = findings_.try_emplace(found.key());
  Finding& finding = at->second;
  if (!is_new && !(ulps > finding.ulps)) return;
  finding = {found, ulps, news ? executions_ : 0, input};
  double& told = told_[found.key()];
  if (news && !is_new && ulps < 2 * told) return;
  told = std::max(told, ulps);
  if (news && on_finding) on_finding(finding);
}

Wish wish_of(const FuzzInput& input) {
  if (input.space == Space::ray) return Wish::none;
  static const std::vector<Aim> wishes = aims({.tolerances = {1}});
  return wishes[input.target].wish;
}

}  // namespace plumbline
