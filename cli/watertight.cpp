#include "analysis/watertight.h"

#include <fmt/format.h>

#include <thread>

#include "analysis/tracers.h"
#include "analysis/watertight_table.h"
#include "cli/long_run.h"
#include "cli/number_options.h"
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
  std::vector<ResultFile<LeakResult>> wanted;
  if (!options.csv.empty()) wanted.push_back({options.csv, to_csv});
  if (!options.markdown.empty()) wanted.push_back({options.markdown, to_markdown});
  ResultFiles<LeakResult> files(std::move(wanted));
  const LeakResult result = run_long(
      show_progress, [&](const auto& stop, const auto& progress) { return find_leaks(plan, stop, progress); });
  const bool partial = result.done < result.planned;
  if (partial)
    files.give_up(to_terminal(result));
  else
    files.finish(result, to_terminal(result));
  complain(plan.tracers, result.conduct);
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
