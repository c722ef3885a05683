// Ends the process with a failed assertion, as services expect that run fuzzers until they crash and tell crashes apart by
// the assertion's text and the topmost functions: each class of findings has a text and a function of its own.
#pragma once
#include "fuzz/campaign.h"

namespace plumbline {

/// Prints the assertion, a line DEDUP_TOKEN and the case on standard error, and aborts.
[[noreturn]] void raise_alarm(const Finding& finding, const CampaignPlan& plan);

}  // namespace plumbline
