// What the tests of this folder share: a campaign that has searched, and the merge of what campaigns keep.
#pragma once
#include <cstdint>
#include <span>
#include <string_view>

#include "analysis/tracers.h"
#include "fuzz/campaign.h"

namespace plumbline {

inline CampaignPlan plan_for(std::string_view tracer, std::uint64_t seed = 1) {
  return {.tracer = tracer_named(tracer), .seed = seed};
}

inline Campaign searched(const CampaignPlan& plan, std::uint64_t executions) {
  Campaign campaign(plan);
  while (campaign.executions() < executions) campaign.test(campaign.next());
  return campaign;
}

/// As a campaign that reads the archives does it: every input is examined again.
inline Elites merged(const CampaignPlan& plan, const Elites& x, const Elites& y) {
  Campaign reader(plan);
  for (const auto& archive : {x.all(), y.all()})
    for (const Elite& elite : archive) reader.recall(elite.input);
  return reader.elites();
}

}  // namespace plumbline
