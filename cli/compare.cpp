#include "analysis/compare.h"

#include <fmt/format.h>

#include <filesystem>

#include "analysis/compare_table.h"
#include "analysis/tracers.h"
#include "case/enum_names.h"
#include "case/input_error.h"
#include "cli/long_run.h"
#include "cli/number_options.h"
#include "cli/verb.h"

namespace plumbline {
namespace {

struct Options {
  std::vector<std::string> tracers, families;
  std::string inputs = "binary32", directory;
  std::uint64_t count = 1000, seed = 1;
  std::size_t worst = 3;
  bool json = false;
};

// Without names: all that read inputs of this precision.
std::vector<const Tracer*> tracers_of(const Options& options, Precision inputs) {
  if (!options.tracers.empty() && options.tracers != std::vector<std::string>{"all"}) return find_tracers(options.tracers);
  auto list = find_tracers({"all"});
  if (inputs == Precision::binary64)
    std::erase_if(list, [](const Tracer* t) { return t->info().contract.precision == Precision::binary32; });
  return list;
}

ComparePlan plan_of(const Options& options) {
  ComparePlan plan;
  plan.inputs = *from_name<Precision>(precision_names, options.inputs);
  plan.tracers = tracers_of(options, plan.inputs);
  plan.count = options.count;
  plan.seed = options.seed;
  plan.worst = options.worst;
  for (const std::string& family : options.families) plan.families.push_back(*from_name<Family>(family_names, family));
  if (options.families.empty())
    for (std::size_t i = 0; i < family_names.size(); ++i)
      if (const auto family = static_cast<Family>(i); plan.inputs == Precision::binary64 || suits_binary32(family))
        plan.families.push_back(family);
  return plan;
}

void show_progress(std::uint64_t done, std::uint64_t planned) {
  if (done % 256 == 0) fmt::print(stderr, "\r{:5.1f} % of {} cases", 100.0 * static_cast<double>(done) / static_cast<double>(planned), planned);
}

void run(const Options& options) {
  const ComparePlan plan = plan_of(options);
  std::vector<ResultFile<CompareResult>> wanted;
  if (!options.directory.empty()) {
    std::error_code error;
    std::filesystem::create_directories(options.directory, error);
    if (error)
      throw InputError(fmt::format("{}: cannot be made a folder: {}; write elsewhere", options.directory, error.message()));
    wanted = {{options.directory + "/table.md", to_markdown},
              {options.directory + "/compare.json", to_json_lines},
              {options.directory + "/worst.case", to_cases}};
  }
  ResultFiles<CompareResult> files(std::move(wanted));
  const CompareResult result =
      run_long(show_progress, [&](const auto& stop, const auto& progress) { return compare(plan, stop, progress); });
  files.finish(result, options.json ? to_json_lines(result) : to_terminal(result));
  complain(plan.tracers, result.conduct);
  if (const std::uint64_t planned = plan.count * plan.families.size(); result.done < planned)
    throw std::runtime_error(
        fmt::format("interrupted after {} of {} cases: what is printed is of these", result.done, planned));
}

}  // namespace

void add_compare(CLI::App& app) {
  auto options = std::make_shared<Options>();
  Options& o = *options;
  CLI::App* verb = app.add_subcommand("compare", "Tracers side by side on hard cases: who is wrong, how badly, who is right");
  verb->add_option("TRACER", o.tracers, "Two or more names of 'plumbline tracers' (default: all that read the inputs)");
  verb->add_option("--family", o.families, "Kind of cases; repeatable (default: all that suit the inputs)")
      ->check(CLI::IsMember(std::vector<std::string>(family_names.begin(), family_names.end())))
      ->type_name("NAME");
  verb->add_option("--inputs", o.inputs, "What all numbers of a case are; binary32 tracers can't read binary64")
      ->check(CLI::IsMember(std::vector<std::string>(precision_names.begin(), precision_names.end())))
      ->type_name("PRECISION")
      ->capture_default_str();
  verb->add_option("--count", o.count, "Cases of each family")->check(whole_number())->type_name("N")->capture_default_str();
  verb->add_option("--seed", o.seed, "Of the cases")->check(whole_number())->type_name("N")->capture_default_str();
  verb->add_option("--worst", o.worst, "Cases to keep of each tracer and family, the worst ones")
      ->type_name("N")
      ->capture_default_str();
  verb->add_flag("--json", o.json, "Print JSON, one object a line");
  verb->add_option("-o", o.directory, "Write table.md, compare.json and worst.case, which 'plumbline replay' reads")
      ->type_name("DIR");
  verb->footer(
      "A line for each tracer, a column for each family: false misses/false hits by the tracer's own contract, '.' for "
      "none.\n"
      "Where its interface rounds the ray (segments, normalized directions), a second line tells what they would be had\n"
      "it been asked the ray itself. boundary hit %: of rays that meet an edge or vertex exactly, the share it hits.\n"
      "worst S_N: by how much the worst well-conditioned case is wrong, in ulps of its largest coordinate. open: cases "
      "that\nits contract says nothing of. Of up to four tracers, where two disagree and who is right, by family and class.\n"
      "\nExamples:\n"
      "  plumbline compare moller_trumbore_f32 woop_watertight_f32\n"
      "  plumbline compare --inputs binary64 --count 10000 -o results/compare");
  verb->callback([options] { run(*options); });
}

}  // namespace plumbline
