#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <deque>
#include <filesystem>
#include <thread>

#include "analysis/bench/machine.h"
#include "analysis/bench/tracer_speed.h"
#include "analysis/csv.h"
#include "analysis/stability_table.h"
#include "analysis/tracers.h"
#include "case/enum_names.h"
#include "case/folder.h"
#include "case/input_error.h"
#include "case/json_object.h"
#include "cli/number_options.h"
#include "cli/output.h"
#include "cli/tracer_options.h"
#include "cli/verb.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> tracers, dials;
  std::string directory;
  std::optional<std::uint64_t> cases;
  std::uint64_t seed = 1;
  unsigned jobs = std::max(1u, std::thread::hardware_concurrency());
  bool quick = false;
  ForeignOptions foreign;
};

std::atomic<bool> interrupted = false;

std::vector<const Tracer*> tracers_of(const Options& options) {
  std::vector<std::string> names = options.tracers;
  if (names.empty()) names = {"all"};
  return find_tracers(names, options.foreign);
}

StabilityPlan stability_plan(const Options& options, const std::vector<const Tracer*>& tracers) {
  if (options.cases == 0) throw InputError("--cases 0: no case to measure on; give a count of 1 or more");
  StabilityPlan plan{.subjects = subjects_of(tracers),
                     .dials = {},
                     .cases = options.cases.value_or(options.quick ? 100 : 1000),
                     .seed = options.seed,
                     .jobs = options.jobs};
  for (const std::string& dial : options.dials) plan.dials.push_back(*from_name<Dial>(dial_names, dial));
  if (options.dials.empty())
    for (std::size_t i = 0; i < dial_names.size(); ++i) plan.dials.push_back(static_cast<Dial>(i));
  return plan;
}

SpeedPlan speed_plan(const Options& options, const std::vector<const Tracer*>& tracers) {
  SpeedPlan plan{.tracers = tracers, .seed = options.seed};
  if (options.quick) plan.rounds = 3, plan.slice_seconds = 2e-4, plan.memory_rays = 50'000;
  return plan;
}

std::string command_of(const Options& options) {
  std::string command = fmt::format("plumbline bench tracers --seed {}", options.seed);
  if (options.quick) command += " --quick";
  if (options.cases) command += fmt::format(" --cases {}", *options.cases);
  for (const std::string& tracer : options.tracers) command += " --tracer " + tracer;
  for (const std::string& dial : options.dials) command += " --dial " + dial;
  return command;
}

std::string speed_csv(const std::vector<const Tracer*>& tracers, const Speeds& speeds) {
  std::string out = "tracer,way,ns,ratio,clock\n";
  for (std::size_t i = 0; i < tracers.size(); ++i)
    for (std::size_t way = 0; way < shooting_names.size(); ++way)
      out += fmt::format("{},{},{:.4g},{:.4g},{}\n", csv_field(tracers[i]->info().name), shooting_names[way],
                         speeds[i][way].ns, speeds[i][way].ratio,
                         tracers[i]->info().isolation == Isolation::process ? "wall" : "processor");
  return out;
}

std::string tracers_csv(const std::vector<const Tracer*>& tracers) {
  std::string out = "tracer,precision,package,summary\n";
  for (const Tracer* tracer : tracers) {
    const TracerInfo& info = tracer->info();
    out += fmt::format("{},{},{},{}\n", csv_field(info.name), name(info.contract.precision), csv_field(info.package),
                       csv_field(info.summary));
  }
  return out;
}

std::string run_json(const Options& options, const StabilityPlan& plan, const SpeedPlan& speed) {
  std::string out;
  JsonObject json(out);
  json.text("command", command_of(options));
  json.text("version", PLUMBLINE_VERSION);
  json.text("machine", fmt::format("{}, {} threads", processor(), std::thread::hardware_concurrency()));
  json.text("compiler", compiler());
  json.number("seed", static_cast<double>(plan.seed));
  json.number("cases", static_cast<double>(plan.cases));
  json.number("stable_bound", stable_bound);
  json.number("rounds", static_cast<double>(speed.rounds));
  json.number("slice_seconds", speed.slice_seconds);
  json.number("memory_rays", static_cast<double>(speed.memory_rays));
  JsonObject dials(json.member("dials"));
  for (const Dial dial : plan.dials) dials.text(name(dial), meaning(dial));
  dials.end();
  json.end_line();
  return out;
}

void show_stability(std::uint64_t done, std::uint64_t planned) {
  fmt::print(stderr, "\r\x1b[Kstability: {} of {} settings", done, planned);
}
void show_speed(Shooting way) { fmt::print(stderr, "\r\x1b[Kspeed: {}", name(way)); }

