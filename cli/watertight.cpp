#include "analysis/watertight.h"

#include <fmt/format.h>
#include <unistd.h>

#include <deque>
#include <optional>
#include <thread>

#include "analysis/tracers.h"
#include "analysis/watertight_table.h"
#include "cli/interruption.h"
#include "cli/number_options.h"
#include "cli/output.h"
#include "cli/tracer_options.h"
#include "cli/verb.h"

namespace plumbline {
namespace {

struct Options {
  std::vector<std::string> tracers;
  ForeignOptions foreign;
  std::uint64_t rays = 5000, seed = 1;
  unsigned jobs = std::max(1u, std::thread::hardware_concurrency());
  std::string csv, markdown;
};

void show_progress(std::uint64_t done, std::uint64_t planned) {
  static std::uint64_t shown = 0;  // in thousandths
  const std::uint64_t now = done * 1000 / planned;
  if (now == shown) return;
  shown = now;
  fmt::print(stderr, "\r{:5.1f} % of {} bags", static_cast<double>(now) / 10, planned);
}

void run(const Options& options) {
  const LeakPlan plan{
      .tracers =
          find_tracers(options.tracers.empty() ? std::vector<std::string>{"all"} : options.tracers, options.foreign),
      .rays = options.rays,
      .seed = options.seed,
      .jobs = options.jobs};
  struct File {
    const std::string& path;
    std::string (*render)(const LeakResult&);
  };
  std::vector<File> files;
  if (!options.csv.empty()) files.push_back({options.csv, to_csv});
  if (!options.markdown.empty()) files.push_back({options.markdown, to_markdown});
  std::deque<Output> outputs;  // opened before the work: better told now than in an hour
  for (const File& file : files) outputs.emplace_back(file.path);

  std::optional<Interruption> interruption(std::in_place);
  const bool terminal = isatty(STDERR_FILENO) != 0;
  const LeakResult result = find_leaks(plan, interruption->came(), terminal ? show_progress : LeakProgress());
  interruption.reset();
  if (terminal) fmt::print(stderr, "\r\x1b[K");  // the progress goes, the table comes

  const bool partial = result.done < result.planned;
  if (partial) outputs.clear();
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    outputs[i].write(files[i].render(result));
    outputs[i].flush();
  }
  Output table;  // behind the files: one that can't be written is better told without it
  table.write(to_terminal(result));
  table.finish();
  for (Output& output : outputs) output.finish();
  for (std::size_t i = 0; i < plan.tracers.size(); ++i)
    fmt::print(stderr, "{}", complaints(plan.tracers[i]->info().name, result.conduct[i]));
  if (partial)
    throw std::runtime_error(fmt::format(
        "interrupted after {} of {} bags: this is of these, a share of each column, and no file is written",
        result.done, result.planned));
}

}  // namespace

void add_watertight(CLI::App& app) {
  auto options = std::make_shared<Options>();
  Options& o = *options;
  CLI::App* verb = app.add_subcommand(
      "watertight", "Leaks and double hits at edges and vertices that triangles share, tracer by tracer");
  verb->add_option("--tracer", o.tracers, "Tracer to put to the test; repeatable (default: all of this build)")
      ->type_name("NAME");
  add_tracer_timeout(*verb, o.foreign);
  verb->add_option("--rays", o.rays, "Of each column")->check(whole_number())->type_name("N")->capture_default_str();
  verb->add_option("--seed", o.seed, "Of bags and rays")
      ->check(whole_number())
      ->type_name("N")
      ->capture_default_str();
  verb->add_option("--jobs", o.jobs, "Threads; the counts don't depend on them (default: one per core)")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
  verb->add_option("-o", o.csv, "Write all counts as CSV")->type_name("FILE");
  verb->add_option("--markdown", o.markdown, "Write the tables as Markdown")->type_name("FILE");
  verb->footer(
      "Bags of triangles with an exact truth: pairs that share an edge, fans around a vertex, strips with vertices\n"
      "within an edge, closed spheres; parallel sheets, overlaps in a plane, all pairs of a small lattice. Rays pass\n"
      "through shared edges and vertices exactly, or by an ulp beside them, or graze.\n"
      "Each tracer is asked the bag as a whole and its triangles one by one. A leak: something is crossed, the "
      "answer\n"
      "is a miss. A double hit: besides the triangles crossed, another is hit. Both are counted as if edges were\n"
      "promised to be closed and nothing to be widened; what the tracer's own contract doesn't forbid is left out "
      "of\n"
      "the line below. Binary64 inputs, of full mantissas, are for tracers that read them. apart: rays of which the\n"
      "interface makes other lines for the triangles than for the bag, and which can be judged with the bag alone.\n"
      "Interrupted (Ctrl-C), it prints what is done, writes no file and exits with 2.\n\n" +
      std::string(foreign_tracers_help) +
      "\nExamples:\n"
      "  plumbline watertight --tracer embree_robust --tracer woop_watertight_f32\n"
      "  plumbline watertight --rays 2000 -o leaks.csv");
  verb->callback([options] { run(*options); });
}

}  // namespace plumbline
