#include "fuzz/bench/fuzz_bench.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "analysis/tracers.h"
#include "case/case_bytes.h"
#include "case/input_error.h"
#include "fuzz/bench/lattice_search.h"
#include "fuzz/mutator.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Json to_json_object(const FuzzBenchRun& run) {
  Json json = Json::parse(to_json(run.summary));
  json["engine"] = run.engine;
  json["planned"] = run.planned;
  return json;
}

FuzzBenchRun from_json(const Json& json, const std::string& place) {
  FuzzBenchRun run;
  run.engine = json.value("engine", "");
  run.planned = json.value("planned", std::uint64_t{0});
  run.summary = summary_of(json.dump(), place);
  return run;
}

// A line that a kill has cut short, the last one, is left out.
std::vector<FuzzBenchRun> read_store(const fs::path& store) {
  std::vector<FuzzBenchRun> runs;
  std::ifstream in(store);
  std::string line;
  for (std::size_t number = 1; std::getline(in, line); ++number) {
    const Json json = Json::parse(line, nullptr, false);
    if (json.is_discarded()) {
      if (in.peek() == std::ifstream::traits_type::eof()) break;
      throw InputError(fmt::format("{}:{}: no JSON; remove the line", store.string(), number));
    }
    runs.push_back(from_json(json, fmt::format("{}:{}", store.string(), number)));
  }
  return runs;
}

// Prints nothing: what libFuzzer says goes nowhere.
int wait_for(std::vector<std::string> words) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const pid_t child = fork();
  if (child < 0) throw InputError(fmt::format("no process can be started: {}", std::strerror(errno)));
  if (child == 0) {
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    execv(arguments.front(), arguments.data());
    _exit(127);
  }
  int state = 0;
  while (waitpid(child, &state, 0) < 0 && errno == EINTR) {
  }
  return state;
}

Summary search(const FuzzBenchPlan& plan, const std::string& engine, const std::string& tracer, unsigned seed) {
  if (engine == "lattice") return lattice_search(find_tracer(tracer));
  const bool raw = engine == "raw";
  const fs::path program = raw ? plan.program.parent_path() / "bench" / "plumbline_raw_fuzzer" : plan.program;
  if (!fs::exists(program)) throw InputError(fmt::format("{}: is not there; build it with clang", program.string()));
  const fs::path file = fs::temp_directory_path() / fmt::format("plumbline-bench-{}.json", getpid());
  const fs::path first = fs::temp_directory_path() / fmt::format("plumbline-bench-{}.input", getpid());
  std::vector<std::string> words = {program.string(),
                                    "--tracer=" + tracer,
                                    fmt::format("--seed={}", seed),
                                    fmt::format("--runs={}", plan.executions),
                                    "--summary=" + file.string(),
                                    "--search=" + std::string(raw ? "given" : engine)};
  if (raw) {
    // It begins with the input that the others begin with. Other sizes are rejected, and count as executions, as they do
    // for libFuzzer.
    const Precision precision = find_tracer(tracer).info().contract.precision;
    std::vector<std::byte> bytes(input_size(Space::ray, precision));
    encode(Mutator({.precision = precision, .constants = {}}).seed(), bytes);
    std::ofstream(first, std::ios::binary).write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    words.insert(words.end(), {fmt::format("-seed={}", seed), "-len_control=0", fmt::format("-max_len={}", bytes.size()),
                               "-seed_inputs=" + first.string()});
  }
  const int state = wait_for(words);
  const auto summary = read_summary(file);
  std::error_code ignored;
  fs::remove(file, ignored);
  fs::remove(first, ignored);
  if (!WIFEXITED(state) || WEXITSTATUS(state) != 0 || !summary)
    throw InputError(fmt::format("{} --tracer={}: failed; run it to see why", program.string(), tracer));
  return *summary;
}

}  // namespace

std::vector<FuzzBenchRun> fuzz_bench(const FuzzBenchPlan& plan, const std::function<void(const std::string&)>& begun) {
  const auto stored = read_store(plan.store);
  std::vector<FuzzBenchRun> runs;
  for (unsigned seed = 1; seed <= plan.seeds; ++seed)  // so that an unfinished bench has some seeds of everything
    for (const std::string& tracer : plan.tracers)
      for (const std::string& engine : plan.engines) {
        if (engine == "lattice" && seed > 1) continue;
        const auto there = std::ranges::find_if(stored, [&](const FuzzBenchRun& r) {
          return r.engine == engine && r.planned == plan.executions && r.summary.tracer == tracer && r.summary.seed == seed;
        });
        if (there != stored.end()) {
          runs.push_back(*there);
          continue;
        }
        begun(fmt::format("{} {} seed {} of {}", tracer, engine, seed, plan.seeds));
        FuzzBenchRun run{engine, plan.executions, search(plan, engine, tracer, seed)};
        run.summary.seed = seed;
        std::ofstream out(plan.store, std::ios::app);
        out << to_json_object(run).dump() << '\n' << std::flush;
        if (!out) throw InputError(fmt::format("{}: can't be written; make room, or name another", plan.store.string()));
        runs.push_back(std::move(run));
      }
  return runs;
}

Spread spread(std::vector<double> values) {
  if (values.empty()) return {};
  std::ranges::sort(values);
  const std::size_t n = values.size();
  return {(values[(n - 1) / 2] + values[n / 2]) / 2, values.front(), values.back()};
}

double severity_after(const Summary& summary, double seconds) {
  double ulps = 0;
  for (const auto& rise : summary.rises)
    if (rise.seconds <= seconds) ulps = rise.ulps;
  return summary.rises.empty() ? summary.worst_nominal_severity : ulps;
}

std::string to_json_lines(const FuzzBenchPlan&, const std::vector<FuzzBenchRun>& runs) {
  std::string lines;
  for (const FuzzBenchRun& run : runs) lines += to_json_object(run).dump() + "\n";
  return lines;
}

}  // namespace plumbline
