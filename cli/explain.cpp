#include "oracle/explain.h"

#include <fmt/format.h>

#include <array>
#include <span>

#include "analysis/ask.h"
#include "analysis/bag_examine.h"
#include "analysis/tracers.h"
#include "case/case_text.h"
#include "case/input_error.h"
#include "case/real_text.h"
#include "cli/number_options.h"
#include "cli/output.h"
#include "cli/tracer_options.h"
#include "cli/verb.h"
#include "oracle/bag/explain_bag.h"

namespace plumbline {
namespace {

struct Options {
  std::string file, id, tracer;
  ForeignOptions foreign;
  std::array<std::string, 9> triangle;
  std::array<std::string, 6> ray;
  std::array<std::string, 2> range = {"0", "inf"};
};

double number(const std::string& text, std::string_view option) {
  const auto x = parse_real(text);
  if (!x) throw InputError(fmt::format("{}: '{}' is no number; write 1.5, 0x1.8p+0, inf, -inf or nan", option, text));
  return *x;
}

// The three numbers from `at` on.
Vec3 vector(std::span<const std::string> texts, std::size_t at, std::string_view option) {
  return {number(texts[at], option), number(texts[at + 1], option), number(texts[at + 2], option)};
}

Case case_of(const Options& options) {
  Case made;
  made.id = "given";
  made.bag.triangles = {{vector(options.triangle, 0, "--triangle"), vector(options.triangle, 3, "--triangle"),
                         vector(options.triangle, 6, "--triangle")}};
  made.ray = {vector(options.ray, 0, "--ray"), vector(options.ray, 3, "--ray"), number(options.range[0], "--range"),
              number(options.range[1], "--range")};
  return made;
}

std::vector<Case> cases_of(const Options& options) {
  if (options.file.empty()) {
    if (options.triangle.front().empty()) throw InputError("explain what? Give a FILE.case, or --triangle and --ray");
    return {case_of(options)};
  }
  std::vector<Case> cases = read_cases(options.file);
  if (!options.id.empty()) std::erase_if(cases, [&](const Case& c) { return c.id != options.id; });
  if (cases.empty())
    throw InputError(options.id.empty() ? fmt::format("{}: no case in this file", options.file)
                                        : fmt::format("{}: no case '{}' in this file", options.file, options.id));
  return cases;
}

// What is true of the triangles together, and the verdict on what is hit first.
std::string text_of_several(const Case& put, const Tracer* tracer) {
  const auto all = [&](const Query& query, const BagTruth& truth) {
    return "\n" + explain_bag(put.bag.triangles, query, truth);
  };
  std::string text = "\nTogether:\n" + all(put.ray, bag_truth(put.bag.triangles, put.ray));
  if (!tracer) return text;
  const TracerInfo& info = tracer->info();
  const BagExamination e = examine_bag(*tracer, put);
  fmt::print(stderr, "{}", complaints(info.name, e.conduct));
  text += fmt::format("\ntracer     {}\n", info.name);
  if (info.own_queries) text += "\nThe tracer is asked this instead:\n" + all(e.query, e.truth) + "\n";
  text += explain_bag_verdict({put.bag.triangles, e.query, e.truth, info.contract}, e.answer, e.judgement);
  if (const auto found = signature(e)) text += fmt::format("signature  {}\n", to_word(*found));
  if (e.culling)
    text += "           asked with one of these triangles alone it hits it: lost in its boxes or traversal\n";
  return text;
}

std::string text_of(const Case& asked, const Tracer* tracer) {
  std::string text = fmt::format("case {}\n", asked.id);
  for (const std::string& line : asked.provenance) text += fmt::format("# {}\n", line);
  const Case put = tracer ? put_at(asked, tracer->info().contract.precision) : asked;
  for (const Triangle& triangle : put.bag.triangles) text += "\n" + explain(triangle, put.ray);
  if (put.bag.triangles.size() > 1) return text + text_of_several(put, tracer);
  if (!tracer) return text;
  text += fmt::format("\ntracer     {}\n", tracer->info().name);
  const Reply reply = ask(*tracer, put);
  fmt::print(stderr, "{}", complaints(tracer->info().name, reply.conduct));
  if (tracer->info().own_queries) text += "\nThe tracer is asked this instead:\n" + explain(put.bag.triangles.front(), reply.query);
  return text + explain_verdict(put.bag.triangles.front(), reply.query, reply.answer, tracer->info().contract);
}

void run(const Options& options) {
  const Tracer* const tracer = options.tracer.empty() ? nullptr : &find_tracer(options.tracer, options.foreign);
  Output output;
  bool first = true;
  for (const Case& asked : cases_of(options)) {
    output.write((first ? "" : "\n\n") + text_of(asked, tracer));
    first = false;
  }
  output.finish();
}

}  // namespace

void add_explain(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("explain", "Why: the exact numbers behind a class and a verdict");
  auto options = std::make_shared<Options>();
  CLI::Option* file = verb->add_option("FILE", options->file, "A .case file; '-' is standard input");
  verb->add_option("--id", options->id, "Only the case of this id (default: all of the file)")
      ->type_name("ID")
      ->needs(file);
  CLI::Option* triangle = verb->add_option("--triangle", options->triangle, "Instead of a file: the vertices a, b, c")
                              ->check(no_option_among("9 numbers X Y Z  X Y Z  X Y Z"))
                              ->type_name("X Y Z  X Y Z  X Y Z")
                              ->excludes(file);
  CLI::Option* ray = verb->add_option("--ray", options->ray, "The ray's origin and direction")
                         ->check(no_option_among("6 numbers X Y Z  X Y Z"))
                         ->type_name("X Y Z  X Y Z")
                         ->needs(triangle);
  triangle->needs(ray);
  verb->add_option("--range", options->range, "t_min and t_max, in lengths of the direction (default: 0 inf)")
      ->check(no_option_among("2 numbers T_MIN T_MAX"))
      ->type_name("T T")
      ->needs(triangle);
  verb->add_option("--tracer", options->tracer, "Ask this tracer too, at its precision, and explain the verdict")
      ->type_name("NAME");
  add_tracer_timeout(*verb, options->foreign);
  verb->footer(
      "A number is a decimal, a hexfloat (0x1.8p+0), inf, -inf or nan. What is not finite makes the case invalid, but\n"
      "for infinite ends of the range, and the reason is told. A .case file takes no nan.\n"
      "Of several triangles each is explained, then where the ray meets them, in exact order; a tracer is asked about\n"
      "all of them at once, and judged by what it hits first.\n\n" +
      std::string(foreign_tracers_help) +
      "\nExample:\n"
      "  plumbline explain --triangle 0 0 0  1.5 0 0  0 1.5 0 --ray 0.75 0.75 5  0 0 -1 --tracer brlcad_bot_hlbvh");
  verb->callback([options] { run(*options); });
}

}  // namespace plumbline
