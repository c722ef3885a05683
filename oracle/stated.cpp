#include "oracle/stated.h"

#include <fmt/format.h>

#include <algorithm>

#include "case/real_text.h"
#include "oracle/classify.h"
#include "oracle/contact.h"
#include "oracle/measure.h"

namespace plumbline {
namespace {

std::string_view word(std::optional<bool> hit) { return !hit ? "open" : *hit ? "hit" : "miss"; }

}  // namespace

std::string expectation_differences(const Case& asked) {
  if (!asked.expect) return "";
  const Triangle& triangle = asked.bag.triangles.front();
  const Expectation& expect = *asked.expect;
  const Truth truth = classify(triangle, asked.ray);
  std::string found;
  const auto compare = [&found](std::string_view what, std::string_view expected, std::string_view is) {
    if (expected != is)
      found += fmt::format("{}expected {} {}, it is {}", found.empty() ? "" : "; ", what, expected, is);
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

std::optional<VerdictKind> known_as(const Case& asked, std::string_view tracer) {
  const auto known = std::ranges::find(asked.known, tracer, &Known::tracer);
  return known == asked.known.end() ? std::nullopt : std::optional(known->kind);
}

std::optional<ReplayRule> rule_of(VerdictKind verdict, std::optional<VerdictKind> known) {
  if (verdict == known) return std::nullopt;
  switch (verdict) {
    case VerdictKind::false_miss: return ReplayRule::false_miss;
    case VerdictKind::false_hit: return ReplayRule::false_hit;
    case VerdictKind::fault: return ReplayRule::fault;
    case VerdictKind::leak: return ReplayRule::leak;
    case VerdictKind::wrong_nearest: return ReplayRule::wrong_nearest;
    case VerdictKind::correct:
    case VerdictKind::unspecified: break;
  }
  return known ? std::optional(ReplayRule::known_now_passes) : std::nullopt;
}

std::string rule_message(VerdictKind verdict, std::optional<VerdictKind> known,
                         const std::optional<Severity>& severity) {
  const auto rule = rule_of(verdict, known);
  std::string text;
  if (known) {
    text = fmt::format("known as {}, it is now {}; {} the line 'known'", name(*known), name(verdict),
                       rule == ReplayRule::known_now_passes ? "remove" : "look into it and change");
  } else {
    text = verdict == VerdictKind::fault ? "no answer: a fault" : fmt::format("new {}", name(verdict));
  }
  if (severity)
    text += fmt::format(", severity {} ({:.3g} ulps)", shortest_decimal(severity->length), severity->ulps);
  return text;
}

}  // namespace plumbline
