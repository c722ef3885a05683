// The options of the fuzz programs, which `plumbline fuzz` starts, and services for fuzzing.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "fuzz/worker.h"

namespace plumbline {

struct FuzzerOptions {
  WorkerPlan worker;
  bool abort = false;                  ///< at a finding that exceeds the baseline (alarm.h)
  std::vector<std::string> baseline;   ///< .case files and folders: what is known, beside what the archive holds
  std::vector<std::string> seeds;      ///< .case files and folders: executed first
  std::vector<std::string> rest;       ///< what is not ours: flags of libFuzzer, files and folders
};

/// argv[0] and what follows. Without --tracer, the options are those of the environment variable PLUMBLINE_FUZZER, which is
/// set for child processes; or the program's name tells: fuzz_TRACER, fuzz_TRACER_target, fuzz_TRACER_full. A file
/// PROGRAM_baseline.case beside it is its baseline. Without --seed, libFuzzer's -seed counts; without that, where it
/// aborts, every run has another. Prints help and exits, where asked for; throws InputError.
FuzzerOptions fuzzer_options(int argc, const char* const* argv);

/// A worker that aborts where the options say so.
std::unique_ptr<Worker> make_worker(const FuzzerOptions& options);

/// SIGINT and SIGTERM end the search as a limit does; SIGXFSZ doesn't end it.
void stop_on_signals();

}  // namespace plumbline
