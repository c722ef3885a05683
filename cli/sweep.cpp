#include "analysis/sweep.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <thread>

#include "analysis/sweep_table.h"
#include "analysis/tracers.h"
#include "case/enum_names.h"
#include "case/input_error.h"
#include "cli/findings_option.h"
#include "cli/lattice_options.h"
#include "cli/long_run.h"
#include "cli/tracer_options.h"
#include "cli/verb.h"
#include "findings/collector.h"
#include "findings/found.h"
#include "findings/store.h"

namespace plumbline {
namespace {

struct SweepOptions {
  LatticeOptions lattice;
  std::vector<std::string> tolerances = {"0.1", "0.001", "0.00001"}, standoffs = {"5"};
  std::string normal = "divide", mode = "plate", thickness = "0.1";
  std::vector<std::string> tracers;
  ForeignOptions foreign;
  unsigned jobs = std::max(1u, std::thread::hardware_concurrency());
  bool json = false;
  std::string csv, markdown, directory, store;
};

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
  plan.tracers = find_tracers(options.tracers, options.foreign);
  plan.triples = triple_range(plan.lattices.front(), options.lattice.first, options.lattice.count);
  plan.jobs = options.jobs;
  return plan;
}

using File = ResultFile<SweepResult>;

std::vector<File> files_of(const SweepOptions& options) {
  std::vector<File> files;
  if (!options.csv.empty()) files.push_back({options.csv, to_csv});
  if (!options.markdown.empty()) files.push_back({options.markdown, to_markdown});
  if (!options.directory.empty()) {
    files.push_back({options.directory + "/table.md", to_markdown});
    files.push_back({options.directory + "/sweep.csv", to_csv});
    files.push_back({options.directory + "/sweep.json", to_json_lines});
  }
  return files;
}

// What can't be told is told where the file is opened.
std::filesystem::path place_of(const std::filesystem::path& path) {
  if (path == "-") return path;
  std::error_code error;
  const auto place = std::filesystem::weakly_canonical(std::filesystem::absolute(path), error);
  return error ? path : place;
}

void check_distinct(const std::vector<File>& files) {
  std::map<std::filesystem::path, std::string> seen = {{"-", "the table"}};
  for (const File& file : files) {
    const auto [it, is_new] = seen.emplace(place_of(file.path), file.path);
    if (!is_new) throw InputError(fmt::format("{}: goes where {} goes; name another file", file.path, it->second));
  }
}

void make_directory(const std::string& directory) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error)
    throw InputError(fmt::format("{}: cannot be made a folder: {}; write elsewhere", directory, error.message()));
}

// What a sweep has wrong, for a store of findings.
class Feed {
 public:
  explicit Feed(const std::string& store) : collector_((FindingStore(store, Open::create), store), "sweep") {}

  void add(const WrongAnswer& wrong) {
    const std::lock_guard lock(mutex_);
    const auto found = finding_in_answer(wrong.tracer.info(), &wrong.tracer, wrong.what, wrong.asked, wrong.answer, "sweep");
    if (found) collector_.add(*found);
  }

  void finish(const SweepResult& result) {
    for (const SweepRow& row : result.rows) collector_.count(row.tracer->info().name, row.tally.attempts);
    collector_.finish();
  }

 private:
  std::mutex mutex_;
  Collector collector_;
};

void run_sweep(const SweepOptions& options) {
  SweepPlan plan = plan_of(options);
  check(plan);
  std::optional<Feed> feed;
  if (!options.store.empty()) {
    feed.emplace(options.store);
    plan.on_wrong = [&feed](const WrongAnswer& wrong) { feed->add(wrong); };
  }
  std::vector<File> wanted = files_of(options);
  check_distinct(wanted);
  if (!options.directory.empty()) make_directory(options.directory);
  ResultFiles<SweepResult> files(std::move(wanted));
  const SweepResult result =
      run_long(show_progress, [&](const auto& stop, const auto& progress) { return sweep(plan, stop, progress); });
  const bool partial = result.done.end != plan.triples.end;
  const std::string text = options.json ? to_json_lines(result) : to_terminal(result);
  if (partial)
    files.give_up(text);
  else
    files.finish(result, text);
  complain(plan.tracers, result.conduct);
  if (feed) feed->finish(result);
  if (partial)
    throw std::runtime_error(
        fmt::format("interrupted: this is of the triples [{}, {}) only, and no file is written; take it "
                    "up with --first {} --count {}",
                    result.done.first, result.done.end, result.done.end, plan.triples.end - result.done.end));
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
                   "Tracer to put to the test, or 'all'; repeatable (default: textbook kernels, BRL-CAD's rules, Embree, exact)")
      ->type_name("NAME")
      ->group("Tracers");
  add_tracer_timeout(*verb, o.foreign);
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
  add_findings_option(*verb, o.store);
  verb->add_option("-o", o.directory, "Write table.md, sweep.csv and sweep.json (one object a line)")->type_name("DIR");
  verb->footer(
      "Without options: the report's own experiment, 336 triangles and 21504 rays.\n"
      "Interrupted (Ctrl-C), it prints what is done, writes no file, exits with 2, and says where to take it up.\n\n" +
      std::string(foreign_tracers_help) +
      "\nExamples:\n"
      "  plumbline sweep --tracer exact --tracer brlcad_bot_classic\n"
      "  plumbline sweep --tracer ./libmine.so --tracer exact\n"
      "  plumbline sweep --standoff 0.25 --standoff 5 --standoff 10000 --offset 0 0 0 --offset 0.25 0.25 0.25\n"
      "  plumbline sweep --box 2 2 2 --step 0.05 --first 4000000 --count 100000 --json > part.json");
  verb->callback([options] { run_sweep(*options); });
}

}  // namespace plumbline
