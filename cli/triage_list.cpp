#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>

#include "analysis/text_table.h"
#include "analysis/tracers.h"
#include "case/input_error.h"
#include "case/json_object.h"
#include "case/printable.h"
#include "cli/output.h"
#include "cli/triage.h"
#include "findings/store.h"
#include "float_tracer/plugin.h"

namespace plumbline {
namespace {

struct Options {
  std::string store;
  bool all = false, only_new = false, json = false;
  std::string tracer;
};

// All searches of a tracer together.
struct Searched {
  std::uint64_t searches = 0, executions = 0;
  double worst_nominal = 0, least_margin = 0;
  std::string ended;
};

std::map<std::string, Searched> searched_by_tracer(const std::vector<SearchRow>& searches,
                                                   const std::string& tracer) {
  std::map<std::string, Searched> all;
  for (const SearchRow& s : searches) {
    if (!tracer.empty() && s.tracer != tracer) continue;
    Searched& sum = all[s.tracer];
    ++sum.searches;
    sum.executions += s.executions;
    sum.worst_nominal = std::max(sum.worst_nominal, s.worst_nominal_ulps);
    if (s.least_margin_ulps > 0)
      sum.least_margin = sum.least_margin > 0 ? std::min(sum.least_margin, s.least_margin_ulps) : s.least_margin_ulps;
    sum.ended = s.ended;
  }
  return all;
}

std::string findings_text(const std::vector<FindingRow>& rows, const Options& options) {
  const std::string_view kept = options.all ? "" : "open ";
  if (rows.empty()) return fmt::format("No {}{}findings.\n", options.only_new ? "new " : "", kept);
  TextTable table{{{"id", true},
                   {""},
                   {"status"},
                   {"tracer"},
                   {"signature"},
                   {"severity", true},
                   {"bits", true},
                   {"count", true},
                   {"first seen"},
                   {"last seen"}},
                  {}};
  std::set<std::string_view> tracers;
  for (const FindingRow& row : rows) {
    tracers.insert(row.tracer);
    table.rows.push_back({std::to_string(row.id), row.is_new ? "*" : "", status_text(row), cell(row.tracer),
                          cell(row.signature, 60), fmt::format("{:.4g}", row.worst.ulps),
                          std::to_string(row.simplest.bits), std::to_string(row.count), row.first_seen,
                          row.last_seen});
  }
  return to_terminal(table) + fmt::format("{} {}findings of {} tracers, {} of them new\n", rows.size(), kept,
                                          tracers.size(), std::ranges::count_if(rows, &FindingRow::is_new));
}

std::string searches_text(const std::map<std::string, Searched>& searched) {
  if (searched.empty()) return "\nNo search has ended yet.\n";
  TextTable table{{{"searched"},
                   {"searches", true},
                   {"executions", true},
                   {"worst nominal severity", true},
                   {"nearest right answer", true},
                   {"last"}},
                  {}};
  for (const auto& [tracer, sum] : searched)
    table.rows.push_back({cell(tracer), std::to_string(sum.searches), std::to_string(sum.executions),
                          fmt::format("{:.4g}", sum.worst_nominal),
                          sum.least_margin > 0 ? fmt::format("{:.4g}", sum.least_margin) : "not told", sum.ended});
  return "\n" + to_terminal(table) +
         "Both in ulps of the largest coordinate: of the worst nominal case, and of the nominal case that was "
         "answered rightly\n"
         "with another answer nearest.\n";
}

void write_json(const FindingRow& row, std::string& out) {
  JsonObject json(out);
  json.text("row", "finding");
  json.number("id", static_cast<double>(row.id));
  json.text("status", name(row.status));
  json.number("duplicate_of",
              row.duplicate_of == 0 ? std::nullopt : std::optional(static_cast<double>(row.duplicate_of)));
  json.boolean("new", row.is_new);
  json.text("tracer", row.tracer);
  json.text("signature", row.signature);
  json.text("kind", name(row.kind));
  json.text("element", name(row.element));
  json.text("conditioning", name(row.conditioning));
  json.number("worst_ulps", row.worst.ulps);
  json.number("worst_bits", row.worst.bits);
  json.number("simplest_ulps", row.simplest.ulps);
  json.number("simplest_bits", row.simplest.bits);
  json.number("count", static_cast<double>(row.count));
  json.text("first_seen", row.first_seen);
  json.text("last_seen", row.last_seen);
  json.end_line();
}

void write_json(const SearchRow& row, std::string& out) {
  JsonObject json(out);
  json.text("row", "search");
  json.text("tracer", row.tracer);
  json.text("source", row.source);
  json.text("ended", row.ended);
  json.number("executions", static_cast<double>(row.executions));
  json.number("worst_nominal_ulps", row.worst_nominal_ulps);
  json.number("least_margin_ulps", row.least_margin_ulps > 0 ? std::optional(row.least_margin_ulps) : std::nullopt);
  json.number("signatures", static_cast<double>(row.signatures));
  json.end_line();
}

// Of a name that nothing was found of, or that was mistyped, there is no all-clear.
void require_known(FindingStore& store, const std::vector<SearchRow>& searches, const std::string& tracer,
                   const std::string& path) {
  const auto of_tracer = [&tracer](const SearchRow& s) { return s.tracer == tracer; };
  if (std::ranges::any_of(searches, of_tracer) || !store.rows({.tracer = tracer, .details = false}).empty()) return;
  std::set<std::string> known;
  for (const SearchRow& s : searches) known.insert(s.tracer);
  for (const FindingRow& row : store.rows({.details = false})) known.insert(row.tracer);
  std::string names;
  for (const std::string& name : known) names += (names.empty() ? "" : ", ") + cell(name);
  throw InputError(fmt::format("{}: has nothing of '{}'; it has: {}", path, printable(tracer),
                               names.empty() ? "nothing yet" : names));
}

void run(const Options& options) {
  if (options.store.empty()) throw InputError("which store? Give DB, as in 'plumbline triage found.db'");
  FindingStore store(options.store);
  const std::vector<SearchRow> searches = store.searches();
  const std::string tracer = names_plugin(options.tracer) ? find_tracer(options.tracer).info().name : options.tracer;
  if (!tracer.empty()) require_known(store, searches, tracer, options.store);
  const std::vector<FindingRow> rows =
      store.rows({.only_open = !options.all, .only_new = options.only_new, .tracer = tracer, .details = false});
  std::string text;
  if (options.json) {
    for (const FindingRow& row : rows) write_json(row, text);
    for (const SearchRow& row : searches)
      if (tracer.empty() || row.tracer == tracer) write_json(row, text);
  } else {
    text = findings_text(rows, options) + searches_text(searched_by_tracer(searches, tracer));
  }
  Output output;
  output.write(text);
  output.finish();
}

void add_options(CLI::App& app, const std::shared_ptr<Options>& options) {
  add_store(app, options->store);
  app.add_flag("--all", options->all, "Those that are settled too");
  app.add_flag("--new", options->only_new, "Only what is new since the search before the last one of its tracer");
  app.add_option("--tracer", options->tracer, "Only of this tracer")->type_name("NAME");
  app.add_flag("--json", options->json, "One object a line: the findings, then the searches");
}

}  // namespace

void add_triage_list(CLI::App& triage) {
  auto options = std::make_shared<Options>();
  add_options(triage, options);
  triage.callback([options, &triage] {
    if (triage.get_subcommands().empty()) run(*options);
  });
  CLI::App* list =
      triage.add_subcommand("list", "The same as triage alone: for a DB that is called like a subcommand");
  auto listed = std::make_shared<Options>();
  add_options(*list, listed);
  list->callback([listed] { run(*listed); });
}

}  // namespace plumbline
