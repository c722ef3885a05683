#include "analysis/replay.h"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/ask.h"
#include "analysis/tracers.h"
#include "case/case_files.h"
#include "case/case_text.h"
#include "case/input_error.h"
#include "case/real_text.h"
#include "oracle/classify.h"
#include "oracle/contact.h"
#include "oracle/measure.h"

namespace plumbline {
namespace {

std::string_view word(std::optional<bool> hit) { return !hit ? "open" : *hit ? "hit" : "miss"; }

// What the truth has otherwise than `expect` says; empty if nothing.
std::vector<std::string> differences(const Case& asked) {
  const Triangle& triangle = asked.bag.triangles.front();
  const Expectation& expect = *asked.expect;
  const Truth truth = classify(triangle, asked.ray);
  std::vector<std::string> found;
  const auto compare = [&found](std::string_view what, std::string_view expected, std::string_view is) {
    if (expected != is) found.push_back(fmt::format("expected {} {}, it is {}", what, expected, is));
  };
  compare("class", name(expect.hit_class), name(truth.hit_class));
  if (expect.feature != Feature::none) compare("feature", name(expect.feature), name(truth.feature));
  if (expect.hit) compare("answer", word(expect.hit), word(hit(triangle, asked.ray, truth)));
  const auto at = measure<double>(triangle, asked.ray);
  const auto compare_number = [&](std::string_view what, const std::optional<double>& expected,
                                  double Coordinates<double>::*is) {
    if (!expected) return;
    if (!at) {
      compare(what, hexfloat(*expected), "undefined");
    } else if (*expected != (*at).*is) {
      compare(what, hexfloat(*expected), hexfloat((*at).*is));
    }
  };
  compare_number("t", expect.t, &Coordinates<double>::t);
  compare_number("u", expect.u, &Coordinates<double>::u);
  compare_number("v", expect.v, &Coordinates<double>::v);
  return found;
}

class Replay {
 public:
  explicit Replay(const std::vector<const Tracer*>& tracers) : tracers_(tracers) {
    summary_.conduct.resize(tracers.size());
  }

  void run(const std::string& file) {
    const auto cases = read_cases(file);
    if (cases.empty()) throw InputError(fmt::format("{}: no case in this file", file));
    ++summary_.files;
    for (const Case& asked : cases) run(file, asked);
  }

  ReplaySummary take() { return std::move(summary_); }

 private:
  void run(const std::string& file, const Case& asked) {
    if (asked.bag.triangles.size() != 1)
      throw InputError(
          fmt::format("{}: case '{}' has {} triangles; replay judges one", file, asked.id, asked.bag.triangles.size()));
    ++summary_.cases;
    const auto add_event = [&](std::string message) {
      summary_.events.push_back({file, asked.id, std::move(message)});
    };
    if (asked.expect)
      for (std::string& difference : differences(asked)) add_event(std::move(difference));
    for (std::size_t i = 0; i < tracers_.size(); ++i) {
      const std::string message = verdict_on(i, asked);
      if (!message.empty()) add_event(fmt::format("{}: {}", tracers_[i]->info().name, message));
    }
    for (const Known& known : asked.known) {
      const Tracer* const tracer = tracer_named(known.tracer);
      if (!tracer && !absent_tracer_named(known.tracer)) {
        ++summary_.unknown_tracers[known.tracer];
      } else if (!tracer || std::ranges::find(tracers_, tracer) == tracers_.end()) {
        ++summary_.skipped_known;
      }
    }
  }

  // What there is to tell; empty if all is as the file says.
  std::string verdict_on(std::size_t index, const Case& asked) {
    const Tracer& tracer = *tracers_[index];
    ++summary_.answers;
    const Reply reply = ask(tracer, asked);
    summary_.conduct[index] += reply.conduct;
    const Judgement judgement = judge(asked, reply, tracer.info().contract);
    const auto known = std::ranges::find(asked.known, tracer.info().name, &Known::tracer);
    if (known != asked.known.end()) {
      if (judgement.verdict == known->kind) {
        ++summary_.known;
        return "";
      }
      return fmt::format("known as {}, it is now {}; {} the line 'known'", name(known->kind), name(judgement.verdict),
                         wrong(judgement.verdict) ? "look into it and change" : "remove");
    }
    if (judgement.verdict == VerdictKind::fault) ++summary_.faults;
    if (!wrong(judgement.verdict)) return "";
    std::string message = fmt::format("new {}", name(judgement.verdict));
    if (judgement.severity)
      message += fmt::format(", severity {} ({:.3g} ulps)", shortest_decimal(judgement.severity->length),
                             judgement.severity->ulps);
    return message;
  }

  const std::vector<const Tracer*>& tracers_;
  ReplaySummary summary_;
};

}  // namespace

ReplaySummary replay(const std::vector<std::string>& paths, const std::vector<const Tracer*>& tracers) {
  Replay run(tracers);
  for (const std::string& path : paths)
    for (const std::string& file : case_files(path)) run.run(file);
  return run.take();
}

}  // namespace plumbline
