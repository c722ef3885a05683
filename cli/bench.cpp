#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <limits>

#include "analysis/bench/bench_interface.h"
#include "analysis/bench/bench_oracle.h"
#include "analysis/bench/bench_table.h"
#include "case/enum_names.h"
#include "analysis/tracers.h"
#include "case/input_error.h"
#include "case/real_text.h"
#include "cli/number_options.h"
#include "cli/output.h"
#include "cli/verb.h"
#include "fuzz/bench/fuzz_bench.h"
#include "fuzz/launcher.h"

namespace plumbline {
namespace {

struct OracleOptions {
  std::vector<std::string> workloads;
  std::string isa = std::string(name(best_isa())), output = "-";
  double t_max = std::numeric_limits<double>::infinity(), search = 2;
  std::uint64_t seed = 1;
  bool quick = false, json = false;
};

std::vector<std::string> workload_names() {
  std::vector<std::string> names;
  for (const WorkloadPlan& workload : workload_plans()) names.emplace_back(workload.name);
  return names;
}

BenchPlan plan_of(const OracleOptions& options) {
  BenchPlan plan;
  for (const WorkloadPlan& workload : workload_plans())
    if (options.workloads.empty() || std::ranges::find(options.workloads, workload.name) != options.workloads.end())
      plan.workloads.push_back(workload);
  plan.isa = *from_name<Isa>(isa_names, options.isa);
  if (!available(plan.isa))
    throw InputError(fmt::format("--isa {}: this processor doesn't have it; the widest that it has is {}", options.isa,
                                 name(best_isa())));
  if (!(options.t_max >= 1))
    throw InputError(
        fmt::format("--t-max {}: less than 1, where the rays are aimed; give 1, more, or inf", options.t_max));
  plan.t_max = options.t_max;
  plan.seed = options.seed;
  plan.search_seconds = options.search;
  if (options.quick) {
    plan.cases = 256;
    plan.memory_cases = 2048;
    plan.rival_cases = 16;
    plan.rounds = 3;
    plan.slice_seconds = 1e-4;
  }
  return plan;
}

// With every default that matters spelt out.
std::string command_of(const OracleOptions& options) {
  std::string command = fmt::format("plumbline bench oracle --isa {} --t-max {} --seed {} --search {}", options.isa,
                                    shortest_decimal(options.t_max), options.seed, options.search);
  for (const std::string& workload : options.workloads) command += " --workload " + workload;
  if (options.quick) command += " --quick";
  return command;
}

void show_progress(std::string_view what) { fmt::print(stderr, "\r\x1b[K{}", what); }

void run_oracle(const OracleOptions& options) {
  const BenchPlan plan = plan_of(options);
  Output output(options.output);
  const bool terminal = isatty(STDERR_FILENO) != 0;
  const BenchResult result = bench_oracle(
      plan, terminal ? show_progress : [](std::string_view) {});
  if (terminal) fmt::print(stderr, "\r\x1b[K");
  output.write(options.json ? to_json_lines(result) : to_terminal(result, command_of(options)));
  output.finish();
}

void add_oracle(CLI::App& bench) {
  auto options = std::make_shared<OracleOptions>();
  OracleOptions& o = *options;
  CLI::App* verb =
      bench.add_subcommand("oracle", "What the exact answer costs, beside naive kernels and other libraries");
  verb->add_option("--workload", o.workloads, "Kind of cases; repeatable (default: all)")
      ->check(CLI::IsMember(workload_names()))
      ->type_name("NAME");
  verb->add_option("--isa", o.isa, "Instruction set of the rows in batches, naive and exact (default: the widest here)")
      ->check(CLI::IsMember(std::vector<std::string>(isa_names.begin(), isa_names.end())))
      ->type_name("ISA");
  verb->add_option("--t-max", o.t_max, "Where all rays end; at 1, many end exactly at the hit")
      ->type_name("T")
      ->capture_default_str();
  verb->add_option("--search", o.search, "Seconds to search for the slowest case of any finite doubles; 0: don't")
      ->check(CLI::Range(0.0, 86400.0))
      ->type_name("SECONDS")
      ->capture_default_str();
  verb->add_option("--seed", o.seed, "Of the cases and of the search")->type_name("N")->capture_default_str();
  verb->add_flag("--quick", o.quick, "Few cases, short repetitions: to try it out; the times mean little");
  verb->add_flag("--json", o.json, "Print JSON, one object a line");
  verb->add_option("-o", o.output, "Write to this file instead")->type_name("FILE");
  verb->footer(
      "Rays begin at t = 0. Workloads: " + fmt::format("{}", fmt::join(workload_names(), ", ")) +
      ".\n"
      "random_hits are the random rays that hit; random_memory are too many for any cache. The rest: 2048 cases, in "
      "L2.\n\n"
      "Methods:\n"
      "  naive_scalar                Moller and Trumbore's test, one case a call\n"
      "  naive_batch                 the same in columns and lanes: the hit bit only\n"
      "  exact_batch                 classify in columns, a triangle for each ray\n"
      "  ..._one_triangle            both with one triangle for all rays; their ratio is to the naive one of these\n"
      "  exact_single                classify, one case a call\n"
      "  exact_batch_without_filter  the residue stage asked of every case, then the later stages\n"
      "  integer, accumulate         these stages alone, one case a call\n"
      "  full_truth                  exact_single, and t, u, v rounded where the ray hits\n"
      "  truth_and_severity          exact_single, and how wrong the opposite answer is\n"
      "  epick_..., epeck_...        CGAL's kernels; EPICK rounds the second point of the ray, so it is inexact\n"
      "  mpq_class, cpp_rational     the formulas in GMP's and Boost's rationals\n"
      "The last five only where the build has the library (mpq_class: always), and of fewer cases.\n\n"
      "JSON: workload, method, isa, t_max, answers (all of a truth, a feature or a hit bit), exact, cases, ns_median,\n"
      "ratio_to_naive_batch, ratio_to_naive_scalar, undecided (share that the row's first stage leaves to the next, "
      "or\n"
      "null), wrong (answers that differ from mpq_class's). The worst case found has tried and case besides.\n\n"
      "Example:\n"
      "  plumbline bench oracle --workload random --workload exact_edge23 --search 0");
  verb->callback([options] { run_oracle(*options); });
}

void add_interface(CLI::App& bench) {
  CLI::App* verb =
      bench.add_subcommand("interface", "What it costs to ask a tracer by the common interface, or in a child");
  auto quick = std::make_shared<bool>(false);
  verb->add_flag("--quick", *quick, "Few rounds: to try it out; the times mean little");
  verb->footer(
      "Moller and Trumbore's test in binary64, one triangle, half of the rays hit. Ways: a loop written by hand, the\n"
      "tracer with its bag prepared before, the same with prepare timed too, and both with the tracer in a child\n"
      "process. Wall-clock time, the least of 200 rounds; ratio: to the loop by hand.\n"
      "\nExample:\n"
      "  plumbline bench interface");
  verb->callback([quick] {
    Output output;
    output.write(bench_interface({.rounds = *quick ? 3u : 200u}));
    output.finish();
  });
}

struct FuzzOptions {
  FuzzBenchPlan plan;
  std::string output = "-";
  bool quick = false, json = false;
};

void run_fuzz(FuzzOptions o) {
  FuzzBenchPlan& plan = o.plan;
  if (o.quick) {
    plan.executions = 50'000;
    plan.seeds = 2;
  }
  if (plan.tracers.empty())
    plan.tracers = {"moller_trumbore_f32", "moller_trumbore_f64", "woop_watertight_f32", "woop_watertight_f64",
                    "plucker_f32",         "plucker_f64",         "embree_robust"};
  if (plan.engines.empty()) plan.engines = {fuzz_engine_names.begin(), fuzz_engine_names.end()};
  for (const std::string& tracer : plan.tracers) find_tracer(tracer);  // all of them are there, before hours go by
  plan.program = fuzz_program();
  Output output(o.output);
  const bool terminal = isatty(STDERR_FILENO) != 0;
  const auto runs = fuzz_bench(plan, [terminal](const std::string& what) {
    if (terminal) show_progress(what);
  });
  if (terminal) show_progress("");
  std::string command = fmt::format("plumbline bench fuzz --runs {} --seeds {}", plan.executions, plan.seeds);
  for (const std::string& tracer : plan.tracers) command += " --tracer " + tracer;
  output.write(o.json ? to_json_lines(plan, runs) : to_terminal(plan, runs, command));
  output.finish();
}

void add_fuzz_bench(CLI::App& bench) {
  auto options = std::make_shared<FuzzOptions>();
  FuzzOptions& o = *options;
  o.plan.store = "bench_fuzz.ndjson";
  CLI::App* verb = bench.add_subcommand("fuzz", "How strong the search is, beside plain libFuzzer, random cases and the lattice");
  verb->add_option("--tracer", o.plan.tracers, "Who is searched; repeatable (default: see below)")->type_name("NAME");
  verb->add_option("--engine", o.plan.engines, "elites, fresh, raw, lattice; repeatable (default: all)")
      ->check(CLI::IsMember(std::vector<std::string>(fuzz_engine_names.begin(), fuzz_engine_names.end())))
      ->type_name("ENGINE");
  verb->add_option("--runs", o.plan.executions, "Executions of each search")->check(whole_number())->type_name("N")->capture_default_str();
  verb->add_option("--seeds", o.plan.seeds, "Searches of each kind")->check(CLI::Range(1u, 1000u))->type_name("N")->capture_default_str();
  verb->add_option("--store", o.plan.store, "Keeps each search that is done: the same command goes on where it stopped")
      ->type_name("FILE")
      ->capture_default_str();
  verb->add_flag("--quick", o.quick, "2 seeds of 50,000 executions: to try it out; the ratios mean little");
  verb->add_flag("--json", o.json, "Print JSON, one search a line, with every rise of its worst severity");
  verb->add_option("-o,--output", o.output, "Write to this file instead")->type_name("FILE");
  verb->footer(
      "Engines, one process at a time:\n"
      "  elites    what 'plumbline fuzz' does\n"
      "  fresh     the same mutator without feedback\n"
      "  raw       plain libFuzzer: raw bytes, coverage of the kernels, the same decoder\n"
      "  lattice   the report's lattice with normalized directions: once, it is finite\n"
      "Default tracers: moller_trumbore, woop_watertight and plucker in both precisions, embree_robust. All of it takes\n"
      "hours. Severities below half an ulp count as that in ratios; equal seconds: the shorter time of the two.\n"
      "\nExample:\n"
      "  plumbline bench fuzz --tracer moller_trumbore_f64 --runs 1000000 --seeds 5");
  verb->callback([options] { run_fuzz(*options); });
}

}  // namespace

void add_bench(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("bench", "What things cost");
  verb->require_subcommand(1);
  add_oracle(*verb);
  add_interface(*verb);
  add_bench_tracers(*verb);
  add_fuzz_bench(*verb);
}

}  // namespace plumbline
