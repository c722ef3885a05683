#include "oracle/bag/explain_bag.h"

#include <array>

#include "oracle/explain.h"
#include "oracle/explain_lines.h"

namespace plumbline {
namespace {

constexpr std::array<std::string_view, bag_verdict_names.size()> meanings = {
    "what has to be hit first is",
    "a point has to be hit, and nothing is",
    "there is nothing that may be hit, or not there",
    "another triangle has to be hit first",
    "more is hit than is there",
    "hits in the wrong order",
    "inside and outside taken for each other",
    "the wrong pieces are taken for inside",
    "the contract leaves it open",
    "no answer"};

void add_hits(Lines& lines, std::span<const Triangle> triangles, const Query& query, const BagTruth& truth) {
  const BagHit* before = nullptr;
  for (const BagHit& hit : truth.hits) {
    if (!before || before->rank != hit.rank) {
      const ExactRatio t = *certificate(triangles[hit.triangle], query).t;
      lines.add(fmt::format("hit {}", hit.rank + 1), "t = {}", t.exact);
      lines.add("", "binary64 {}   binary32 {:a}", number(t.binary64), t.binary32);
    }
    lines.add("", "triangle {}: {}, from the {}{}", hit.triangle, met_at(hit.truth),
              hit.truth.det_sign < 0 ? "front" : "back",
              hit.owner && hit.truth.hit_class != HitClass::interior ? ", its owner" : "");
    before = &hit;
  }
}

}  // namespace

std::string met_at(const Truth& truth) {
  std::string text(name(truth.hit_class));
  if (truth.feature != Feature::none) text += fmt::format(" {}", name(truth.feature));
  return text;
}

std::string explain_bag(std::span<const Triangle> triangles, const Query& query, const BagTruth& truth) {
  Lines lines;
  add_query(lines, query);
  if (truth.invalid != Invalid::none) {
    lines.add("class", "invalid: {}", reason(truth.invalid));
    return lines.take();
  }
  lines.add("crossed", "{} of {} triangles, which are counted from 0; in the exact order of t", truth.hits.size(),
            triangles.size());
  add_hits(lines, triangles, query, truth);
  for (const Stretch& s : truth.stretches)
    lines.add("touched", "triangle {}: {}, t from {} to {}: a matter of convention", s.triangle, name(s.hit_class),
              s.low, s.high);
  return lines.take();
}

std::string explain_bag_verdict(const BagQuestion& question, const Answer& answer, const BagJudgement& judgement) {
  Lines lines;
  add_contract(lines, question.contract);
  add_answer(lines, answer);
  if (answer.outcome == Outcome::hit && answer.has_t) lines.add("", "triangle {}", answer.triangle);
  lines.add("verdict", "{}: {}", name(judgement.verdict), meanings[static_cast<unsigned>(judgement.verdict)]);
  const bool wrong = judgement.verdict != BagVerdict::correct && judgement.verdict != BagVerdict::unspecified &&
                     judgement.verdict != BagVerdict::fault;
  if (wrong) add_severity(lines, judgement.length, judgement.ulps);
  return lines.take();
}

}  // namespace plumbline
