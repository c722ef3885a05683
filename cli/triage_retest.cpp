#include <fmt/format.h>

#include <map>
#include <memory>

#include "analysis/tracers.h"
#include "case/printable.h"
#include "cli/output.h"
#include "cli/tracer_options.h"
#include "cli/triage.h"
#include "findings/found.h"
#include "findings/store.h"

namespace plumbline {
namespace {

struct Options {
  std::string store, tracer;
  ForeignOptions foreign;
};

bool still_fails(const FindingRow& row, const Tracer& tracer) {
  return ask_for_finding(tracer, row.worst.what, "retest") || ask_for_finding(tracer, row.simplest.what, "retest");
}

void run(const Options& options) {
  // Foreign tracers are run when they are named here, not when a store names them: a name is a command.
  const Tracer* const named = options.tracer.empty() ? nullptr : &find_tracer(options.tracer, options.foreign);
  FindingStore store(options.store);
  Output output;
  std::size_t asked = 0, failing = 0, fixed = 0, reopened = 0;
  std::map<std::string, std::size_t> absent;
  for (const FindingRow& row : store.rows({.tracer = named ? named->info().name : ""})) {
    if (row.status != FindingStatus::open && row.status != FindingStatus::fixed) continue;
    const Tracer* const tracer = named ? named : tracer_named(row.tracer);
    if (!tracer) {
      ++absent[row.tracer];
      continue;
    }
    ++asked;
    const bool fails = still_fails(row, *tracer);
    failing += fails;
    const FindingStatus now = fails ? FindingStatus::open : FindingStatus::fixed;
    if (now == row.status) continue;
    store.set_status(row.id, now, 0, "retest");
    ++(fails ? reopened : fixed);
    output.write(fmt::format("{} {} {} {}\n", fails ? "reopened" : "fixed", row.id, printable(row.tracer),
                             printable(row.signature)));
  }
  output.write(fmt::format("{} findings asked again: {} fail, {} of them reopened; {} closed as fixed\n", asked,
                           failing, reopened, fixed));
  output.finish();
  for (const auto& [name, count] : absent)
    fmt::print(
        stderr,
        "skipped: {} findings of '{}', which is no tracer of this build; a tracer of yours is asked with --tracer\n",
        count, printable(name));
}

}  // namespace

void add_triage_retest(CLI::App& triage) {
  CLI::App* verb =
      triage.add_subcommand("retest", "Ask the tracers again: close what no longer fails, reopen what does");
  auto options = std::make_shared<Options>();
  add_store(*verb, options->store)->required();
  verb->add_option("--tracer", options->tracer,
                   "Only findings of this one; also a tracer of yours, which isn't run otherwise")
      ->type_name("NAME");
  add_tracer_timeout(*verb, options->foreign);
  verb->footer(
      "Of every finding that is open or fixed, the worst and the simplest case are put to its tracer: it is fixed "
      "where both\n"
      "are right, else open. What is dup, invalid or wontfix stays. Tracers that this build hasn't are skipped, and "
      "named.\n"
      "\nExamples:\n"
      "  plumbline triage retest found.db\n"
      "  plumbline triage retest found.db --tracer ./libmine.so");
  verb->callback([options] { run(*options); });
}

}  // namespace plumbline
