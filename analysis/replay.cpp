#include "analysis/replay.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "analysis/ask.h"
#include "analysis/bag_examine.h"
#include "analysis/signature.h"
#include "analysis/tracers.h"
#include "case/case_files.h"
#include "case/shell_word.h"
#include "oracle/bag/explain_bag.h"
#include "oracle/explain.h"

namespace plumbline {
namespace {

std::string explain_command(const ReplayedCase& at, const Tracer* tracer) {
  const std::string& file = at.file == "-" ? at.file : at.path;
  std::string command = fmt::format("plumbline explain {} --id {}", shell_word(file), shell_word(at.id));
  if (tracer) command += " --tracer " + shell_word(asked_for(*tracer));
  return command;
}

class Replay {
 public:
  explicit Replay(const std::vector<const Tracer*>& tracers) : tracers_(tracers) {
    for (const Tracer* tracer : tracers) summary_.tracers.push_back(tracer->info().name);
    summary_.conduct.resize(tracers.size());
  }

  void run(const std::string& file, const std::vector<PlacedCase>& cases) {
    ++summary_.files;
    const std::string path = file == "-" ? "stdin" : std::filesystem::proximate(file).generic_string();
    for (const auto& [line, asked] : cases) {
      summary_.cases.push_back({.file = file, .path = path, .line = line, .id = asked.id});
      run(asked);
    }
  }

  ReplaySummary take() { return std::move(summary_); }

 private:
  void run(const Case& asked) {
    const std::size_t which = summary_.cases.size() - 1;
    if (asked.expect) summary_.results.push_back(on_expectation(which, asked));
    for (std::size_t i = 0; i < tracers_.size(); ++i) summary_.results.push_back(on_answer(which, i, asked));
    for (const Known& known : asked.known) {
      const Tracer* const tracer = tracer_named(known.tracer);
      if (!tracer && !absent_tracer_named(known.tracer)) {
        ++summary_.unknown_tracers[known.tracer];
      } else if (!tracer || std::ranges::find(tracers_, tracer) == tracers_.end()) {
        ++summary_.skipped_known;
      }
    }
  }

  ReplayResult on_expectation(std::size_t which, const Case& asked) const {
    ReplayResult result;
    result.which = which;
    result.message = expectation_differences(asked);
    if (result.message.empty()) return result;
    result.rule = ReplayRule::expectation_differs;
    result.why =
        explain(asked.bag.triangles.front(), asked.ray) + explain_command(summary_.cases[which], nullptr) + "\n";
    return result;
  }

  ReplayResult on_answer(std::size_t which, std::size_t index, const Case& asked) {
    return asked.bag.triangles.size() == 1 ? on_triangle(which, index, asked) : on_bag(which, index, asked);
  }

  ReplayResult on_bag(std::size_t which, std::size_t index, const Case& asked) {
    const Tracer& tracer = *tracers_[index];
    const BagExamination e = examine_bag(tracer, asked);
    summary_.conduct[index] += e.conduct;
    ReplayResult result;
    result.which = which;
    result.tracer = index;
    result.verdict = verdict_kind(e.judgement.verdict);
    result.known = known_as(asked, tracer.info().name);
    if (e.wrong()) result.severity = {.length = e.judgement.length, .ulps = e.judgement.ulps, .condition = {}};
    if (e.wrong() || e.died) result.signature = to_word(*signature(e));
    tell(result, e.died,
         explain_bag_verdict({e.put.bag.triangles, e.query, e.truth, tracer.info().contract}, e.answer, e.judgement));
    return result;
  }

  ReplayResult on_triangle(std::size_t which, std::size_t index, const Case& asked) {
    const Tracer& tracer = *tracers_[index];
    const Contract& contract = tracer.info().contract;
    const Case put = put_at(asked, contract.precision);
    Examiner examiner(tracer, Measure::wrong_answers, put.bag);
    const Examination e = examiner.examine(put.bag.triangles.front(), put.ray);
    summary_.conduct[index] += examiner.conduct();
    ReplayResult result;
    result.which = which;
    result.tracer = index;
    result.verdict = e.verdict;
    result.known = known_as(asked, tracer.info().name);
    if (e.wrong()) result.severity = severity(e.triangle, e.query, e.answer.outcome == Outcome::hit, e.precision);
    if (e.wrong() || e.died) result.signature = to_word(*signature(e, asked.aim ? asked.aim->wish : Wish::none));
    tell(result, e.died, explain_verdict(e.triangle, e.query, e.answer, contract));
    return result;
  }

  // What there is to tell of a verdict, if anything.
  void tell(ReplayResult& result, bool died, const std::string& why) const {
    result.rule = rule_of(*result.verdict, result.known);
    if (!result.rule) return;
    result.message =
        rule_message(*result.verdict, result.known, result.severity) + (died ? " (it died of this case)" : "");
    result.why = why + explain_command(summary_.cases[result.which], tracers_[*result.tracer]) + "\n";
  }

  const std::vector<const Tracer*>& tracers_;
  ReplaySummary summary_;
};

}  // namespace

std::size_t ReplaySummary::disagreements() const {
  return static_cast<std::size_t>(std::ranges::count_if(results, [](const ReplayResult& r) { return disagrees(r); }));
}

ReplaySummary replay(const std::vector<std::string>& paths, const std::vector<const Tracer*>& tracers) {
  std::vector<std::pair<std::string, std::vector<PlacedCase>>> files;
  for (const std::string& path : paths)
    for (const std::string& file : case_files(path)) files.emplace_back(file, cases_to_judge(file));
  Replay run(tracers);
  for (const auto& [file, cases] : files) run.run(file, cases);
  return run.take();
}

}  // namespace plumbline
