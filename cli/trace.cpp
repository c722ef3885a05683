#include <fmt/format.h>

#include <cstdio>

#include "analysis/ask.h"
#include "analysis/tracers.h"
#include "case/case_json.h"
#include "cli/stream.h"
#include "cli/tracer_options.h"
#include "cli/verb.h"

namespace plumbline {
namespace {

struct Options {
  StreamOptions stream;
  std::string tracer;
  ForeignOptions foreign;
  bool merged = false;
};

}  // namespace

void add_trace(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("trace", "What a tracer says of each ray");
  auto options = std::make_shared<Options>();
  verb->add_option("--tracer", options->tracer, "Who is asked; 'plumbline tracers' lists them")
      ->type_name("NAME")
      ->required();
  add_tracer_timeout(*verb, options->foreign);
  verb->add_flag("--merged", options->merged, "Repeat the case before its answer, as 'plumbline judge' reads it");
  add_stream_options(*verb, options->stream);
  verb->footer(std::string(question_keys) +
               "\n" + foreign_tracers_help +
               "\nA tracer that reads binary32 is asked for the case rounded to it.\n"
               "Each line of output answers one line of input:\n"
               "  id           as given\n"
               "  tracer       NAME\n"
               "  hit          true, false, or null with \"fault\":true where the tracer can't answer\n"
               "  t, u, v      as the tracer gives them (u: weight of b, v: of c), else null\n"
               "  in, out      where the ray enters and leaves, for tracers that give segments, else null\n"
               "\nExample:\n"
               "  plumbline trace --tracer moller_trumbore_f64 --merged rays.ndjson | plumbline judge -");
  verb->callback([options] {
    const Tracer& tracer = find_tracer(options->tracer, options->foreign);
    Conduct conduct;
    answer_lines(options->stream, [&](const CaseLines&, const CaseLine& line, std::string& out) {
      JsonObject object(out);
      object.member("id") += line.id;
      if (options->merged) add_members(object, line.asked);
      object.text("tracer", tracer.info().name);
      const Reply reply = ask(tracer, line.asked);
      conduct += reply.conduct;
      add_members(object, reply.answer);
      object.end_line();
    });
    fmt::print(stderr, "{}", complaints(tracer.info().name, conduct));
  });
}

}  // namespace plumbline
