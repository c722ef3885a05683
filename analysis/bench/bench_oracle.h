// What the oracle costs, per case: workloads by methods, timed in turns, as ratios to the naive kernels of the same
// run, and whether each answer is right.
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/bench/answers.h"
#include "analysis/bench/workload.h"
#include "analysis/bench/worst_case.h"
#include "oracle/batch.h"

namespace plumbline {

struct BenchPlan {
  std::vector<WorkloadPlan> workloads;
  Isa isa = Isa::portable;  ///< of the rows in batches
  double t_max = 0;
  std::uint64_t seed = 1;
  double search_seconds = 0;  ///< none: no search
  /// Sizes.
  std::size_t cases = 2048, memory_cases = 200'000, rival_cases = 256, rounds = 11;
  double slice_seconds = 2e-3;
};

struct BenchRow {
  std::string workload, method;
  Answers answers = Answers::truth;
  bool exact = true;
  std::size_t cases = 0;
  double ns_median = 0;
  /// Medians over the rounds of the ratio in the round. Rows of one triangle are compared with the naive batch of one.
  double ratio_to_naive_batch = 0, ratio_to_naive_scalar = 0;
  std::optional<double> undecided;  ///< share of the cases that the row's first stage leaves; no value: no stages
  std::size_t wrong = 0;            ///< answers that differ from mpq_class's, as far as the method answers
};

struct BenchResult {
  BenchPlan plan;
  std::vector<BenchRow> rows;
  std::optional<WorstCase> worst;
  bool worst_is_wrong = false;
};

/// Called before each workload, with its name.
using BenchProgress = std::function<void(std::string_view)>;

BenchResult bench_oracle(const BenchPlan& plan, const BenchProgress& progress);

}  // namespace plumbline
