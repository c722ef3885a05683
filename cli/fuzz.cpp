#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>

#include "analysis/text_table.h"
#include "case/enum_names.h"
#include "case/input_error.h"
#include "cli/findings_option.h"
#include "cli/number_options.h"
#include "cli/output.h"
#include "cli/tracer_options.h"
#include "cli/verb.h"
#include "findings/store.h"
#include "fuzz/findings_folder.h"
#include "fuzz/launcher.h"
#include "fuzz/worker.h"

namespace plumbline {
namespace {

struct Options {
  std::string tracer, space = "ray", domain = "nominal", folder, store;
  std::optional<std::uint64_t> runs;
  std::optional<double> seconds;
  unsigned jobs = 1;
  std::uint64_t seed = 1;
  std::vector<std::string> seeds;
  ForeignOptions foreign;
};

void show(const LaunchStatus& s) {
  const double rate = s.summary.seconds > 0 ? static_cast<double>(s.summary.executions) / s.summary.seconds : 0;
  fmt::print(stderr, "\r\x1b[K{:.0f} s  {} executions ({:.0f}/s a process)  {} cells  {} signatures  worst S_N {:.3g} ulps", s.running,
             s.summary.executions, rate, s.summary.cells, s.summary.signatures, s.summary.worst_nominal_severity);
  if (!s.last_new.empty()) fmt::print(stderr, "  last new {:.0f} s ago: {}", s.since_last_new, s.last_new);
}

// What was found, the nominal first, the worst first.
std::string report(const CampaignPlan& plan, const Summary& summary, const Options& options) {
  const std::string& folder = options.folder;
  std::vector<Finding> findings;
  Campaign recalled(plan);
  FindingsFolder(folder).recall(input_like(plan), [&](const FuzzInput& input) { recalled.recall(input); });
  for (const auto& [key, finding] : recalled.findings()) findings.push_back(finding);
  std::ranges::sort(findings, [](const Finding& x, const Finding& y) {
    const auto nominal = [](const Finding& f) { return f.signature.conditioning == Conditioning::nominal; };
    const bool nx = nominal(x), ny = nominal(y);
    if (nx != ny) return nx;
    if (x.ulps != y.ulps) return x.ulps > y.ulps;
    return to_word(x.signature) < to_word(y.signature);
  });
  std::string text = fmt::format("{}: {} executions ({:.0f}/s a process), {} cells, {} signatures, worst nominal severity {:.4g} ulps\n",
                                 summary.tracer, summary.executions,
                                 summary.seconds > 0 ? static_cast<double>(summary.executions) / summary.seconds : 0,
                                 summary.cells, summary.signatures, summary.worst_nominal_severity);
  constexpr std::size_t most = 20;
  TextTable table{{{"signature"}, {"severity (ulps)", true}}, {}};
  for (const Finding& f : std::span(findings).first(std::min(most, findings.size())))
    table.rows.push_back({to_word(f.signature), fmt::format("{:.4g}", f.ulps)});
  if (!findings.empty()) text += "\n" + to_terminal(table);
  if (findings.size() > most) text += fmt::format("and {} more\n", findings.size() - most);
  if (!findings.empty())
    text += fmt::format("\nCases: {0}/findings; why: plumbline explain {0}/findings/{1}.case --tracer {2}\n", folder,
                        to_word(findings.front().signature), options.tracer);
  else
    text += "Nothing found.\n" + (summary.least_margin ? fmt::format("Nominal cases as near as {:.4g} ulps to another answer were answered rightly.\n",
                                                                      *summary.least_margin)
                                                        : "");
  return text;
}

std::atomic<bool> stop = false;

void run(const Options& options) {
  const Tracer& tracer = find_tracer(options.tracer, options.foreign);
  const CampaignPlan plan{.tracer = &tracer,
                          .space = *from_name<Space>(space_names, options.space),
                          .domain = *from_name<Domain>(domain_names, options.domain),
                          .seed = options.seed};
  LaunchPlan launched{.program = fuzz_program(),
                      .options = {"--tracer=" + options.tracer, "--space=" + options.space, "--domain=" + options.domain,
                                  fmt::format("--seed={}", options.seed),
                                  fmt::format("--tracer-timeout={}", options.foreign.timeout)},
                      .folder = options.folder,
                      .jobs = options.jobs,
                      .runs = options.runs};
  if (options.seconds) launched.options.push_back(fmt::format("--time={}", *options.seconds));
  for (const std::string& path : options.seeds) launched.options.push_back("--seeds=" + path);
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, [](int) { stop = true; });
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow can't be written
  std::uint64_t executions = 0;  // of earlier calls
  if (!options.store.empty()) {
    FindingStore(options.store, Open::create);  // told now rather than at the end, if it is no good
    launched.options.push_back("--findings=" + options.store);
    if (const auto before = read_summary(std::filesystem::path(options.folder) / "summary.json")) executions = before->executions;
  }
  const bool terminal = isatty(STDERR_FILENO) != 0;
  const Summary summary = launch(launched, stop, terminal ? show : std::function<void(const LaunchStatus&)>());
  if (terminal) fmt::print(stderr, "\r\x1b[K");
  Output output;
  output.write(report(plan, summary, options));
  output.finish();
  if (options.store.empty()) return;
  FindingStore(options.store).tell(SearchRow{
      .tracer = summary.tracer,
      .source = fmt::format("fuzz: space {}, domain {}, seed {}", options.space, options.domain, options.seed),
      .ended = {},
      .executions = summary.executions - std::min(executions, summary.executions),
      .worst_nominal_ulps = summary.worst_nominal_severity,
      .least_margin_ulps = summary.least_margin.value_or(0),
      .signatures = summary.signatures});
}

}  // namespace

