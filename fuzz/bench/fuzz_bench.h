// How strong a search is, beside others: on the same tracers, with equal executions and with equal seconds.
//
//   elites    the search of `plumbline fuzz`
//   fresh     the same mutator without feedback: every input begins with a new random case
//   raw       plain libFuzzer on raw bytes: coverage of the kernels, no mutator of ours, the same decoder
//   lattice   the report's lattice, directions normalized; finite, so it is run once
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/summary.h"

namespace plumbline {

inline constexpr std::array<std::string_view, 4> fuzz_engine_names = {"elites", "fresh", "raw", "lattice"};

struct FuzzBenchPlan {
  std::vector<std::string> tracers;
  std::vector<std::string> engines;
  std::uint64_t executions = 5'000'000;
  unsigned seeds = 10;            ///< seeds 1, 2, ...
  std::filesystem::path store;    ///< a line for each run; runs that are there aren't run again
  std::filesystem::path program;  ///< plumbline_fuzzer; plumbline_raw_fuzzer is looked for in bench/ beside it
};

struct FuzzBenchRun {
  std::string engine;
  std::uint64_t planned = 0;  ///< executions
  Summary summary;
};

/// All runs of the plan, in its order; `begun` is told of each that has to be run. A run is one process at a time. Throws
/// InputError where one fails, or the store can't be read or written: what was run is kept.
std::vector<FuzzBenchRun> fuzz_bench(const FuzzBenchPlan& plan, const std::function<void(const std::string&)>& begun);

/// Median and range.
struct Spread {
  double median = 0, least = 0, most = 0;
};
Spread spread(std::vector<double> values);

/// The worst nominal severity after so many seconds.
double severity_after(const Summary& summary, double seconds);

std::string to_terminal(const FuzzBenchPlan& plan, const std::vector<FuzzBenchRun>& runs, const std::string& command);
/// One object a line for each run; then, for each tracer, the medians.
std::string to_json_lines(const FuzzBenchPlan& plan, const std::vector<FuzzBenchRun>& runs);

}  // namespace plumbline
