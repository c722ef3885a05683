#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <thread>

#include "analysis/self_hits_table.h"
#include "analysis/tracers.h"
#include "cli/long_run.h"
#include "cli/number_options.h"
#include "cli/tracer_options.h"
#include "cli/verb.h"

namespace plumbline {
namespace {

struct Options {
  std::vector<std::string> tracers = {"all"}, families;
  std::string file;
  std::uint64_t rays = 500, seed = 1;
  unsigned jobs = std::max(1u, std::thread::hardware_concurrency());
  ForeignOptions foreign;
};

std::vector<std::string> all_families() {
  std::vector<std::string> names;
  for (const SelfHitFamily& family : self_hit_families) names.emplace_back(family.name);
  return names;
}

SelfHitPlan plan_of(const Options& options) {
  SelfHitPlan plan{.tracers = find_tracers(options.tracers, options.foreign),
                   .families = {},
                   .rays = options.rays,
                   .seed = options.seed,
                   .jobs = options.jobs};
  for (const SelfHitFamily& family : self_hit_families)
    if (options.families.empty() || std::ranges::count(options.families, family.name) > 0)
      plan.families.push_back(family);
  return plan;
}

void show_progress(std::uint64_t done, std::uint64_t planned) {
  fmt::print(stderr, "\r{} of {} tables", done, planned);
}

void run(const Options& options) {
  const SelfHitPlan plan = plan_of(options);
  std::vector<ResultFile<SelfHitResult>> wanted;
  if (!options.file.empty()) wanted.push_back({options.file, self_hits_csv});
  ResultFiles<SelfHitResult> files(std::move(wanted));
  const SelfHitResult result = run_long(
      show_progress, [&](const auto& stop, const auto& progress) { return measure_self_hits(plan, stop, progress); });
  files.finish(result, to_terminal(result));
  complain(plan.tracers, result.conduct);
  if (const std::uint64_t planned = plan.tracers.size() * plan.families.size(); result.done < planned)
    throw std::runtime_error(fmt::format(
        "interrupted after {} of {} pairs of tracer and family: what is written is of these", result.done, planned));
}

std::string families_help() {
  std::string text;
  for (const SelfHitFamily& f : self_hit_families) text += fmt::format("  {:<9}{}\n", f.name, f.meaning);
  return text;
}

}  // namespace

void add_self_hits(CLI::App& app) {
  auto options = std::make_shared<Options>();
  Options& o = *options;
  CLI::App* verb = app.add_subcommand(
      "self-hits", "Rays that leave a hit: how often they hit their own triangle again, and what prevents it");
  verb->add_option("--tracer", o.tracers, "Who is measured; repeatable (default: all)")
      ->type_name("NAME")
      ->expected(1)
      ->take_all();
  verb->add_option("--family", o.families, "Kind of hits; repeatable (default: all)")
      ->check(CLI::IsMember(all_families()))
      ->type_name("NAME");
  verb->add_option("--rays", o.rays, "First rays of each family; four leave each point of their hits")
      ->check(whole_number())
      ->type_name("N")
      ->capture_default_str();
  verb->add_option("--seed", o.seed, "Of all rays")->check(whole_number())->type_name("N")->capture_default_str();
  verb->add_option("--jobs", o.jobs, "Threads (default: as many as there are); the result doesn't depend on them")
      ->check(CLI::Range(1u, 1024u))
      ->type_name("N");
  verb->add_option("-o,--output", o.file, "Write all figures as CSV, also medians and worst")->type_name("FILE.csv");
  add_tracer_timeout(*verb, o.foreign);
  verb->footer(
      "From where rays leave (point): t, origin + t * direction; uv, a + u (b - a) + v (c - a), both with the\n"
      "tracer's numbers and rounded at its precision; rounded, the exact point, rounded once. Then:\n"
      "  behind %      of the leaving rays, those that meet the triangle again in truth: their start lies behind it\n"
      "  on %          those that start in the plane exactly\n"
      "  false %       of the rest, those that the tracer says hit: its own fault\n"
      "  behind hit %  of those behind, how many it says hit; on hit % likewise\n"
      "Then how many ulps of the hit point's largest coordinate the origin has to move along the normal, and how\n"
      "many ulps of the first ray's t t_min has to be, so that 99 % of the rays don't hit: the tracer's figure/what\n"
      "exact arithmetic needs. The difference is the tracer's. Leaving: steep, uniform over the sphere; grazing, at\n"
      "about 2^-10. t_min is asked of tracers that read it.\n"
      "Families:\n" +
      families_help() + '\n' + std::string(foreign_tracers_help) +
      "\nExamples:\n"
      "  plumbline self-hits --tracer embree_default --tracer embree_robust --tracer exact\n"
      "  plumbline self-hits -o self_hits.csv");
  verb->callback([options] { run(*options); });
}

}  // namespace plumbline
