#include "analysis/sweep.h"

#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <deque>
#include <filesystem>
#include <thread>

#include "analysis/sweep_table.h"
#include "analysis/tracers.h"
#include "case/enum_names.h"
#include "case/input_error.h"
#include "cli/lattice_options.h"
#include "cli/output.h"
#include "cli/verb.h"

namespace plumbline {
namespace {

struct SweepOptions {
  LatticeOptions lattice;
  std::vector<std::string> tolerances = {"0.1", "0.001", "0.00001"}, standoffs = {"5"};
  std::string normal = "divide", mode = "plate", thickness = "0.1";
  std::vector<std::string> tracers;
  unsigned jobs = std::max(1u, std::thread::hardware_concurrency());
  bool json = false;
  std::string csv, markdown, directory;
};

std::atomic<bool> interrupted = false;

void interrupt(int) {
  interrupted = true;
  std::signal(SIGINT, SIG_DFL);  // the second time it is meant
}

void show_progress(std::uint64_t done, std::uint64_t planned) {
  static std::uint64_t shown = 0;  // in thousandths
  const std::uint64_t now = done * 1000 / planned;
  if (now == shown) return;
  shown = now;
  fmt::print(stderr, "\r{:5.1f} % of {} triples", static_cast<double>(now) / 10, planned);
}

std::vector<double> reals(const std::vector<std::string>& texts, std::string_view what) {
  std::vector<double> values;
  for (const std::string& text : texts) values.push_back(to_double(parse_decimal(text, what)));
  return values;
}

SweepPlan plan_of(const SweepOptions& options) {
  SweepPlan plan;
  plan.lattices = lattices(options.lattice);
  plan.standoffs = reals(options.standoffs, "--standoff");
  plan.tolerances = reals(options.tolerances, "--tolerance");
  plan.normal = *from_name<Normal>(normal_names, options.normal);
  plan.object.mode = *from_name<BagMode>(bag_mode_names, options.mode);
  plan.object.thickness = to_double(parse_decimal(options.thickness, "--thickness"));
  for (const std::string& name : options.tracers) plan.tracers.push_back(&find_tracer(name));
  if (options.tracers.empty())
    for (const auto& tracer : all_tracers()) plan.tracers.push_back(tracer.get());
  plan.triples = triple_range(plan.lattices.front(), options.lattice.first, options.lattice.count);
  plan.jobs = options.jobs;
  return plan;
}

using Render = std::string (*)(const SweepResult&);

struct Destination {
  std::string path;
  Render render;
};

// Standard output comes first.
std::vector<Destination> destinations_of(const SweepOptions& options) {
  std::vector<Destination> list = {{"-", options.json ? to_json_lines : Render(to_terminal)}};
  if (!options.csv.empty()) list.push_back({options.csv, to_csv});
  if (!options.markdown.empty()) list.push_back({options.markdown, to_markdown});
  if (!options.directory.empty()) {
    std::filesystem::create_directories(options.directory);
    list.push_back({options.directory + "/table.md", to_markdown});
    list.push_back({options.directory + "/sweep.csv", to_csv});
    list.push_back({options.directory + "/sweep.json", to_json_lines});
  }
  return list;
}

void run_sweep(const SweepOptions& options) {
  const SweepPlan plan = plan_of(options);
  check(plan);
  const auto destinations = destinations_of(options);
  std::deque<Output> outputs;  // opened before the work: better told now than in an hour
  for (const Destination& destination : destinations) outputs.emplace_back(destination.path);

  std::signal(SIGINT, interrupt);
  const bool terminal = isatty(STDERR_FILENO) != 0;
  const SweepResult result = sweep(plan, interrupted, terminal ? show_progress : SweepProgress());
  std::signal(SIGINT, SIG_DFL);
  if (terminal) fmt::print(stderr, "\r\x1b[K");  // the progress goes, the table comes

  const bool partial = result.done.end != plan.triples.end;
  if (partial) outputs.resize(1);
  for (std::size_t i = 0; i < outputs.size(); ++i) outputs[i].write(destinations[i].render(result));
  for (Output& output : outputs) output.flush();
  for (Output& output : outputs) output.finish();
  if (partial)
    throw std::runtime_error(
        fmt::format("interrupted: this is of the triples {} to {} only, and no file is written; take it "
                    "up with --first {}",
                    result.done.first, result.done.end, result.done.end));
}

}  // namespace

void add_sweep(CLI::App& app) {
  auto options = std::make_shared<SweepOptions>();
  SweepOptions& o = *options;
  CLI::App* verb =
      app.add_subcommand("sweep", "The experiment of ARL-CR-0761, refereed: tracers against lattice triangles");
  add_lattice_options(*verb, o.lattice);
  verb->add_option("--tolerance", o.tolerances, "Distance of targets from edges and vertices; repeatable")
      ->type_name("N")
      ->capture_default_str()
      ->group("Rays");
  verb->add_option("--standoff", o.standoffs, "Distance h of the firing point; repeat it for the range over h")
      ->type_name("H")
      ->capture_default_str()
      ->group("Rays");
  verb->add_option("--normal", o.normal, "Direction: AB x AC divided by its length, times 1/length, or as it is")
      ->check(CLI::IsMember(std::vector<std::string>(normal_names.begin(), normal_names.end())))
      ->type_name("NORMAL")
      ->capture_default_str()
      ->group("Rays");
  verb->add_option("--tracer", o.tracers,
                   "Tracer to put to the test; repeatable (default: all, see 'plumbline tracers')")
      ->type_name("NAME")
      ->group("Tracers");
  verb->add_option("--mode", o.mode, "What a triangle is")
      ->check(CLI::IsMember(std::vector<std::string>(bag_mode_names.begin(), bag_mode_names.end())))
      ->type_name("MODE")
      ->capture_default_str()
      ->group("Tracers");
  verb->add_option("--thickness", o.thickness, "Of a plate")->type_name("N")->capture_default_str()->group("Tracers");
  verb->add_option("--jobs", o.jobs, "Threads; the result doesn't depend on them (default: one per core)")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
  verb->add_flag("--json", o.json, "Print JSON, one object a line for each tracer, target and tolerance");
  verb->add_option("--csv", o.csv, "Write the same as CSV")->type_name("FILE");
  verb->add_option("--markdown", o.markdown, "Write the table as Markdown")->type_name("FILE");
  verb->add_option("-o", o.directory, "Write table.md, sweep.csv and sweep.json (one object a line)")->type_name("DIR");
  verb->footer(
      "Without options: the report's own experiment, 336 triangles and 21504 rays.\n"
      "Interrupted (Ctrl-C), it prints what is done, writes no file, exits with 2, and says where to take it up.\n\n"
      "  plumbline sweep --tracer exact --tracer brlcad_bot_classic\n"
      "  plumbline sweep --standoff 0.25 --standoff 5 --standoff 10000 --offset 0 0 0 --offset 0.25 0.25 0.25\n"
      "  plumbline sweep --box 2 2 2 --step 0.05 --first 4000000 --count 100000 --json > part.json");
  verb->callback([options] { run_sweep(*options); });
}

}  // namespace plumbline
