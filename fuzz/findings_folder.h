// What a campaign found, as files: findings/WORD.case, the worst case of each signature (analysis/signature.h) so far,
// and findings.ndjson, a line for each finding that was new or twice as severe. Both are written at once, by a rename
// and by one append: a process that is killed loses none. Several processes may write to one folder.
#pragma once
#include <filesystem>
#include <functional>

#include "fuzz/campaign.h"

namespace plumbline {

class FindingsFolder {
 public:
  /// Makes the folders; throws InputError where that can't be.
  explicit FindingsFolder(std::filesystem::path path);

  /// A finding to tell: the case unless a worse one is there, and the line. False where either can't be written.
  bool tell(const Finding& finding, const CampaignPlan& plan) const;
  /// The case alone, likewise.
  bool keep(const Finding& finding, const CampaignPlan& plan) const;
  /// Calls `take` with the input of each case that is there.
  void recall(const FuzzInput& like, const std::function<void(const FuzzInput&)>& take) const;
  /// How many signatures are there.
  std::size_t count() const;

 private:
  std::filesystem::path path_, cases_;
};

/// The case as a .case file holds it, with what the oracle says of it, and the line `known`.
Case to_case(const Finding& finding, const CampaignPlan& plan);

}  // namespace plumbline
