#include <fmt/format.h>

#include <memory>

#include "analysis/tracers.h"
#include "case/input_error.h"
#include "case/printable.h"
#include "cli/output.h"
#include "cli/tracer_options.h"
#include "cli/triage.h"
#include "cli/verb.h"
#include "findings/promotion.h"
#include "findings/store.h"

namespace plumbline {
namespace {

struct Options {
  std::string store, id, folder, tracer;
  bool failing = false;
  ForeignOptions foreign;
};

void run(const Options& options) {
  FindingStore store(options.store);
  std::optional<FindingRow> row;
  if (options.id == "worst") {
    const auto open = store.rows({.only_open = true, .details = false});
    if (!open.empty()) row = store.row(open.front().id);
  } else {
    row = store.row(finding_id(options.id));
  }
  if (!row)
    throw InputError(
        fmt::format("{0}: no finding {1}; 'plumbline triage {0}' lists them", options.store, options.id));
  const Tracer* const tracer =
      options.tracer.empty() ? tracer_named(row->tracer) : &find_tracer(options.tracer, options.foreign);
  if (tracer && tracer->info().name != row->tracer)
    throw InputError(fmt::format("finding {} is of '{}', not of '{}'; name that with --tracer", row->id,
                                 printable(row->tracer), printable(tracer->info().name)));
  if (!tracer && options.failing)
    throw InputError(fmt::format("--failing: '{}' is no tracer of this build; say which is to be right, with --tracer",
                                 printable(row->tracer)));
  if (!tracer)
    fmt::print(stderr,
               "as it was found, not shrunk: '{}' is no tracer of this build; one of yours is asked with --tracer\n",
               printable(row->tracer));
  Case what = promoted(*row, tracer);
  if (options.failing)
    what.known.clear();
  else if (what.known.empty())
    fmt::print(stderr,
               "without a line 'known', which is for false misses and hits of tracers whose name is one word\n");
  if (options.failing) make_ctest_project(options.folder, options.tracer.empty() ? row->tracer : options.tracer);
  const std::string path = put_in_folder(what, file_stem(*row), options.folder);
  Output output;
  output.write(path + "\n");
  output.finish();
}

}  // namespace

void add_promote(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("promote", "Make a finding of a store a regression test: a shrunk .case");
  auto options = std::make_shared<Options>();
  add_store(*verb, options->store)->required();
  verb->add_option("ID", options->id, "Of the finding, as triage lists it; or worst: the first that it lists")->required();
  verb->add_option("DIR", options->folder, "Where the .case goes; made where there is none")->required();
  verb->add_option("--tracer", options->tracer, "Whose finding it is: needed for a tracer of yours, to shrink it")
      ->type_name("NAME");
  verb->add_flag("--failing", options->failing,
                 "A test that fails until the tracer is right: without the line 'known'; and if DIR has no CMakeLists.txt,\n"
                 "one that runs all its cases with CTest, by an installed Plumbline");
  add_tracer_timeout(*verb, options->foreign);
  verb->footer(
      "Shrinks the worst case, or the simplest where only that shows the finding still, its condition kept. Writes it\n"
      "with where it comes from, what the oracle says of it, and a line 'known', so that replay passes while the\n"
      "tracer is wrong and tells when it isn't. Prints the path. Another case is never overwritten: it becomes\n"
      "NAME-2.case. The same finding again is the same file.\n"
      "\nExample:\n"
      "  plumbline promote found.db 1 regressions && plumbline replay regressions --tracer moller_trumbore_f64");
  verb->callback([options] { run(*options); });
}

}  // namespace plumbline
