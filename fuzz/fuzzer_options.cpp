#include "fuzz/fuzzer_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <random>

#include "case/case_files.h"
#include "analysis/tracers.h"
#include "case/case_text.h"
#include "case/enum_names.h"
#include "case/input_error.h"
#include "fuzz/alarm.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

constexpr const char* environment = "PLUMBLINE_FUZZER";

#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
constexpr bool aborts_by_default = true;
#else
constexpr bool aborts_by_default = false;
#endif

bool cut(std::string& text, std::string_view suffix) {
  if (!text.ends_with(suffix)) return false;
  text.resize(text.size() - suffix.size());
  return true;
}

// What fuzz_TRACER says, in options.
std::vector<std::string> options_of_name(const std::string& program) {
  std::string tracer = fs::path(program).filename();
  if (!tracer.starts_with("fuzz_")) return {};
  tracer.erase(0, 5);
  std::vector<std::string> options;
  if (cut(tracer, "_target")) options.push_back("--space=target");
  if (cut(tracer, "_full")) options.push_back("--domain=full");
  options.push_back("--tracer=" + tracer);
  return options;
}

std::vector<std::string> words(const std::string& lines) {
  std::vector<std::string> list;
  std::istringstream in(lines);
  for (std::string line; std::getline(in, line);) list.push_back(line);
  return list;
}

// -seed=N, which libFuzzer also gives to the children that it forks; 0 stands for any.
std::optional<std::uint64_t> seed_of_libfuzzer(const std::vector<std::string>& flags) {
  constexpr std::string_view flag = "-seed=";
  std::uint64_t seed = 0;
  for (const std::string& word : flags)
    if (word.starts_with(flag)) std::from_chars(word.data() + flag.size(), word.data() + word.size(), seed);
  return seed == 0 ? std::nullopt : std::optional(seed);
}

void for_each_input(const std::vector<std::string>& paths, const CampaignPlan& plan,
                    const std::function<void(const FuzzInput&)>& take) {
  const FuzzInput like = input_like(plan);
  for (const std::string& path : paths)
    for (const std::string& file : case_files(path))
      for (const Case& c : read_cases(file))
        if (const auto input = from_case(c, like.space, like.precision); input && in_domain(*input, plan.domain)) take(*input);
}

}  // namespace

FuzzerOptions fuzzer_options(int argc, const char* const* argv) {
  FuzzerOptions o;
  std::string tracer, space = "ray", domain = "nominal", search = "elites";
  ForeignOptions foreign;
  bool record = false;
  CLI::App app("Searches for the worst errors of one tracer. 'plumbline fuzz' starts this program; it can also be run by\n"
               "itself, with the flags of libFuzzer and a corpus folder, which is then the archive.");
  app.set_help_flag("--help", "Print this help");  // not -h, with which libFuzzer's -handle_abrt begins
  app.allow_extras();
  app.add_option("--tracer", tracer, "Who is searched: a NAME of 'plumbline tracers', ./libmine.so or pipe:CMD");
  app.add_option("--space", space)->check(CLI::IsMember(std::vector<std::string>(space_names.begin(), space_names.end())));
  app.add_option("--domain", domain)->check(CLI::IsMember(std::vector<std::string>(domain_names.begin(), domain_names.end())));
  app.add_option("--seed", o.worker.campaign.seed, "Of the search");
  app.add_option("--campaign", o.worker.folder, "The folder of the campaign");
  app.add_option("--findings", o.worker.store, "A store of findings, which has to be there, told what is found");
  app.add_option("--summary", o.worker.summary, "Write the summary to this file at the end");
  app.add_option("--search", search, "elites; for comparison: fresh, given (by libFuzzer alone)")
      ->check(CLI::IsMember(std::vector<std::string>(search_names.begin(), search_names.end())));
  app.add_option("--job", o.worker.job, "Which of the campaign's processes this is");
  app.add_option("--runs", o.worker.runs, "Stop after so many executions");
  app.add_option("--time", o.worker.seconds, "Stop after so many seconds");
  app.add_option("--tracer-timeout", foreign.timeout, "Seconds that a program (pipe:CMD) may take for a case");
  app.add_option("--seeds", o.seeds, "Cases to begin with: .case files and folders")->allow_extra_args(false);
  app.add_flag("--abort", o.abort, "Abort at a finding of a new class, or twice as severe as the baseline's there");
  app.add_flag("--record", record, "Record findings and go on, also where this build aborts by default");
  app.add_option("--baseline", o.baseline, "Findings that are known: .case files and folders")->allow_extra_args(false);

  std::vector<std::string> all(argv + 1, argv + argc);
  const bool told = std::ranges::any_of(all, [](const std::string& a) { return a.starts_with("--tracer"); });
  const char* const inherited = std::getenv(environment);
  if (!told) {
    const auto more = inherited ? words(inherited) : options_of_name(argv[0]);
    all.insert(all.begin(), more.begin(), more.end());
  }
  std::string ours;
  for (const std::string& a : all)
    if (a.starts_with("--")) (ours += a) += '\n';
  try {
    app.parse(std::vector<std::string>(all.rbegin(), all.rend()));
  } catch (const CLI::Success& help) {
    std::exit(app.exit(help));
  } catch (const CLI::ParseError& error) {
    throw InputError(fmt::format("{}; see {} --help", error.what(), argv[0]));
  }
  if (tracer.empty()) throw InputError(fmt::format("no tracer named; try {} --tracer=moller_trumbore_f64", argv[0]));
  o.worker.campaign.tracer = &find_tracer(tracer, foreign);
  o.worker.campaign.space = *from_name<Space>(space_names, space);
  o.worker.campaign.domain = *from_name<Domain>(domain_names, domain);
  o.worker.campaign.search = *from_name<Search>(search_names, search);
  o.abort = (o.abort || aborts_by_default) && !record;
  if (const std::string known = std::string(argv[0]) + "_baseline.case"; fs::exists(known)) o.baseline.push_back(known);
  o.worker.campaign.stream = std::uint64_t{o.worker.job} << 48;
  o.rest = app.remaining();
  if (app.count("--seed") == 0) {
    std::uint64_t& seed = o.worker.campaign.seed;
    seed = seed_of_libfuzzer(o.rest).value_or(o.abort ? std::random_device{}() : seed);
  }
  setenv(environment, ours.c_str(), 1);
  return o;
}

std::unique_ptr<Worker> make_worker(const FuzzerOptions& options) {
  auto worker = std::make_unique<Worker>(options.worker);
  const CampaignPlan& plan = options.worker.campaign;
  for_each_input(options.baseline, plan, [&](const FuzzInput& input) { worker->campaign().recall(input); });
  if (options.abort) {
    Baseline baseline;
    for (const auto& [key, finding] : worker->campaign().findings()) baseline.add(finding);
    auto& on_finding = worker->campaign().on_finding;
    on_finding = [&plan, baseline, record = on_finding](const Finding& finding) {
      if (record) record(finding);
      if (baseline.exceeded_by(finding)) raise_alarm(finding, plan);
    };
  }
  for_each_input(options.seeds, plan, [&](const FuzzInput& input) { worker->test(input); });
  return worker;
}

void stop_on_signals() {
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, [](int) { Worker::stop = true; });
  // A file that may not grow can't be written, which is told at the end. libFuzzer leaves a handler that is there.
  std::signal(SIGXFSZ, [](int) {});
}

}  // namespace plumbline
