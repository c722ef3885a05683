#include "analysis/tracers.h"

#include <fmt/format.h>

#include <optional>
#include <string>

#include "analysis/text_table.h"
#include "case/json_object.h"
#include "cli/output.h"
#include "cli/verb.h"

namespace plumbline {
namespace {

std::string absent(const AbsentTracer& tracer) { return "absent: needs " + tracer.needs; }

std::string_view runs(const TracerInfo& info) {
  return info.isolation == Isolation::process ? "child" : "in-process";
}

std::optional<std::string_view> package(std::string_view name) {
  return name.empty() ? std::nullopt : std::optional(name);
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
  for (const AbsentTracer& tracer : absent_tracers())
    all.rows.push_back({tracer.name, "", "", "", "", "", tracer.package, absent(tracer), ""});
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
    object.text("package", package(info.package));
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
  for (const AbsentTracer& tracer : absent_tracers()) {
    JsonObject object(out);
    object.text("tracer", tracer.name);
    object.boolean("present", false);
    object.text("summary", absent(tracer));
    object.text("package", package(tracer.package));
    object.end_line();
  }
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
      "Tracers whose library this build didn't find, or whose instructions this processor lacks, come last, with "
      "what\nthey need.\n\n"
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
