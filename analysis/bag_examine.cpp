#include "analysis/bag_examine.h"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/ask.h"
#include "analysis/signature.h"
#include "case/input_error.h"
#include "oracle/judge.h"

namespace plumbline {
namespace {

// Only the triangles crossed can have been lost.
std::vector<Answer> hits_alone(const Tracer& tracer, const Case& put, const BagTruth& truth) {
  std::vector<Answer> hits;
  Case one = put;
  for (const BagHit& hit : truth.hits) {
    one.bag.triangles = {put.bag.triangles[hit.triangle]};
    Answer answer = ask(tracer, one).answer;
    answer.triangle = hit.triangle;
    if (answer.outcome == Outcome::hit) hits.push_back(answer);
  }
  return hits;
}

}  // namespace

BagExamination examine_bag(const Tracer& tracer, const Case& asked) {
  if (asked.bag.mode != BagMode::surface)
    throw InputError(
        fmt::format("case '{}' is a {} of {} triangles, and several are judged as surfaces; remove its line 'mode'",
                    asked.id, name(asked.bag.mode), asked.bag.triangles.size()));
  const Contract& contract = tracer.info().contract;
  BagExamination e;
  e.put = put_at(asked, contract.precision);
  const Reply reply = ask(tracer, e.put);
  e.query = searched_ray(reply.query, contract);
  e.answer = reply.answer;
  e.died = !reply.conduct.deaths.empty();
  e.conduct = reply.conduct;
  e.truth = bag_truth(e.put.bag.triangles, e.query);
  e.judgement = judge_nearest({e.put.bag.triangles, e.query, e.truth, contract}, e.answer);
  const bool lost = e.judgement.verdict == BagVerdict::leak || e.judgement.verdict == BagVerdict::wrong_nearest;
  if (lost && e.put.bag.triangles.size() > 1)
    e.culling = lost_by_culling(e.judgement, e.truth, e.answer, hits_alone(tracer, e.put, e.truth));
  return e;
}

std::optional<BagSignature> signature(const BagExamination& e) {
  if (e.died) return death_signature;
  if (!e.wrong()) return std::nullopt;
  return signature(e.judgement, e.culling);
}

BagSignature signature(const BagJudgement& judgement, bool culling) {
  return {judgement.verdict, judgement.due, culling, judgement.behind};
}

std::string to_word(const BagSignature& s) {
  if (s == death_signature) return std::string(name(FindingKind::death));
  std::string word(name(s.verdict));
  if (s.where != HitClass::exterior) word += "-" + std::string(name(s.where));
  if (s.through) word += "-through";
  if (s.culling) word += "-culling";
  return word;
}

}  // namespace plumbline
