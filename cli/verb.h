// The verbs of the command line. Each add_VERB declares its subcommand and options, and the callback that does the
// work when the command line is parsed: it parses, calls, prints.
//
// Exit codes: a callback that returns is 0, one that throws (InputError, or any other std::exception) is 2 with the
// message as one line on stderr. Only judge and replay know a third: they set `disagreement`, which is 1.
#pragma once
#include <CLI/CLI.hpp>

namespace plumbline {

void add_sweep(CLI::App& app);
void add_lattice(CLI::App& app);
void add_mesh(CLI::App& app);
void add_scan(CLI::App& app);
void add_compare(CLI::App& app);
void add_watertight(CLI::App& app);
void add_classify(CLI::App& app);
void add_convert(CLI::App& app);
void add_generate(CLI::App& app);
void add_trace(CLI::App& app);
void add_judge(CLI::App& app, bool& disagreement);
void add_replay(CLI::App& app, bool& disagreement);
void add_explain(CLI::App& app);
void add_export(CLI::App& app);
void add_tracers(CLI::App& app);
void add_self_hits(CLI::App& app);
void add_bench(CLI::App& app);
void add_bench_tracers(CLI::App& bench);
void add_fuzz(CLI::App& app);
void add_shrink(CLI::App& app);
void add_triage(CLI::App& app);
void add_promote(CLI::App& app);

}  // namespace plumbline
