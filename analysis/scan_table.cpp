#include "analysis/scan_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "analysis/csv.h"
#include "analysis/text_table.h"

namespace plumbline {
namespace {

std::uint64_t rays(const ScanTally& tally) {
  return std::accumulate(tally.verdicts.begin(), tally.verdicts.end(), std::uint64_t{0});
}

std::string truths(const ScanPlan& plan, const ScanState& state) {
  TextTable table{{{"rays"}, {"hit inside", true}, {"on an edge", true}, {"at a vertex", true}, {"nothing", true}}, {}};
  for (std::size_t set = 0; set < plan.sets.size(); ++set) {
    std::vector<std::string> row = {plan.sets[set].name};
    for (const std::uint64_t n : state.truths[set].nearest) row.push_back(std::to_string(n));
    table.rows.push_back(std::move(row));
  }
  return "What the rays really hit first, exactly:\n" + to_terminal(table);
}

std::string verdicts(const ScanPlan& plan, const ScanResult& result) {
  TextTable table{{{"tracer"},
                   {"rays", true},
                   {"leaks inside", true},
                   {"on an edge", true},
                   {"at a vertex", true},
                   {"through", true},
                   {"beside", true},
                   {"lost by culling", true},
                   {"false hits", true},
                   {"unspecified", true},
                   {"faults", true},
                   {"worst (ulps)", true},
                   {"ns a ray", true},
                   {"exact takes", true}},
                  {}};
  const auto nanoseconds = [&](double seconds) {
    return result.rays == 0 ? 0 : 1e9 * seconds / static_cast<double>(result.rays);
  };
  for (std::size_t t = 0; t < plan.tracers.size(); ++t) {
    ScanTally sum;
    for (std::size_t set = 0; set < plan.sets.size(); ++set) sum += result.state.tallies[set][t];
    const double took = result.times.tracers[t];
    const auto n = [](std::uint64_t count) { return std::to_string(count); };
    const TracerInfo& info = plan.tracers[t]->info();
    const bool timed = info.has_tree && result.rays > 0 && took > 0;  // asked about the whole mesh, as it's meant to be
    table.rows.push_back({info.name, n(rays(sum)), n(sum.leaks[0]), n(sum.leaks[1]), n(sum.leaks[2]), n(sum.through),
                          n(sum[BagVerdict::wrong_nearest] - sum.through), n(sum.culled), n(sum[BagVerdict::false_hit]),
                          n(sum[BagVerdict::unspecified]), n(sum[BagVerdict::fault]),
                          fmt::format("{:.3g}", sum.worst_ulps), timed ? fmt::format("{:.0f}", nanoseconds(took)) : "-",
                          timed ? fmt::format("{:.2f} x", result.times.exact / took) : "-"});
  }
  std::string text = "What the tracers say, judged by their contracts:\n" + to_terminal(table);
  if (result.rays > 0)
    text += fmt::format("\nThe exact nearest hit with its owners: {:.0f} ns a ray, {:.0f} bytes a triangle.\n",
                        nanoseconds(result.times.exact),
                        static_cast<double>(result.bytes) / static_cast<double>(plan.mesh->triangles.size()));
  return text;
}

}  // namespace

std::string to_terminal(const ScanPlan& plan, const ScanResult& result) {
  return truths(plan, result.state) + "\n" + verdicts(plan, result);
}

std::string to_csv(const ScanPlan& plan, const ScanState& state) {
  std::string text = "set,tracer,rays,truth_inside,truth_edge,truth_vertex,truth_nothing";
  for (const std::string_view verdict : bag_verdict_names) text += "," + std::string(verdict);
  text += ",leaks_inside,leaks_edge,leaks_vertex,through,lost_by_culling,worst_ulps\n";
  for (std::size_t set = 0; set < plan.sets.size(); ++set) {
    for (std::size_t t = 0; t < plan.tracers.size(); ++t) {
      const ScanTally& tally = state.tallies[set][t];
      text +=
          fmt::format("{},{},{}", csv_field(plan.sets[set].name), csv_field(plan.tracers[t]->info().name), rays(tally));
      for (const std::uint64_t n : state.truths[set].nearest) text += fmt::format(",{}", n);
      for (const std::uint64_t n : tally.verdicts) text += fmt::format(",{}", n);
      for (const std::uint64_t n : tally.leaks) text += fmt::format(",{}", n);
      text += fmt::format(",{},{},{}\n", tally.through, tally.culled, tally.worst_ulps);
    }
  }
  return text;
}

}  // namespace plumbline
