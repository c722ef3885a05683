#include "oracle/explain.h"

#include <fmt/format.h>

#include <algorithm>
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
  bool all = false;
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

constexpr std::size_t most_explained = 8;

// Each triangle alone, those first that are concerned; of many only these.
std::string each_alone(const Case& put, const Query& query, std::vector<std::uint32_t> list, bool all) {
  const std::size_t count = put.bag.triangles.size();
  if (all || count <= most_explained) {
    for (std::uint32_t i = 0; i < count; ++i)
      if (std::ranges::find(list, i) == list.end()) list.push_back(i);
  } else if (list.size() > most_explained) {
    list.resize(most_explained);
  }
  std::string text;
  for (const std::uint32_t i : list)
    text += fmt::format("\ntriangle {}\n{}", i, explain_triangle(put.bag.triangles[i], query));
  if (list.size() < count)
    text += fmt::format("\n{} of {} triangles are left out, which matter less: --all tells of each\n",
                        count - list.size(), count);
  return text;
}

// The verdict on what is hit first, what is true of all together, and of each alone.
std::string text_of_several(const Case& put, const Tracer* tracer, bool all) {
  const std::vector<Triangle>& triangles = put.bag.triangles;
  const BagTruth truth = bag_truth(triangles, put.ray);
  const std::string given = "\n" + explain_bag(triangles, put.ray, truth);
  if (!tracer) return given + each_alone(put, put.ray, concerned({triangles, put.ray, truth, {}}), all);
  const TracerInfo& info = tracer->info();
  const BagExamination e = examine_bag(*tracer, put);
  fmt::print(stderr, "{}", complaints(info.name, e.conduct));
  const BagQuestion question{triangles, e.query, e.truth, info.contract};
  std::string text = fmt::format("\ntracer     {}\n", info.name);
  text += explain_bag_verdict(question, e.answer, e.judgement);
  if (const auto found = signature(e)) text += fmt::format("signature  {}\n", to_word(*found));
  if (e.culling)
    text += "           asked with one of these triangles alone it hits it: lost in its boxes or traversal\n";
  if (info.own_queries) text += given + "\nThe tracer is asked this instead:\n";
  text += "\n" + explain_bag(triangles, e.query, e.truth);
  return text + each_alone(put, e.query, concerned(question, e.answer, e.judgement), all);
}

std::string text_of(const Case& asked, const Tracer* tracer, bool all) {
  std::string text = fmt::format("case {}\n", asked.id);
  for (const std::string& line : asked.provenance) text += fmt::format("# {}\n", line);
  const Case put = tracer ? put_at(asked, tracer->info().contract.precision) : asked;
  if (put.bag.triangles.size() > 1) return text + text_of_several(put, tracer, all);
  text += "\n" + explain(put.bag.triangles.front(), put.ray);
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
    output.write((first ? "" : "\n\n") + text_of(asked, tracer, options.all));
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
  verb->add_flag("--all", options->all, "Of more than 8 triangles, tell of each, not only of those that matter");
  add_tracer_timeout(*verb, options->foreign);
  verb->footer(
      "A number is a decimal, a hexfloat (0x1.8p+0), inf, -inf or nan. What is not finite makes the case invalid, but\n"
      "for infinite ends of the range, and the reason is told. A .case file takes no nan.\n"
      "Of several triangles: where the ray meets them, in exact order, then each alone. A tracer is asked about all\n"
      "of them at once and judged by what it hits first; the verdict comes before all else. Of more than 8 triangles\n"
      "only those are told alone, at most 8, that had to be hit, were reported, or are met.\n\n" +
      std::string(foreign_tracers_help) +
      "\nExample:\n"
      "  plumbline explain --triangle 0 0 0  1.5 0 0  0 1.5 0 --ray 0.75 0.75 5  0 0 -1 --tracer brlcad_bot_hlbvh");
  verb->callback([options] { run(*options); });
}

}  // namespace plumbline
