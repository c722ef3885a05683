// The one place where errors become an exit code and a line on stderr.
#include <fmt/format.h>

#include <csignal>
#include <cstdio>
#include <new>

#include "case/nearest_name.h"
#include "cli/output.h"
#include "cli/verb.h"

namespace {

constexpr int agree = 0, disagree = 1, trouble = 2;

int report(std::string_view message) {
  std::fputs(fmt::format("plumbline: {}\n", message).c_str(), stderr);  // which may be closed: no place to say so
  return trouble;
}

std::string unknown_verb(const CLI::App& app, const std::string& word) {
  std::vector<std::string> verbs;
  for (const CLI::App* verb : app.get_subcommands({})) verbs.push_back(verb->get_name());
  const std::vector<std::string_view> names(verbs.begin(), verbs.end());
  return fmt::format("unknown verb '{}'; {}", word, plumbline::suggest(word, names));
}

int run(int argc, char** argv) {
  CLI::App app("An exact reference oracle for ray/triangle intersection.", "plumbline");
  app.set_version_flag("--version", "plumbline " PLUMBLINE_VERSION);
  app.require_subcommand(1);

  bool disagreement = false;
  plumbline::add_sweep(app);
  plumbline::add_scan(app);
  plumbline::add_compare(app);
  plumbline::add_watertight(app);
  plumbline::add_fuzz(app);
  plumbline::add_shrink(app);
  plumbline::add_triage(app);
  plumbline::add_promote(app);
  plumbline::add_lattice(app);
  plumbline::add_mesh(app);
  plumbline::add_generate(app);
  plumbline::add_convert(app);
  plumbline::add_classify(app);
  plumbline::add_trace(app);
  plumbline::add_judge(app, disagreement);
  plumbline::add_replay(app, disagreement);
  plumbline::add_explain(app);
  plumbline::add_export(app);
  plumbline::add_tracers(app);
  plumbline::add_self_hits(app);
  plumbline::add_bench(app);
  app.footer(
      "Exit codes: judge and replay: 0 agree, 1 disagreement found, 2 trouble; all other verbs: 0 or 2.\n"
      "Data goes to standard output, everything for people to standard error.\n"
      "'plumbline VERB --help' tells what a verb reads and writes, with an example.");

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& request) {  // --help, --version
    std::ostringstream text;
    app.exit(request, text, text);
    plumbline::Output output;
    output.write(text.str());
    output.finish();
  } catch (const CLI::ParseError& error) {
    const auto verbs = app.get_subcommands();
    const auto rest = app.remaining();
    if (verbs.empty() && !rest.empty() && !rest.front().starts_with('-'))
      return report(unknown_verb(app, rest.front()));
    return report(fmt::format("{}; see 'plumbline {}--help'", error.what(),
                              verbs.empty() ? "" : verbs.front()->get_name() + " "));
  }
  return disagreement ? disagree : agree;
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGPIPE, SIG_IGN);  // a closed pipe is a write error like any other
  try {
    return run(argc, argv);
  } catch (const std::bad_alloc&) {
    return report("out of memory");
  } catch (const std::exception& error) {
    return report(error.what());
  }
}
