// One process of a campaign: the search with its folder and its limits. Whoever drives it calls next() and test() until
// over(), then finish().
//
// The folder: elites/ (elites_folder.h), findings/ and findings.ndjson (findings_folder.h), jobs/N.json (summary.h), of
// which the last is written once a second. A worker begins with what it finds there, so a campaign that was stopped or
// killed goes on. A store of findings (findings/journal.h) may be told beside. What is lost by a kill: no finding that was new or twice as severe, and at most some seconds of other
// elites.
#pragma once
#include <atomic>
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "findings/teller.h"
#include "fuzz/campaign.h"
#include "fuzz/elites_folder.h"
#include "fuzz/findings_folder.h"
#include "fuzz/summary.h"

namespace plumbline {

struct WorkerPlan {
  CampaignPlan campaign;
  std::filesystem::path folder;  ///< of the campaign; empty: nothing is kept
  std::filesystem::path elites;  ///< an archive of its own instead; empty: that of the folder
  std::string store;             ///< of findings, which are told there too; empty: none
  std::filesystem::path summary; ///< where to write summary and rises at the end, instead of jobs/N.json; or empty
  unsigned job = 0;              ///< which of the campaign's processes, from 0
  std::optional<std::uint64_t> runs;  ///< executions
  std::optional<double> seconds;
};

class Worker {
 public:
  /// Reads what the folder holds. Throws InputError where that is another tracer's campaign, or can't be used.
  explicit Worker(WorkerPlan plan);

  FuzzInput next() { return campaign_.next(); }
  void test(const FuzzInput& input);
  bool over() const;
  /// Writes all that there is to be kept. Throws InputError where that can't be, after everything that can.
  void finish();

  const Campaign& campaign() const { return campaign_; }
  Campaign& campaign() { return campaign_; }
  Summary summary() const;

  /// Set by a signal handler: over() is then true.
  static inline std::atomic<bool> stop = false;

 private:
  using Clock = std::chrono::steady_clock;
  double elapsed() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  void look_around();

  WorkerPlan plan_;
  Summary before_;  // of this job, by earlier processes
  Campaign campaign_;
  std::optional<ElitesFolder> elites_;
  std::optional<FindingsFolder> findings_;
  std::optional<Teller> store_;
  std::unordered_map<std::uint32_t, double> told_;  // the store, by signature: the severity
  Clock::time_point start_, next_look_;
  bool written_ = true;  // all findings up to now
  std::vector<Summary::Rise> rises_;
};

/// An empty input as a tracer of the plan reads it.
FuzzInput input_like(const CampaignPlan& plan);

}  // namespace plumbline
