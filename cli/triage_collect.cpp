#include <fmt/format.h>

#include <map>
#include <memory>

#include "analysis/tracers.h"
#include "case/printable.h"
#include "cli/tracer_options.h"
#include "cli/triage.h"
#include "findings/collect.h"
#include "findings/collector.h"
#include "findings/found.h"
#include "findings/store.h"

namespace plumbline {
namespace {

struct Options {
  std::string store, tracer;
  std::vector<std::string> paths;
  ForeignOptions foreign;
};

void run(const Options& options) {
  // As retest has it: what a file names is not run.
  const Tracer* const named = options.tracer.empty() ? nullptr : &find_tracer(options.tracer, options.foreign);
  FindingStore(options.store, Open::create);
  Collector collector(options.store, "collect");
  std::size_t found = 0, right = 0;
  std::map<std::string, std::size_t> absent;
  for (const std::string& path : options.paths)
    for_each_known(path, [&](const Case& what, const std::string& name) {
      const Tracer* const tracer = named && named->info().name == name ? named : tracer_named(name);
      if (!tracer) {
        ++absent[name];
        return;
      }
      collector.count(name, 1);
      const auto finding = ask_for_finding(*tracer, what, "collect: " + path);
      ++(finding ? found : right);
      if (finding) collector.add(*finding);
    });
  collector.finish();
  FindingStore(options.store);
  fmt::print(stderr, "{} findings, {} cases that their tracer gets right now\n", found, right);
  for (const auto& [name, count] : absent)
    fmt::print(
        stderr,
        "skipped: {} cases of '{}', which is no tracer of this build; a tracer of yours is asked with --tracer\n",
        count, printable(name));
}

}  // namespace

void add_triage_collect(CLI::App& triage) {
  CLI::App* verb = triage.add_subcommand("collect", "Take in findings of campaigns and .case files");
  auto options = std::make_shared<Options>();
  add_store(*verb, options->store)->required();
  verb->add_option("PATH", options->paths, "Folders of campaigns, findings.ndjson, .case files and folders of these")
      ->required();
  verb->add_option("--tracer", options->tracer,
                   "A tracer of yours, whose findings are among them; it isn't run otherwise")
      ->type_name("NAME");
  add_tracer_timeout(*verb, options->foreign);
  verb->footer(
      "Of .case files it takes the cases with a line 'known TRACER KIND'. Nothing is trusted: every case is put to "
      "its tracer\n"
      "again, and told to the store if the answer is wrong now. DB is made where there is none.\n"
      "\nExamples:\n"
      "  plumbline triage collect found.db mt\n"
      "  plumbline triage collect found.db corpus/hard corpus/adapters");
  verb->callback([options] { run(*options); });
}

}  // namespace plumbline
