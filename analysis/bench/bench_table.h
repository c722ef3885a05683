// The result of a benchmark as text: a table for people, JSON for machines.
#pragma once
#include <string>

#include "analysis/bench/bench_oracle.h"

namespace plumbline {

/// Machine, instruction set, compiler and `command`; the table and a legend; the worst case found, in the format of
/// .case files.
std::string to_terminal(const BenchResult& result, const std::string& command);

/// One object a line for each row: workload, method, isa, t_max, answers (hit, feature or truth), exact, cases,
/// ns_median, ratio_to_naive_batch, ratio_to_naive_scalar, undecided (null: no stages), wrong. The worst case found
/// comes last, as workload worst_found: ratios are null, ns_median is the least of its times, and there are two members
/// more, tried and case (the text of a .case file).
std::string to_json_lines(const BenchResult& result);

}  // namespace plumbline
