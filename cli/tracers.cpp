#include "analysis/tracers.h"

#include <fmt/format.h>

#include <string>

#include "analysis/text_table.h"
#include "case/json_object.h"
#include "cli/output.h"
#include "cli/verb.h"
#include "float_tracer/adapters/adapter_list.h"

namespace plumbline {
namespace {

constexpr std::string_view absent = "absent: cmake/install-dependencies tracers";

// Calls it with the name and the package of each tracer whose library this build didn't find.
template <class Use>
void for_each_absent(Use use) {
  for (const Adapter& adapter : adapters())
    if (!adapter.make)
      for (const std::string_view tracer : adapter.tracers) use(tracer, adapter.package);
}

std::string_view runs(const TracerInfo& info) {
  return info.isolation == Isolation::process ? "child" : "in-process";
}

std::string table() {
  TextTable all{.columns = {{"tracer"},
                            {"precision"},
                            {"edges"},
                            {"t range"},
                            {"asks"},
                            {"runs"},
                            {"package"},
                            {"what it is"},
                            {"source"}},
                .rows = {}};
  for (const auto& tracer : all_tracers()) {
    const TracerInfo& info = tracer->info();
    const Contract& c = info.contract;
    all.rows.push_back({info.name, std::string(name(c.precision)), std::string(name(c.edges)),
                        std::string(name(c.range)), info.own_queries ? "its own" : "the ray", std::string(runs(info)),
                        info.package, info.summary, info.source});
  }
  for_each_absent([&](std::string_view tracer, std::string_view package) {
    all.rows.push_back({std::string(tracer), "", "", "", "", "", std::string(package), std::string(absent), ""});
  });
  return to_terminal(all);
}

std::string json_lines() {
  std::string out;
  for (const auto& tracer : all_tracers()) {
    const TracerInfo& info = tracer->info();
    const Contract& c = info.contract;
    JsonObject object(out);
    object.text("tracer", info.name);
    object.boolean("present", true);
    object.text("summary", info.summary);
    object.text("source", info.source);
    object.text("package", info.package.empty() ? std::nullopt : std::optional<std::string_view>(info.package));
    object.text("isolation", runs(info));
    object.boolean("own_queries", info.own_queries);
    object.text("precision", name(c.precision));
    object.text("edges", name(c.edges));
    object.text("range", name(c.range));
    object.text("t_min", name(c.t_min));
    object.text("t_max", name(c.t_max));
    object.text("coplanar", name(c.coplanar));
    object.text("degenerate", name(c.degenerate));
    object.text("culling", name(c.culling));
    object.number("slack_absolute", c.slack_absolute);
    object.number("slack_relative", c.slack_relative);
    object.end_line();
  }
  for_each_absent([&](std::string_view tracer, std::string_view package) {
    JsonObject object(out);
    object.text("tracer", tracer);
    object.boolean("present", false);
    object.text("summary", absent);
    object.text("package", package);
    object.end_line();
  });
  return out;
}

}  // namespace

void add_tracers(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("tracers", "Every tracer of this build, and what it promises");
  auto json = std::make_shared<bool>(false);
  verb->add_flag("--json", *json, "Print JSON, one object a line, with the whole contract");
  verb->footer(
      "precision: the numbers it reads. edges: closed (edges and vertices must be hit), open (must be missed), "
      "one_owner\n"
      "(one of the triangles that share them is hit), unspecified. t range: given (it reads t_min and t_max), ray "
      "(it\n"
      "searches [0, inf)), line (all t). asks: the ray, or its own (its interface can't hold the ray; what it is "
      "really\n"
      "asked is judged). runs: in-process, or in a child (it may abort or hang; the rays that it dies of are "
      "faults).\n"
      "package: where the code under test comes from, with its version; empty: written here.\n"
      "Tracers whose library this build didn't find come last, with what to install; then build again.\n\n"
      "JSON: tracer, present, summary, source, package (or null), isolation (in-process or child), own_queries, and "
      "the\n"
      "contract: precision, edges, range, t_min, t_max, coplanar, degenerate, culling, slack_absolute, "
      "slack_relative.\n"
      "Absent ones (present: false) have tracer, present, summary and package only.\n"
      "\nExample:\n"
      "  plumbline tracers");
  verb->callback([json] {
    Output output;
    output.write(*json ? json_lines() : table());
    output.finish();
  });
}

}  // namespace plumbline
