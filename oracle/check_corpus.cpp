#include "oracle/check_corpus.h"

#include <fmt/format.h>

#include "case/answer.h"
#include "case/case_files.h"
#include "case/precision.h"
#include "oracle/bag/explain_bag.h"
#include "oracle/classify.h"
#include "oracle/explain.h"
#include "oracle/judge.h"
#include "oracle/severity.h"
#include "oracle/stated.h"

namespace plumbline {
namespace {

Outcome any_hit(const std::vector<Triangle>& triangles, const Ray& ray, const CorpusTracer& tracer) {
  Outcome outcome = Outcome::miss;
  for (const Triangle& triangle : triangles) {
    const std::optional<bool> hit = tracer.hits(triangle, ray);
    if (!hit) return Outcome::fault;
    if (*hit) outcome = Outcome::hit;
  }
  return outcome;
}

// The same of several triangles.
std::string check_bag(const Case& asked, const CorpusTracer& tracer) {
  const auto known = known_as(asked, tracer.name);
  if (known == VerdictKind::wrong_nearest) return "";
  const Contract& contract = tracer.contract;
  const Bag bag = at_precision(asked.bag, contract.precision);
  const Ray ray = at_precision(asked.ray, contract.precision);
  const Query searched = searched_ray(ray, contract);
  const BagTruth truth = bag_truth(bag.triangles, searched);
  const BagQuestion question{bag.triangles, searched, truth, contract};
  const Answer answer = {.outcome = any_hit(bag.triangles, ray, tracer)};
  const BagJudgement judgement = judge_nearest(question, answer);
  const VerdictKind verdict = verdict_kind(judgement.verdict);
  if (!disagrees(rule_of(verdict, known), known)) return "";
  const bool wrong = verdict == VerdictKind::leak || verdict == VerdictKind::false_hit;
  const auto by = wrong ? std::optional(Severity{.length = judgement.length, .ulps = judgement.ulps, .condition = {}})
                        : std::nullopt;
  return rule_message(verdict, known, by) + "\n" + explain_bag_verdict(question, answer, judgement) +
         explain_bag(bag.triangles, searched, truth);
}

// What there is to tell of the answer to a case; empty if nothing.
std::string check(const Case& asked, const CorpusTracer& tracer) {
  if (asked.bag.triangles.size() > 1) return check_bag(asked, tracer);
  const Contract& contract = tracer.contract;
  const Triangle triangle = at_precision(asked.bag.triangles.front(), contract.precision);
  const Ray ray = at_precision(asked.ray, contract.precision);
  const std::optional<bool> hit = tracer.hits(triangle, ray);
  const Answer answer = {.outcome = !hit ? Outcome::fault : *hit ? Outcome::hit : Outcome::miss};
  const Query searched = searched_ray(ray, contract);
  const VerdictKind verdict = judge(triangle, ray, classify(triangle, searched), answer, contract);
  const auto known = known_as(asked, tracer.name);
  if (!disagrees(rule_of(verdict, known), known)) return "";
  const bool wrong = verdict == VerdictKind::false_miss || verdict == VerdictKind::false_hit;
  const auto by = wrong ? severity(triangle, searched, *hit, contract.precision) : std::nullopt;
  return rule_message(verdict, known, by) + "\n" + explain(triangle, searched) +
         explain_verdict(triangle, ray, answer, contract);
}

}  // namespace

std::string check_corpus(const std::string& path, const CorpusTracer& tracer) {
  std::string found;
  for (const std::string& file : case_files(path)) {
    for (const auto& [line, asked] : cases_to_judge(file)) {
      const std::string place = fmt::format("{}:{}: {}: ", file, line, asked.id);
      if (const std::string differs = expectation_differences(asked); !differs.empty())
        found += place + differs + "\n";
      if (const std::string differs = check(asked, tracer); !differs.empty())
        found += fmt::format("{}{}: {}", place, tracer.name, differs);
    }
  }
  return found;
}

}  // namespace plumbline
