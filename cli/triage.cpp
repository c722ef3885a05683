#include "cli/triage.h"

#include <fmt/format.h>

#include <charconv>

#include "case/input_error.h"
#include "case/printable.h"
#include "cli/verb.h"

namespace plumbline {

CLI::Option* add_store(CLI::App& app, std::string& path) {
  return app.add_option("DB", path, "The store, as made by --findings DB of fuzz, sweep, scan and judge");
}

std::string status_text(const FindingRow& row) {
  if (row.status == FindingStatus::duplicate) return fmt::format("dup of {}", row.duplicate_of);
  return std::string(name(row.status));
}

std::int64_t finding_id(const std::string& word) {
  std::int64_t id = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), id);
  if (error != std::errc() || end != word.data() + word.size() || id < 1)
    throw InputError(fmt::format("'{}' is no ID of a finding; 'plumbline triage DB' lists them", printable(word)));
  return id;
}

std::string cell(std::string_view text, std::size_t most) {
  std::string all = printable(text);
  if (all.size() <= most) return all;
  all.resize(most - 3);
  return printable(all) + "...";  // again, for a character that was cut in two
}

void add_triage(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("triage", "What was found, over all searches: list it, look at it, settle it");
  add_triage_list(*verb);
  add_triage_show(*verb);
  add_triage_set(*verb);
  add_triage_retest(*verb);
  add_triage_rebuild(*verb);
  add_triage_collect(*verb);
  add_triage_html(*verb);
  verb->require_subcommand(0, 1);
  verb->footer(
      "A store gathers what searches find: one finding for each way in which a tracer is wrong (its signature), with "
      "how\n"
      "often it was told, the worst case and the simplest. By itself, triage lists the open ones, the nominal first, "
      "the\n"
      "worst first; * marks what is new since the search before the last one of that tracer; and it ends with what "
      "was\n"
      "searched and how near to another answer that came. severity: how far the ray would have to move for the "
      "answer to be\n"
      "true, in ulps of the largest coordinate.\n"
      "A finding is open, fixed, dup (of another), invalid or wontfix. A fixed one that is found again is open "
      "again.\n"
      "DB has a journal DB.ndjson beside it, which is the truth; keep both. docs/triage.md tells more.\n"
      "\nExamples:\n"
      "  plumbline fuzz --tracer moller_trumbore_f64 --time 10 -o mt --findings found.db\n"
      "  plumbline triage found.db\n"
      "  plumbline triage show found.db 1\n"
      "  plumbline triage set found.db 2 dup-of:1\n"
      "  plumbline promote found.db 1 regressions");
}

}  // namespace plumbline
