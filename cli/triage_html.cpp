#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "case/folder.h"
#include "case/input_error.h"
#include "cli/number_options.h"
#include "cli/output.h"
#include "cli/tracer_options.h"
#include "cli/triage.h"
#include "findings/case_rows.h"
#include "findings/pages/pages.h"
#include "findings/store.h"
#include "fuzz/summary.h"
#include "repros/repro.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> paths, tracers;
  std::string folder;
  std::size_t pages = 200;
  ForeignOptions foreign;
};

struct Findings {
  std::vector<FindingRow> rows;
  std::vector<SearchRow> searches;
};

// By its journal, or as a database that has lost it.
bool is_store(const std::string& path) {
  if (fs::is_directory(path)) return false;
  constexpr std::string_view magic = "SQLite format 3";
  std::string begin(magic.size(), '\0');
  std::ifstream(path, std::ios::binary).read(begin.data(), static_cast<std::streamsize>(begin.size()));
  return fs::exists(path + ".ndjson") || begin == magic;
}

// A campaign's folder tells who was searched, and what for.
Findings read(const std::vector<std::string>& paths) {
  Findings all;
  if (std::ranges::any_of(paths, is_store)) {
    if (paths.size() > 1)
      throw InputError(fmt::format("{}: a store stands alone; 'plumbline triage collect' takes folders into it",
                                   *std::ranges::find_if(paths, is_store)));
    FindingStore store(paths.front());
    return {.rows = store.rows(), .searches = store.searches()};
  }
  std::vector<CasePath> from;
  for (const std::string& path : paths) {
    const fs::path file = fs::path(path) / "summary.json";
    const auto summary = read_summary(file);
    if (!summary) {
      from.push_back({path, ""});
      continue;
    }
    all.searches.push_back(
        {.tracer = summary->tracer,
         .source = fmt::format("fuzz: space {}, domain {}, seed {}", summary->space, summary->domain, summary->seed),
         .ended = time_of(file.string()),
         .executions = summary->executions,
         .worst_nominal_ulps = summary->worst_nominal_severity,
         .signatures = summary->signatures});
    if (const fs::path cases = fs::path(path) / "findings"; fs::is_directory(cases) && !fs::is_empty(cases))
      from.push_back({cases.string(), summary->tracer});
  }
  CaseRows found = rows_of_cases(from);
  for (const auto& [name, cases] : found.unknown)
    fmt::print(stderr, "{}: not in this build; {} of its cases left out ({})\n", name, cases, suggest_tracer(name));
  if (found.right > 0) fmt::print(stderr, "{} cases left out: their tracers get them right\n", found.right);
  all.rows = std::move(found.rows);
  return all;
}

std::vector<const Tracer*> tracers_of(const Options& options) {
  std::vector<const Tracer*> all;
  for (const auto& tracer : all_tracers()) all.push_back(tracer.get());
  for (const std::string& name : options.tracers)
    if (const Tracer& tracer = find_tracer(name, options.foreign); std::ranges::find(all, &tracer) == all.end())
      all.push_back(&tracer);
  return all;
}

std::optional<std::string> repro(const Case& what, ReproForm form, std::string_view tracer) {
  try {
    return to_repro(what, form, tracer);
  } catch (const InputError&) {  // the case can't be told in that form
    return std::nullopt;
  }
}

void run(const Options& options) {
  PageOptions pages{.pages = options.pages, .tracers = tracers_of(options), .repro = repro};
  const Findings findings = read(options.paths);
  make_folder(options.folder);
  if (isatty(STDERR_FILENO) != 0)
    pages.progress = [](std::size_t done, std::size_t of) {
      fmt::print(stderr, "\r\x1b[K{}", done < of ? fmt::format("{} of {} pages", done, of) : "");
    };
  std::size_t written = 0;
  write_pages(findings.rows, findings.searches, pages, [&](const std::string& name, const std::string& text) {
    Output file((fs::path(options.folder) / name).string());
    file.write(text);
    file.finish();
    written += name.ends_with(".html");
  });
  Output output;
  output.write(fmt::format("{}: {} findings, {} of them with pages of their own\n",
                           (fs::path(options.folder) / "index.html").string(), findings.rows.size(), written - 1));
  output.finish();
}

}  // namespace

void add_triage_html(CLI::App& triage) {
  CLI::App* verb =
      triage.add_subcommand("html", "Findings as static pages: a list, and a page for each of the worst");
  auto options = std::make_shared<Options>();
  Options& o = *options;
  verb->add_option("PATH", o.paths, "A store; or folders of campaigns, .case files with lines 'known', folders of them")
      ->required();
  verb->add_option("-o,--output", o.folder, "Where the pages go; made if it isn't there")
      ->required()
      ->type_name("DIR");
  verb->add_option("--pages", o.pages, "So many findings get a page of their own, the worst nominal ones first")
      ->check(CLI::Range(std::size_t{0}, std::size_t{1'000'000}))
      ->type_name("N")
      ->capture_default_str();
  verb->add_option("--tracer", o.tracers,
                   "A tracer of your own that pages ask too, beside all of this build; repeatable")
      ->type_name("NAME");
  add_tracer_timeout(*verb, o.foreign);
  verb->footer(
      "DIR/index.html lists every signature of every tracer: to filter, to sort, with a map of tracers and "
      "conditions, and\n"
      "what was searched. What is filtered is kept in the address, so that it can be sent to somebody.\n"
      "DIR/finding-ID.html tells of one: what is wrong, by how much and why, in exact numbers; pictures, down to an "
      "ulp;\n"
      "what every other tracer of this build says of the same case; whether the cases beside it are wrong too; and "
      "what to\n"
      "paste into a report. finding-ID.case holds its simplest and its worst case.\n"
      "Each page is one file that fetches nothing: it can be mailed, attached, or served from anywhere.\n"
      "Every case is asked again while the pages are written: by its tracer, and by all others.\n"
      "\nExamples:\n"
      "  plumbline fuzz --tracer woop_watertight_f32 --time 10 -o woop\n"
      "  plumbline triage html woop -o pages && xdg-open pages/index.html\n"
      "  plumbline triage html found.db -o pages\n"
      "  plumbline triage html corpus/hard -o pages --tracer ./libmine.so");
  verb->callback([options] { run(*options); });
}

}  // namespace plumbline
