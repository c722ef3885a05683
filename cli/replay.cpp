#include "analysis/replay.h"

#include <fmt/format.h>

#include <cstdio>

#include "analysis/tracers.h"
#include "cli/output.h"
#include "cli/tracer_options.h"
#include "cli/verb.h"

namespace plumbline {
namespace {

struct Options {
  std::vector<std::string> paths, tracers;
  ForeignOptions foreign;
};

bool run(const Options& options) {
  const auto tracers = find_tracers(options.tracers, options.foreign);
  const ReplaySummary summary = replay(options.paths, tracers);
  Output output;
  for (const ReplayEvent& event : summary.events)
    output.write(fmt::format("{}: {}: {}\n", event.file, event.id, event.message));
  output.finish();
  fmt::print(stderr, "{} cases in {} files, {} answers: {} not as the files say, {} known findings, {} faults",
             summary.cases, summary.files, summary.answers, summary.events.size(), summary.known, summary.faults);
  if (summary.skipped_known > 0) fmt::print(stderr, ", {} known findings of tracers not asked", summary.skipped_known);
  fmt::print(stderr, "\n");
  for (const auto& [tracer, lines] : summary.unknown_tracers)
    fmt::print(stderr, "warning: {} known findings of '{}', which is unknown to this build; {}\n", lines, tracer,
               suggest_tracer(tracer));
  for (std::size_t i = 0; i < tracers.size(); ++i)
    fmt::print(stderr, "{}", complaints(tracers[i]->info().name, summary.conduct[i]));
  return !summary.events.empty();
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
  add_tracer_timeout(*verb, options->foreign);
  verb->footer(
      "The oracle derives what each case expects again, and every tracer is asked and judged. A line is printed for\n"
      "everything that is not as the file says: an expectation that isn't the truth, a wrong answer that no line\n"
      "'known TRACER KIND' lists, and a known one that has changed or gone. A TRACER that this build hasn't is warned "
      "of.\n"
      "corpus/README.md describes the format.\n\n" +
      std::string(foreign_tracers_help) +
      "\nExample:\n"
      "  plumbline replay corpus/hard --tracer woop_watertight_f32\n"
      "  plumbline replay corpus/hard --tracer ./libmine.so");
  verb->callback([options, &disagreement] { disagreement = run(*options); });
}

}  // namespace plumbline
