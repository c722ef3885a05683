#include <fmt/format.h>

#include <memory>

#include "analysis/bag_examine.h"
#include "analysis/found_case.h"
#include "analysis/tracers.h"
#include "case/case_text.h"
#include "case/input_error.h"
#include "case/printable.h"
#include "case/shell_word.h"
#include "cli/output.h"
#include "cli/triage.h"
#include "findings/store.h"
#include "oracle/bag/explain_bag.h"
#include "oracle/explain.h"

namespace plumbline {
namespace {

// Of several triangles, and where this build has the tracer, what it says now.
std::string explain_several(const Case& what, const Tracer* tracer) {
  const std::vector<Triangle>& triangles = what.bag.triangles;
  if (!tracer) return explain_bag(triangles, what.ray, bag_truth(triangles, what.ray));
  const BagExamination e = examine_bag(*tracer, what);
  return explain_bag_verdict({triangles, e.query, e.truth, tracer->info().contract}, e.answer, e.judgement) +
         explain_bag(triangles, e.query, e.truth);
}

std::string text_of(std::string_view title, const FindingRow& row, const FoundCase& found) {
  const Case& what = found.what;
  return fmt::format("\n{}, {} significant bits\n\n{}\n{}", title, found.bits, to_text(what),
                     what.bag.triangles.size() == 1 ? explain(what.bag.triangles.front(), what.ray)
                                                    : explain_several(what, tracer_named(row.tracer)));
}

// Of several triangles: how the tracer is asked again.
std::string replay_command(const FindingRow& row, const std::string& store) {
  if (row.worst.what.bag.triangles.size() == 1) return "";
  return fmt::format("replay     plumbline promote {} {} regressions && plumbline replay regressions --tracer {}\n",
                     shell_word(store), row.id, shell_word(row.tracer));
}

std::string text_of(const FindingRow& row, const std::string& store) {
  std::string text =
      fmt::format("finding    {}, {}{}\ntracer     {}\nsignature  {}\nkind       {}\nelement    {}\ncondition  {}\n",
                  row.id, status_text(row), row.is_new ? ", new" : "", printable(row.tracer),
                  printable(row.signature), name(row.kind), name(row.element), name(row.conditioning));
  text += fmt::format("worst      {}, {} significant bits\nsimplest   {}, {} significant bits\n",
                      severity_text(row.worst.ulps, row.conditioning), row.worst.bits,
                      severity_text(row.simplest.ulps, row.conditioning), row.simplest.bits);
  text += fmt::format("told       {} times, first {}, last {}\n", row.count, row.first_seen, row.last_seen);
  for (const std::string& build : row.builds) text += fmt::format("build      {}\n", printable(build));
  text += replay_command(row, store);
  if (row.worst.what == row.simplest.what) return text + text_of("Worst and simplest case", row, row.worst);
  return text + text_of("Worst case", row, row.worst) + text_of("Simplest case", row, row.simplest);
}

}  // namespace

void add_triage_show(CLI::App& triage) {
  struct Options {
    std::string store, id;
  };
  CLI::App* verb = triage.add_subcommand("show", "All of one finding: its cases, and why the truth is what it is");
  auto options = std::make_shared<Options>();
  add_store(*verb, options->store)->required();
  verb->add_option("ID", options->id, "Of the finding, as triage lists it")->required();
  verb->footer(
      "The cases are .case text: saved to a file, they go to explain --tracer, shrink and replay. Of several triangles "
      "it\n"
      "tells in which order the ray meets them, and what the tracer says, if this build has it.\n"
      "\nExample:\n"
      "  plumbline triage show found.db 1");
  verb->callback([options] {
    FindingStore store(options->store);
    const auto row = store.row(finding_id(options->id));
    if (!row)
      throw InputError(
          fmt::format("{0}: no finding {1}; 'plumbline triage {0}' lists them", options->store, options->id));
    Output output;
    output.write(text_of(*row, options->store));
    output.finish();
  });
}

}  // namespace plumbline
