// Runs a campaign: starts its processes, follows them, and puts together what they come to.
//
// Each process is a fuzz program (fuzzer_options.h) with the campaign's folder; what it prints goes to jobs/N.log there.
// Processes end with their parent. summary.json is written once a second and at the end.
#pragma once
#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fuzz/summary.h"

namespace plumbline {

struct LaunchPlan {
  std::filesystem::path program;     ///< the fuzz program
  std::vector<std::string> options;  ///< of the search, for every process
  std::filesystem::path folder;
  unsigned jobs = 1;
  std::optional<std::uint64_t> runs;  ///< executions of all processes together
};

/// What a status line tells.
struct LaunchStatus {
  Summary summary;
  double running = 0;       ///< seconds since the start
  std::string last_new;     ///< signature of the finding told last; empty: none yet
  double since_last_new = 0;
};

/// Returns when all processes have ended: by their limits, or since `stop` became true. Throws InputError where a process
/// can't be started, or has failed: what the others found is kept.
Summary launch(const LaunchPlan& plan, const std::atomic<bool>& stop, const std::function<void(const LaunchStatus&)>& status);

/// The fuzz program that belongs to this build. Throws InputError where it isn't there.
std::filesystem::path fuzz_program();

}  // namespace plumbline