// The script is beside the program where it is installed, else where it was built from.
fs::path report_script() {
  const fs::path here = fs::read_symlink("/proc/self/exe").parent_path();
  const fs::path installed = here / ".." / "share" / "plumbline" / "plots" / "tracers_report.py";
  return fs::exists(installed) ? installed : fs::path(PLUMBLINE_PLOTS) / "tracers_report.py";
}

void draw_report(const std::string& directory) {
  const fs::path script = report_script();
  const pid_t child = fork();
  if (child == 0) {
    execl("/usr/bin/python3", "python3", "-B", script.c_str(), directory.c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  int status = 0;
  if (child < 0 || waitpid(child, &status, 0) != child || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw std::runtime_error(fmt::format(
        "{}: the page couldn't be drawn; the CSV files are whole. It needs python3-matplotlib; draw it again by\n"
        "  /usr/bin/python3 {} {}",
        directory, script.string(), directory));
}

void run(const Options& options) {
  const auto tracers = tracers_of(options);
  const StabilityPlan stability = stability_plan(options, tracers);
  const SpeedPlan speed = speed_plan(options, tracers);
  make_folder(options.directory);
  const std::array names = {"/cells.csv",      "/verdicts.csv", "/symmetries.csv", "/builds.csv",
                            "/conditions.csv", "/speed.csv",    "/tracers.csv",    "/run.json"};
  std::deque<Output> files;  // opened before the work: better told now than in ten minutes
  for (const char* file : names) files.emplace_back(options.directory + file);
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, [](int) { interrupted = true; });
  const bool terminal = isatty(STDERR_FILENO) != 0;
  // First, while nothing else runs.
  const Speeds speeds = tracer_speeds(speed, interrupted, terminal ? show_speed : SpeedProgress());
  const StabilityResult result =
      measure_stability(stability, interrupted, terminal ? show_stability : StabilityProgress());
  if (terminal) fmt::print(stderr, "\r\x1b[K");
  const std::array texts = {
      cells_csv(result),      verdicts_csv(result),       symmetries_csv(result), builds_csv(result),
      conditions_csv(result), speed_csv(tracers, speeds), tracers_csv(tracers),   run_json(options, stability, speed)};
  for (std::size_t i = 0; i < files.size(); ++i) {
    files[i].write(texts[i]);
    files[i].finish();
  }
  for (std::size_t i = 0; i < stability.subjects.size(); ++i)
    fmt::print(stderr, "{}", complaints(stability.subjects[i].tracer->info().name, result.conduct[i]));
  draw_report(options.directory);
  Output output;
  output.write(to_terminal(result));
  output.write(fmt::format("\n{}/index.html\n", options.directory));
  output.finish();
}

}  // namespace

void add_bench_tracers(CLI::App& bench) {
  auto options = std::make_shared<Options>();
  Options& o = *options;
  CLI::App* verb =
      bench.add_subcommand("tracers", "Speed against error, and numerical stability on hard cases: a page");
  verb->add_option("--tracer", o.tracers, "Who is measured; repeatable (default: all)")
      ->type_name("NAME")
      ->expected(1)
      ->take_all();
  verb->add_option("--dial", o.dials, "Family; repeatable (default: all)")
      ->check(CLI::IsMember(std::vector<std::string>(dial_names.begin(), dial_names.end())))
      ->type_name("NAME");
  verb->add_option("--cases", o.cases, "At each setting of each dial (default: 1000; 100 with --quick)")
      ->check(whole_number())
      ->type_name("N");
  verb->add_option("--seed", o.seed, "Of cases and rays")->check(whole_number())->type_name("N")->capture_default_str();
  verb->add_option("--jobs", o.jobs, "Threads that measure errors (default: as many as there are); speed takes one")
      ->check(CLI::Range(1u, 1024u))
      ->type_name("N");
  verb->add_flag("--quick", o.quick, "Few cases, short repetitions");
  verb->add_option("-o,--output", o.directory, "Folder for the page, its figures and tables")
      ->required()
      ->type_name("DIR");
  add_tracer_timeout(*verb, o.foreign);
  verb->footer(
      "In DIR: index.html, the page; figures as PNG and SVG; what they are drawn from as CSV; run.json, how it was "
      "made.\n"
      "Families have a dial each, from easy to as hard as the precision holds (case/dials.h).\n"
      "Errors are measured exactly and split into what the problem does (sensitivity) and what the algorithm does\n"
      "(backward error, in unit roundoffs). Printed: at which setting each tracer's backward error leaves " +
      fmt::format("{:g}", stable_bound) +
      "\nunit roundoffs, '.' where it never does. Counts and errors are the same in every run; times aren't.\n\n" +
      std::string(foreign_tracers_help) +
      "\nExample:\n"
      "  plumbline bench tracers --quick -o results/tracers");
  verb->callback([options] { run(*options); });
}

}  // namespace plumbline
