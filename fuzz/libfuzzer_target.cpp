// The hooks of libFuzzer but for the mutator (libfuzzer_mutator.cpp). The search is in fuzz/campaign.h: libFuzzer calls it,
// execution by execution, and lends its merging, its handling of crashes, and its place in services for fuzzing.
//
// Coverage steers nothing: one counter that never changes keeps libFuzzer content while it searches. Only while it merges
// corpora it is shown the cells of each input, so that pruning keeps the elites.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "case/input_error.h"
#include "fuzz/fuzzer_options.h"
#include "fuzz/libfuzzer_target.h"

namespace plumbline {
namespace {

std::unique_ptr<FuzzerOptions> options;
std::unique_ptr<Worker> worker;
bool merging = false;

constexpr std::size_t counter_count = 1 + plain_cells / 8 + 256;
[[gnu::section("__libfuzzer_extra_counters"), gnu::used]] volatile std::uint8_t counters[counter_count];

// libFuzzer tells eight ranges of a counter apart: each counter stands for eight cells.
void show(Cell cell) {
  constexpr std::uint8_t levels[] = {1, 2, 3, 4, 8, 16, 32, 128};
  const std::size_t at = cell < plain_cells ? cell / 8 : plain_cells / 8 + (cell * 2654435761u >> 24);
  volatile std::uint8_t& counter = counters[1 + at];
  if (counter < levels[cell % 8]) counter = levels[cell % 8];
}

void finish() {
  try {
    worker->finish();
  } catch (const InputError& error) {
    fmt::print(stderr, "plumbline: {}\n", error.what());
    std::fflush(nullptr);
    std::_Exit(2);
  }
}

void leave() {
  finish();
  std::fflush(nullptr);
  std::_Exit(0);
}

void initialize(int* argc, char*** argv) {
  options = std::make_unique<FuzzerOptions>(fuzzer_options(*argc, *argv));
  static std::vector<char*> rest = {(*argv)[0]};
  for (std::string& word : options->rest) {
    // libFuzzer runs itself again for it, with -merge_inner=1.
    if (word.starts_with("-merge") || word.starts_with("-set_cover_merge")) merging = true;
    if (!word.starts_with('-') && std::filesystem::is_directory(word) && options->worker.folder.empty() &&
        options->worker.elites.empty())
      options->worker.elites = word;
    rest.push_back(word.data());
  }
  if (merging) {
    options->worker.elites.clear();
    options->abort = false;  // what aborts is dropped from the corpus, and the merge begun anew
  }
  *argc = static_cast<int>(rest.size());
  rest.push_back(nullptr);
  *argv = rest.data();
  options->worker.campaign.tracer = &as_traced(*options->worker.campaign.tracer);
  worker = make_worker(*options);
  stop_on_signals();
  // Limits of libFuzzer's own end the process without a word; what was found by then is kept.
  std::atexit(finish);
  if (worker->over()) leave();  // the seeds were all that it was to run
}

}  // namespace

Worker& libfuzzer_worker() { return *worker; }

}  // namespace plumbline

using namespace plumbline;

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  try {
    initialize(argc, argv);
  } catch (const InputError& error) {
    fmt::print(stderr, "{}: {}\n", (*argv)[0], error.what());
    std::exit(2);
  }
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  counters[0] = 1;
  const CampaignPlan& plan = options->worker.campaign;
  const FuzzInput like = input_like(plan);
  if (size != input_size(like.space, like.precision)) {
    if (plan.search == Search::given) {
      worker->campaign().skip();
      if (worker->over()) leave();
    }
    return -1;
  }
  worker->test(decode(std::as_bytes(std::span(data, size)), like.space, like.precision, plan.domain));
  if (merging) {
    const Features& seen = worker->campaign().last_features();
    for (const Cell cell : std::span(seen.cells).first(seen.size)) show(cell);
  }
  if (worker->over()) leave();
  return 0;
}
