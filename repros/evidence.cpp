#include "repros/evidence.h"

#include <fmt/format.h>

#include <cmath>

#include "analysis/examine.h"
#include "analysis/tracers.h"
#include "case/float_bits.h"
#include "case/input_error.h"
#include "case/precision.h"
#include "case/real_text.h"
#include "oracle/classify.h"
#include "oracle/explain.h"
#include "repros/text.h"

namespace plumbline {
namespace {

void require_one_valid_triangle(const Case& what) {
  if (what.bag.triangles.size() != 1)
    throw InputError(
        fmt::format("case '{}' has {} triangles, and a program is about one; export it as python-proof, obj, ply or "
                    "asc",
                    what.id, what.bag.triangles.size()));
  const Truth truth = classify(what.bag.triangles.front(), what.ray);
  if (truth.hit_class == HitClass::invalid)
    throw InputError(
        fmt::format("case '{}': {}, so nothing is true of it; export another", what.id, reason(truth.invalid)));
}

Duty with_slack(Duty duty, const Evidence& e) {
  if (duty != Duty::miss) return duty;
  const bool excused =
      judge(e.triangle(), e.query, e.truth, {.outcome = Outcome::hit}, e.contract) == VerdictKind::correct;
  return excused ? Duty::any : Duty::miss;
}

}  // namespace

void require_precision(const Case& what, Precision precision, std::string_view tracer) {
  if (at_precision(what.bag, precision) == what.bag && at_precision(what.ray, precision) == what.ray) return;
  throw InputError(
      fmt::format("case '{}' has numbers that are not {}, which {} reads; round it ('plumbline generate CASE "
                  "--precision {} | plumbline convert -'), or export it for a tracer that reads binary64",
                  what.id, name(precision), tracer, name(precision)));
}

Evidence gather(const Case& what, std::string_view tracer, const std::optional<Contract>& otherwise) {
  require_one_valid_triangle(what);
  const Tracer* const here = tracer.empty() ? nullptr : tracer_named(tracer);
  if (!here && !otherwise)
    throw InputError(fmt::format("'{}': {}; without it nobody knows here what it is asked and promises", tracer,
                                 suggest_tracer(tracer)));
  Evidence e;
  e.what = what;
  e.tracer = tracer;
  e.contract = here ? here->info().contract : *otherwise;
  require_precision(what, e.contract.precision, tracer.empty() ? "the case's own precision" : tracer);
  e.query = searched_ray(what.ray, e.contract);
  if (here) {
    const TracerInfo& info = here->info();
    e.call = info.source + (info.package.empty() ? "" : " (" + info.package + ")");
    const Examination examined = Examiner(*here).examine(e.triangle(), e.ray());
    e.query = examined.query;
    e.answer = examined.answer;
    if (const auto found = signature(examined)) {
      e.wrong = found->kind;
      e.ulps = finding_ulps(examined, *found);
    }
  }
  e.truth = classify(e.triangle(), e.query);
  e.duty = with_slack(duty(e.triangle(), e.query, e.truth, e.contract), e);
  e.exact = measure<double>(e.triangle(), e.query);
  if (const auto m = margins(e.triangle(), e.query, e.contract.precision))
    e.leeway = leeway(*m, e.contract.precision);
  if (!e.leeway) e.exact.reset();
  return e;
}

Evidence gather_to_ask(const Case& what, std::string_view tracer, const std::optional<Contract>& otherwise) {
  Evidence e = gather(what, tracer, otherwise);
  if (e.answer && e.answer->outcome == Outcome::fault && !e.wrong)
    throw InputError(fmt::format(
        "case '{}' is beyond what {} takes, so no program can ask it; python-proof, obj, ply and asc tell it",
        what.id, tracer));
  return e;
}

std::string said(const Answer& answer) {
  const auto number = [](double x) { return fmt::format("{} ({})", hexfloat(x), shortest_decimal(x)); };
  if (answer.outcome == Outcome::fault) return "nothing";
  if (answer.outcome == Outcome::miss) return "a miss";
  std::string text = "a hit";
  if (answer.has_t) text += " at t = " + number(answer.t);
  if (answer.has_uv) text += fmt::format(", u = {}, v = {}", number(answer.u), number(answer.v));
  return text;
}

std::string headline(const Evidence& e) {
  if (e.tracer.empty()) return "Where a ray meets a triangle, exactly.";
  const std::string who = harmless(e.tracer);
  if (!e.answer) {
    for (const Known& known : e.what.known)
      if (known.tracer == e.tracer)
        return fmt::format("{} is known to get this ray wrong: {}.", who, name(known.kind));
    return fmt::format("What does {} say of this ray?", who);
  }
  if (!e.wrong) {
    if (e.answer->outcome == Outcome::fault) return fmt::format("{} gives no answer to this ray.", who);
    if (e.duty == Duty::any) return fmt::format("{} leaves open what it says of this ray: no answer is wrong.", who);
    return fmt::format("{} gets this ray right.", who);
  }
  const std::string by = e.ulps > 0 ? fmt::format(" by {:.4g} ulps of the largest coordinate", e.ulps) : "";
  switch (*e.wrong) {
    case FindingKind::false_hit:
      return fmt::format("{} hits a triangle that the ray misses: a false hit{}.", who, by);
    case FindingKind::false_miss:
      return fmt::format("{} misses a triangle that the ray hits: a false miss{}.", who, by);
    case FindingKind::displaced:
      return fmt::format("{} hits rightly, but puts the hit {:.4g} ulps of the largest coordinate away.", who,
                         e.ulps);
    case FindingKind::not_finite: return fmt::format("{} hits rightly, but its t, u or v is no finite number.", who);
    case FindingKind::death: return fmt::format("{} dies of this ray.", who);
    case FindingKind::leak:
      return fmt::format("{} misses triangles of which the ray has to hit one: a leak{}.", who, by);
    case FindingKind::wrong_nearest:
      return fmt::format("{} hits another triangle than the ray has to hit first{}.", who, by);
  }
  return "";
}

std::string story(const Evidence& e, std::string_view command) {
  std::string text = fmt::format("{}\n\n    {}\n\n", headline(e), command);
  text += fmt::format("case       {}\n", harmless(e.what.id));
  for (const std::string& line : e.what.provenance) text += fmt::format("           {}\n", harmless(line));
  if (!e.call.empty()) text += fmt::format("call       {}\n", harmless(e.call));
  if (!(e.query == Query(searched_ray(e.ray(), e.contract))))
    text +=
        "asked      what its interface makes of the ray, which can't hold it; the truth is that of the line below\n";
  text += explain(e.triangle(), e.query);
  if (e.answer) text += explain_verdict(e.triangle(), e.query, *e.answer, e.contract);
  return text;
}

}  // namespace plumbline
