#include "analysis/replay.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "analysis/reports/replay_github.h"
#include "analysis/reports/replay_json.h"
#include "analysis/reports/replay_junit.h"
#include "analysis/reports/replay_sarif.h"
#include "analysis/tracers.h"
#include "case/input_error.h"
#include "cli/output.h"
#include "cli/tracer_options.h"
#include "cli/verb.h"

namespace plumbline {
namespace {

struct Options {
  std::vector<std::string> paths, tracers;
  std::string junit, sarif, json;
  bool github = false, no_faults = false;
  ForeignOptions foreign;
};

bool is_new_fault(const ReplayResult& r) { return r.rule == ReplayRule::fault && !r.known; }

std::string to_lines(const ReplaySummary& summary, bool no_faults) {
  std::string out;
  for (const ReplayResult& result : summary.results) {
    if (!disagrees(result) && !(no_faults && is_new_fault(result))) continue;
    const ReplayedCase& at = summary.cases[result.which];
    const std::string whose = result.tracer ? summary.tracers[*result.tracer] + ": " : "";
    out += fmt::format("{}: {}: {}{}\n", at.file, at.id, whose, result.message);
  }
  return out;
}

// A file that is wanted as well. It is opened before the work begins, so that a place that can't be written is told
// then.
class Report {
 public:
  explicit Report(const std::string& path) {
    if (!path.empty()) output_.emplace(path);
  }

  template <class Text>
  void write(const Text& text) {
    if (!output_) return;
    output_->write(text());
    output_->finish();
  }

 private:
  std::optional<Output> output_;
};

void summarize(const ReplaySummary& summary) {
  const auto count = [&summary](const auto& is) { return std::ranges::count_if(summary.results, is); };
  fmt::print(stderr, "{} cases in {} files, {} answers: {} not as the files say, {} known findings, {} faults",
             summary.cases.size(), summary.files, summary.cases.size() * summary.tracers.size(),
             summary.disagreements(), count([](const ReplayResult& r) { return r.known && !r.rule; }),
             count(is_new_fault));
  if (summary.skipped_known > 0) fmt::print(stderr, ", {} known findings of tracers not asked", summary.skipped_known);
  fmt::print(stderr, "\n");
  for (const auto& [tracer, lines] : summary.unknown_tracers)
    fmt::print(stderr, "warning: {} known findings of '{}', which is unknown to this build; {}\n", lines, tracer,
               suggest_tracer(tracer));
  for (std::size_t i = 0; i < summary.tracers.size(); ++i)
    fmt::print(stderr, "{}", complaints(summary.tracers[i], summary.conduct[i]));
}

bool run(const Options& options) {
  if (options.github && options.json == "-")
    throw InputError("--github and --json - both write to standard output; give --json a file");
  const auto tracers = find_tracers(options.tracers, options.foreign);
  Report junit(options.junit), sarif(options.sarif), json(options.json);
  const ReplaySummary summary = replay(options.paths, tracers);
  junit.write([&] { return to_junit(summary); });
  sarif.write([&] { return to_sarif(summary, PLUMBLINE_VERSION); });
  json.write([&] { return to_json_lines(summary); });
  if (options.json != "-") {
    Output output;
    output.write(options.github ? to_github(summary) : to_lines(summary, options.no_faults));
    output.finish();
  }
  summarize(summary);
  return summary.disagreements() > 0 || (options.no_faults && std::ranges::any_of(summary.results, is_new_fault));
}

}  // namespace

void add_replay(CLI::App& app, bool& disagreement) {
  CLI::App* verb =
      app.add_subcommand("replay", "Run .case files as a regression test: exit code 1 if something changed");
  auto options = std::make_shared<Options>();
  verb->add_option("PATH", options->paths, ".case files, and folders that are searched for *.case")->required();
  verb->add_option("--tracer", options->tracers, "Whom to ask, or 'all'; repeatable (default: textbook kernels, BRL-CAD's rules,\nEmbree, exact)")
      ->type_name("NAME")
      ->expected(1)
      ->take_all();
  verb->add_option("--junit", options->junit, "Write JUnit XML too: a testsuite for each tracer")->type_name("FILE");
  verb->add_option("--sarif", options->sarif, "Write SARIF 2.1.0 too, for code scanning")->type_name("FILE");
  verb->add_option("--json", options->json,
                   "Write a JSON line for each case and tracer too; '-': in place of the lines for people")
      ->type_name("FILE");
  verb->add_flag("--github", options->github,
                 "Print annotations for GitHub's workflows in place of the lines for people");
  verb->add_flag("--no-faults", options->no_faults, "A fault that isn't listed (no answer, a crash) fails as well");
  add_tracer_timeout(*verb, options->foreign);
  verb->footer(
      "The oracle derives what each case expects again, and every tracer is asked and judged. A line is printed for\n"
      "everything that is not as the file says: an expectation that isn't the truth, a wrong answer that no line\n"
      "'known TRACER KIND' lists, and a known one that has changed or gone. A TRACER that this build hasn't is "
      "warned of.\n"
      "corpus/README.md describes the format, docs/regressions.md how to use this in CI.\n\n"
      "Of several triangles a tracer is judged by what it hits first: a leak is a miss where one of them has to be\n"
      "hit, wrong-nearest another triangle than has to be first.\n\n"
      "Exit codes: 0 all is as the files say; 1 it isn't; 2 trouble: a file without a case, or that can't be read,\n"
      "several triangles that aren't surfaces, no such tracer. A fault that isn't listed is counted and told in the "
      "reports,\n"
      "and is no disagreement but with --no-faults.\n\n"
      "The reports name files from the current folder on. They tell by seven rules: false-miss, false-hit, fault,\n"
      "known-now-passes, expectation-differs, leak, wrong-nearest. Keys of a JSON line:\n"
      "  file, line, id   where the case is\n"
      "  tracer           who answered; null: the line is about what the file expects\n"
      "  verdict          correct, false-miss, false-hit, leak, wrong-nearest, unspecified or fault\n"
      "  known            as what the file lists this tracer, or null\n"
      "  severity         of a wrong answer: how far the ray would have to move for it to be right, as a length;\n"
      "                   severity_ulps in units in the last place of the largest coordinate\n"
      "  signature        what kind of error it is: equal for those of one kind\n"
      "  as_stated        false: it counts for exit code 1\n"
      "  rule, message    what there is to tell, or null\n\n" +
      std::string(foreign_tracers_help) +
      "\nExamples:\n"
      "  plumbline replay corpus/hard --tracer woop_watertight_f32\n"
      "  plumbline replay corpus/hard --tracer ./libmine.so --junit replay.xml --sarif replay.sarif\n"
      "  plumbline replay corpus/hard --tracer ./libmine.so --json - | jq 'select(.as_stated | not)'");
  verb->callback([options, &disagreement] { disagreement = run(*options); });
}

}  // namespace plumbline
