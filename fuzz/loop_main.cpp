// The search without libFuzzer, for compilers that have none: the same executions in the same order.
#include <fmt/format.h>

#include "case/input_error.h"
#include "fuzz/fuzzer_options.h"

int main(int argc, char** argv) {
  using namespace plumbline;
  try {
    const FuzzerOptions options = fuzzer_options(argc, argv);
    if (!options.rest.empty())
      throw InputError(fmt::format("'{}': built without libFuzzer; take --runs, --time and --campaign", options.rest.front()));
    const auto worker = make_worker(options);
    stop_on_signals();
    while (!worker->over()) worker->test(worker->next());
    worker->finish();
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", argv[0], error.what());
    return 2;
  }
}
