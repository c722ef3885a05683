// Ends the process with a failed assertion, as services expect that run fuzzers until they crash and tell crashes
// apart by the assertion's text and the topmost functions: each class of findings has a text and a function of
// its own. A class is kind, element and whether the case is nominal: coarser than a signature, of which a search
// finds new ones for days.
#pragma once
#include <cstddef>
#include <unordered_map>

#include "fuzz/campaign.h"

namespace plumbline {

/// The worst severity that is known of each class.
class Baseline {
 public:
  void add(const Finding& finding);
  /// Whether nothing is known of its class, or nothing more than half as severe.
  bool exceeded_by(const Finding& finding) const;

 private:
  std::unordered_map<std::size_t, double> worst_;
};

/// Prints the assertion, a line DEDUP_TOKEN and the case on standard error, and aborts.
[[noreturn]] void raise_alarm(const Finding& finding, const CampaignPlan& plan);

}  // namespace plumbline
