#include <fmt/format.h>

#include <memory>

#include "analysis/found_case.h"
#include "case/case_text.h"
#include "case/input_error.h"
#include "case/printable.h"
#include "cli/output.h"
#include "cli/triage.h"
#include "findings/store.h"
#include "oracle/explain.h"

namespace plumbline {
namespace {

std::string text_of(std::string_view title, const FoundCase& found) {
  return fmt::format("\n{}, {} significant bits\n\n{}\n{}", title, found.bits, to_text(found.what),
                     explain(found.what.bag.triangles.front(), found.what.ray));
}

std::string text_of(const FindingRow& row) {
  std::string text =
      fmt::format("finding    {}, {}{}\ntracer     {}\nsignature  {}\nkind       {}\nelement    {}\ncondition  {}\n",
                  row.id, status_text(row), row.is_new ? ", new" : "", printable(row.tracer),
                  printable(row.signature), name(row.kind), name(row.element), name(row.conditioning));
  text += fmt::format("worst      {}, {} significant bits\nsimplest   {}, {} significant bits\n",
                      severity_text(row.worst.ulps, row.conditioning), row.worst.bits,
                      severity_text(row.simplest.ulps, row.conditioning), row.simplest.bits);
  text += fmt::format("told       {} times, first {}, last {}\n", row.count, row.first_seen, row.last_seen);
  for (const std::string& build : row.builds) text += fmt::format("build      {}\n", printable(build));
  if (row.worst.what == row.simplest.what) return text + text_of("Worst and simplest case", row.worst);
  return text + text_of("Worst case", row.worst) + text_of("Simplest case", row.simplest);
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
      "The cases are .case text: saved to a file, they go to explain --tracer, shrink and replay.\n"
      "\nExample:\n"
      "  plumbline triage show found.db 1");
  verb->callback([options] {
    FindingStore store(options->store);
    const auto row = store.row(finding_id(options->id));
    if (!row)
      throw InputError(
          fmt::format("{0}: no finding {1}; 'plumbline triage {0}' lists them", options->store, options->id));
    Output output;
    output.write(text_of(*row));
    output.finish();
  });
}

}  // namespace plumbline
