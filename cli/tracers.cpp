#include "analysis/tracers.h"

#include <string>

#include "analysis/text_table.h"
#include "case/json_object.h"
#include "cli/output.h"
#include "cli/verb.h"

namespace plumbline {
namespace {

std::string table() {
  TextTable all{.columns = {{"tracer"}, {"precision"}, {"edges"}, {"t range"}, {"what it is"}, {"source"}}, .rows = {}};
  for (const auto& tracer : all_tracers()) {
    const TracerInfo& info = tracer->info();
    const Contract& c = info.contract;
    all.rows.push_back({info.name, std::string(name(c.precision)), std::string(name(c.edges)),
                        std::string(name(c.range)), info.summary, info.source});
  }
  return to_terminal(all);
}

std::string json_lines() {
  std::string out;
  for (const auto& tracer : all_tracers()) {
    const TracerInfo& info = tracer->info();
    const Contract& c = info.contract;
    JsonObject object(out);
    object.text("tracer", info.name);
    object.text("summary", info.summary);
    object.text("source", info.source);
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
      "(one of the triangles that share them is hit), unspecified. t range: given (it reads t_min and t_max), ray (it\n"
      "searches [0, inf)), line (all t).\n"
      "\nExample:\n"
      "  plumbline tracers");
  verb->callback([json] {
    Output output;
    output.write(*json ? json_lines() : table());
    output.finish();
  });
}

}  // namespace plumbline
