#include <fmt/format.h>

#include <cstdio>
#include <set>

#include "analysis/ask.h"
#include "analysis/tracers.h"
#include "case/input_error.h"
#include "case/json_object.h"
#include "case/printable.h"
#include "cli/findings_option.h"
#include "cli/stream.h"
#include "cli/tracer_options.h"
#include "cli/verb.h"
#include "findings/collector.h"
#include "findings/found.h"
#include "findings/store.h"

namespace plumbline {
namespace {

struct Options {
  StreamOptions stream;
  std::string tracer, store;
  ForeignOptions foreign;
};

// By what --tracer promises and is really asked, else the tracer which the line names; else by the default contract.
class Judge {
 public:
  Judge(const Tracer* chosen, const std::string& store) : chosen_(chosen) {
    if (!store.empty()) collector_.emplace(store, "judge");
  }

  Judgement judge(const CaseLine& line) {
    const Tracer* const tracer = chosen_ ? chosen_ : tracer_named(line.tracer);
    if (tracer) {
      const Case put = put_at(line.asked, tracer->info().contract.precision);
      const Query query = tracer->info().own_queries ? tracer->prepare(put.bag)->asked(put.ray) : Query(put.ray);
      return judge(line, tracer->info().contract, put, query);
    }
    if (!line.tracer.empty() && warned_of_.insert(line.tracer).second)
      fmt::print(stderr, "warning: '{}' is no tracer of this build: judged by the default contract; {}\n",
                 printable(line.tracer), suggest_tracer(line.tracer));
    return judge(line, Contract{.precision = line.asked.precision}, line.asked, line.asked.ray);
  }

  void finish() {
    if (collector_) collector_->finish();
  }

 private:
  Judgement judge(const CaseLine& line, const Contract& contract, const Case& put, const Query& query) {
    const Judgement judgement = plumbline::judge(put, {.query = query, .answer = *line.answer}, contract);
    if (!collector_) return judgement;
    // Who answered, which need not be the one whose contract holds.
    TracerInfo info = chosen_ ? chosen_->info() : TracerInfo{.name = "unnamed", .summary = "", .source = "", .contract = {}};
    if (!line.tracer.empty()) info.name = line.tracer;
    info.contract = contract;
    const Tracer* const tracer = tracer_named(info.name);
    info.package = tracer ? tracer->info().package : "";
    collector_->count(info.name, 1);
    if (wrong(judgement.verdict))
      if (const auto found = finding_in_answer(info, tracer, put, query, *line.answer, "judge")) collector_->add(*found);
    return judgement;
  }