void add_fuzz(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("fuzz", "Search for a tracer's worst errors, and keep what is found");
  auto options = std::make_shared<Options>();
  Options& o = *options;
  verb->add_option("--tracer", o.tracer, "Who is searched; see below")->required()->type_name("NAME");
  verb->add_option("--space", o.space,
                   "ray: any triangle and ray. target: a triangle, a target, a tolerance and a standoff, from which the "
                   "report's equations make the ray")
      ->check(CLI::IsMember(std::vector<std::string>(space_names.begin(), space_names.end())))
      ->type_name("SPACE")
      ->capture_default_str();
  verb->add_option("--domain", o.domain,
                   "nominal: no number that over- or underflows, so that all that is found is rounding. full: any finite "
                   "numbers")
      ->check(CLI::IsMember(std::vector<std::string>(domain_names.begin(), domain_names.end())))
      ->type_name("DOMAIN")
      ->capture_default_str();
  CLI::Option* runs = verb->add_option("--runs", o.runs, "Stop after so many executions")->check(whole_number())->type_name("N");
  verb->add_option("--time", o.seconds, "Stop after so many seconds (default: 60, without --runs)")
      ->check(CLI::Range(0.01, 1e9))
      ->type_name("S")
      ->excludes(runs);
  verb->add_option("--jobs", o.jobs, "Processes that search together")
      ->check(CLI::Range(1u, 1024u))
      ->type_name("N")
      ->capture_default_str();
  verb->add_option("--seed", o.seed, "The same seed and --jobs 1: the same search, bit for bit")
      ->check(whole_number())
      ->type_name("K")
      ->capture_default_str();
  verb->add_option("--seeds", o.seeds, "Begin with these cases: .case files and folders")->type_name("PATH");
  verb->add_option("-o,--output", o.folder, "The campaign's folder; one that is there is gone on with")
      ->required()
      ->type_name("DIR");
  add_findings_option(*verb, o.store);
  add_tracer_timeout(*verb, o.foreign);
  verb->footer(
      "Nothing that is found stops the search. In DIR:\n"
      "  findings/         a .case for each signature, the worst so far: for explain, replay, shrink\n"
      "  findings.ndjson   a line for each finding that was new, or twice as severe\n"
      "  elites/           the worst case of each cell of the archive: inputs as plain bytes\n"
      "  summary.json      executions, executions_per_s, first_disagreement (the execution of the first answer with a\n"
      "                    severity above 0), signatures, worst_nominal_severity (in ulps), least_margin (of\n"
      "                    a nominal case answered rightly: how near to another answer, in ulps), cells\n"
      "Ctrl-C ends it, and the same command goes on with it. A process that is killed loses no finding that is new or\n"
      "twice as severe. Severity: how far the ray would have to move for the answer to be true; nominal: neither grazing,\n"
      "nor a sliver, nor far away, each by 2^10 (oracle/README.md).\n\n" +
      std::string(foreign_tracers_help) +
      "\nExamples:\n"
      "  plumbline fuzz --tracer moller_trumbore_f64 --time 10 -o mt\n"
      "  plumbline fuzz --tracer ./libmine.so --runs 1000000 --jobs 2 -o mine\n"
      "  plumbline fuzz --tracer brlcad_bot_classic --space target -o brlcad");
  verb->callback([options] {
    if (!options->runs && !options->seconds) options->seconds = 60;
    run(*options);
  });
}

}  // namespace plumbline