  const Tracer* chosen_;
  std::set<std::string> warned_of_;
  std::optional<Collector> collector_;
};

std::string words(const Condition& condition) {
  if (condition.nominal()) return "nominal";
  std::string all;
  const auto add = [&all](bool is, std::string_view word) {
    if (is) all += (all.empty() ? "" : " ") + std::string(word);
  };
  add(condition.grazing, "grazing");
  add(condition.sliver, "sliver");
  add(condition.far, "far");
  return all;
}

void write(const CaseLine& line, const Judgement& judgement, std::string& out) {
  const auto& severity = judgement.severity;
  JsonObject object(out);
  object.member("id") += line.id;
  object.text("verdict", name(judgement.verdict));
  object.text("class", name(judgement.truth.hit_class));
  const Feature feature = judgement.truth.feature;
  object.text("feature", feature == Feature::none ? std::nullopt : std::optional(name(feature)));
  object.boolean("hit", judgement.hit);
  object.number("severity", severity ? std::optional(severity->length) : std::nullopt);
  object.number("severity_ulps", severity ? std::optional(severity->ulps) : std::nullopt);
  object.text("condition", severity ? std::optional(words(severity->condition)) : std::nullopt);
  object.end_line();
}

bool run(const Options& options) {
  if (!options.store.empty()) FindingStore(options.store, Open::create);
  Judge judge(options.tracer.empty() ? nullptr : &find_tracer(options.tracer, options.foreign), options.store);
  std::array<std::size_t, verdict_kind_names.size()> count{};
  const auto lines_read =
      answer_lines(options.stream, [&](const CaseLines& lines, const CaseLine& line, std::string& out) {
        require_one_triangle(lines, line);
        if (!line.answer) lines.fail("no answer to judge; add \"hit\":true, false, or null for a fault");
        const Judgement judgement = judge.judge(line);
        ++count[static_cast<unsigned>(judgement.verdict)];
        write(line, judgement, out);
      });
  if (lines_read == 0)
    throw InputError(fmt::format("{}: nothing to judge; give one JSON object a line", options.stream.input));

  fmt::print(stderr, "{} answers", lines_read);
  constexpr auto of_one_triangle = static_cast<std::size_t>(VerdictKind::leak);  // what is before it
  for (std::size_t i = 0; i < of_one_triangle; ++i)
    fmt::print(stderr, "{} {} {}", i == 0 ? ":" : ",", count[i], verdict_kind_names[i]);
  fmt::print(stderr, "\n");
  judge.finish();
  const auto of = [&count](VerdictKind kind) { return count[static_cast<unsigned>(kind)]; };
  return of(VerdictKind::false_miss) + of(VerdictKind::false_hit) > 0;
}

}  // namespace

void add_judge(CLI::App& app, bool& disagreement) {
  CLI::App* verb = app.add_subcommand("judge", "Whether answers are right: exit code 1 if one is wrong");
  auto options = std::make_shared<Options>();
  verb->add_option(
          "--tracer", options->tracer,
          "Judge by what this tracer promises (default: the tracer that a line names, else closed edges, closed\n"
          "range t_min to t_max)")
      ->type_name("NAME");
  add_findings_option(*verb, options->store);
  add_tracer_timeout(*verb, options->foreign);
  add_stream_options(*verb, options->stream);
  verb->footer(
      std::string(question_keys) +
      "\nThe same object holds the answer:\n"
      "  hit          true, false, or null for a fault (required); nothing else is judged\n"
      "  t, u, v, in, out, triangle_index   numbers or null; not looked at\n"
      "  tracer       who says so; of a name that 'plumbline tracers' doesn't list you are warned\n"
      "The case has to be as the tracer was given it: if yours reads binary32, round all numbers to it and add\n"
      "\"precision\":\"binary32\".\n"
      "\nEach line of output judges one line of input:\n"
      "  id           as given\n"
      "  verdict      correct, false-miss, false-hit, unspecified (the contract leaves it open) or fault\n"
      "  class, feature, hit   the truth, as classify tells it; hit in the range that the contract has searched:\n"
      "               t_min to t_max, from 0 on, or the whole line\n"
      "  severity     of a wrong answer: by how much the ray would have to be moved for it to be right, as a\n"
      "               length; severity_ulps in units in the last place of the largest coordinate\n"
      "  condition    nominal, or what makes the case ill-conditioned: grazing, sliver, far\n"
      "--findings: a wrong answer goes to the store as what its line says. The tracer that the line names, else --tracer, is\n"
      "asked again if this build has it: it alone can tell by which of its tests it missed, and whether numbers over- or\n"
      "underflowed. Of other tracers that stays unknown, so their signatures are coarser. A tracer without a name is\n"
      "called 'unnamed'.\n"
      "The counts go to standard error. Exit code 1: a false miss or a false hit. Faults alone exit with 0.\n"
      "\nExample:\n"
      "  plumbline trace --tracer plucker_f32 --merged rays.ndjson | plumbline judge -\n"
      "  plumbline generate exact_edge23 | my_program | plumbline judge -\n"
      "  plumbline generate exact_edge23 | my_program | plumbline judge - --findings found.db");
  verb->callback([options, &disagreement] { disagreement = run(*options); });
}

}  // namespace plumbline
